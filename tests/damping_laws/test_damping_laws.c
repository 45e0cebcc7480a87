/* tests/damping_laws/test_damping_laws.c -- H 26: symbols and weights.
 * Run alone: make test-damping_laws */
#include <fvi/fvi.h>
#include "harness/ulp.h"

#include "damping_laws_ref.h"
#include "function_of_law.h"
#include "random_laws.h"

/* ---- the symbol ---- */

/* A power, an exponential and a quotient of sums of one sign, some ten roundings of
 * what a term is, and terms of one sign in Im; in Re the terms may cancel. */
START_TEST(eq_26_2_moduli)
{
    for (size_t i = 0; i < LEN(ref_moduli); i++) {
        double storage, loss;
        ck_assert_int_eq(fvi_kernel_moduli(&ref_laws[ref_moduli[i].law],
                                        ref_moduli[i].omega, &storage, &loss),
                         FVI_SUCCESS);
        const double size = hypot(ref_moduli[i].storage, ref_moduli[i].loss);
        ck_assert_near(storage, ref_moduli[i].storage, 16 * U * size,
                       "storage, row %zu", i);
        ck_assert_near(loss, ref_moduli[i].loss, 16 * U * size, "loss, row %zu",
                       i);
    }
}
END_TEST

START_TEST(eq_26_2_every_law_is_passive)
{
    srand(1);
    for (int i = 0; i < 1000; i++) {
        fvi_kernel_term term[3];
        const fvi_kernel law = { random_terms(term), term };
        double storage, loss;
        ck_assert_int_eq(
            fvi_kernel_moduli(&law, pow(10, random_in(-4, 4)), &storage, &loss),
            FVI_SUCCESS);
        ck_assert_double_ge(loss, 0);
    }
}
END_TEST

START_TEST(eq_26_1_growth)
{
    const double growth[] = { 0.625, 0.75, 0, 0, 1, 1.5, 1.75, 1.5, 0.25, 1.25, 0, 1.5 };
    for (size_t i = 0; i < LEN(ref_laws); i++)
        ck_assert_double_eq(fvi_kernel_growth(&ref_laws[i]), growth[i]);
    const fvi_kernel_term dashpot = { FVI_KERNEL_MAXWELL, 1, 0, 0, 0 },
                       zener = { FVI_KERNEL_ZENER, 1, 0.25, 0, 0 };
    ck_assert_double_eq(fvi_kernel_growth(&(fvi_kernel){ 1, &dashpot }), 1);
    ck_assert_double_eq(fvi_kernel_growth(&(fvi_kernel){ 1, &zener }), 0.5);
}
END_TEST

/* ---- the weights ---- */

/* Relative to the largest weight: 60 u a term, of the power h^{-2 alpha}, of the
 * weights of (1-z)^{2 alpha}, 40 u with BDF2, and of sums of one sign. */
START_TEST(eq_26_3_weights)
{
    double w[151];
    for (size_t i = 0; i < LEN(ref_weights); i++) {
        const fvi_kernel *law = &ref_laws[ref_weights[i].law];
        ck_assert_int_eq(fvi_kernel_weights(law,
                                         (fvi_delta)ref_weights[i].kind,
                                         ref_weights[i].h, LEN(w), w),
                         FVI_SUCCESS);
        for (size_t j = 0; j < REF_INDICES; j++)
            ck_assert_near(w[ref_index[j]], ref_weights[i].w[j],
                           60 * U * (double)law->count
                               * fabs(ref_weights[i].w[0]),
                           "row %zu, n = %zu", i, ref_index[j]);
    }
}
END_TEST

/* ---- poles of a symbol ---- */

static uint64_t state;

static double between(double low, double high)
{
    state = state * 6364136223846793005u + 1442695040888963407u;
    return low + (high - low) * (double)(state >> 11) * 0x1p-53;
}

/* A law on the cut, s^a + |p|^a r (s/(s + 1/T))^b, and `size` times |p|^a a pair of poles, p and its conjugate. */
typedef struct {
    double a, r, T, b, size;
    double complex p;
    int order;
} rung_law;

static void rung_symbol(double re, double im, void *params, double *C_re, double *C_im)
{
    const rung_law *l = params;
    const double complex s = re + I * im, at = l->p,
                         pair = cabs(at) * s / ((s - at) * (s - conj(at))),
                         large = pow(cabs(at), l->a), smooth = l->r * cpow(s / (s + 1 / l->T), l->b),
                         C = cpow(s, l->a) + large * (smooth + l->size * cpow(pair, l->order));
    *C_re = creal(C);
    *C_im = cimag(C);
}

/* Poles with |arg s| < 165 degrees, of order 1 and 2, beside laws that are as large: none is a law. Without them each
 * is one. */
START_TEST(a_symbol_with_poles_beside_the_cut_is_refused)
{
    state = 26;
    for (int i = 0; i < 300; i++) {
        rung_law l = { .a = between(0.1, 1), .r = between(0, 2), .T = exp(between(-8, 8)), .b = between(0.1, 1),
                       .order = 1 + i % 2 };
        l.p = exp(between(-11, 11)) * (i % 10 == 9 ? I /* no residue */ : cexp(I * between(0.1, 2.88)));
        const fvi_kernel_function f = { { FVI_KERNEL_SYMBOL, 1, 0, 0, 0 }, rung_symbol, &l };
        const fvi_kernel law = fvi_kernel_of_function(&f);
        ck_assert_msg(fvi_kernel_check(&law) == FVI_SUCCESS, "run %d: without poles", i);
        l.size = between(0.05, 2);
        ck_assert_msg(fvi_kernel_check(&law) == FVI_EDOM, "run %d: |p| = %g, arg p = %g", i, cabs(l.p), carg(l.p));
    }
}
END_TEST

/* The same laws as functions of s: Cauchy's integral, from 1200 values of the symbol, is off by
 * 10 u of the largest for each term. Seen: see make seen. */
START_TEST(eq_26_16_weights_by_a_function)
{
    double w[151];
    for (size_t i = 0; i < LEN(ref_weights); i++) {
        const fvi_kernel *law = &ref_laws[ref_weights[i].law];
        const fvi_kernel_function f = function_of_law(law);
        const fvi_kernel by = fvi_kernel_of_function(&f);
        ck_assert_int_eq(fvi_kernel_weights(&by, (fvi_delta)ref_weights[i].kind,
                                            ref_weights[i].h, LEN(w), w),
                         FVI_SUCCESS);
        for (size_t j = 0; j < REF_INDICES; j++) {
            const double off = w[ref_index[j]] - ref_weights[i].w[j];
            seen(fabs(off / ref_weights[i].w[0]), "of the largest");
            ck_assert_near(w[ref_index[j]], ref_weights[i].w[j],
                           30 * U * (double)law->count
                               * fabs(ref_weights[i].w[0]),
                           "row %zu, n = %zu", i, ref_index[j]);
        }
    }
}
END_TEST

/* Laws that are one another: a fraction without a time, a Maxwell element as a fraction
 * of order 1, a sum in another order. To a rounding in each term. */
START_TEST(eq_26_3_one_law_in_two_words)
{
    const fvi_kernel_term pairs[][2] = {
        { { FVI_KERNEL_ZENER, 2, 0.3, 0, 0 }, { FVI_KERNEL_POWER, 2, 0.3, 0, 0 } },
        { { FVI_KERNEL_MAXWELL, 2, 0, 0.7, 0 },
          { FVI_KERNEL_ZENER, 2, 0.5, 0.7, 0 } },
        { { FVI_KERNEL_MAXWELL, 2, 0, 0, 0 }, { FVI_KERNEL_POWER, 2, 0.5, 0, 0 } },
        { { FVI_KERNEL_MAXWELL2, 2, 0.3, 0.7, 0 },
          { FVI_KERNEL_ZENER, 2, 0.3, 0.7, 0 } },
        { { FVI_KERNEL_MAXWELL2, 2, 0.3, 1, 0.3 },
          { FVI_KERNEL_POWER, 1, 0.3, 0, 0 } },
    };
    for (size_t i = 0; i < LEN(pairs); i++)
        for (int kind = 0; kind < 2; kind++) {
            double w[2][100];
            for (int j = 0; j < 2; j++)
                ck_assert_int_eq(fvi_kernel_weights(&(fvi_kernel){ 1, &pairs[i][j] },
                                                 (fvi_delta)kind, 0.01,
                                                 100, w[j]),
                                 FVI_SUCCESS);
            for (size_t n = 0; n < 100; n++)
                ck_assert_near(w[0][n], w[1][n], 4 * U * w[1][0],
                               "pair %zu, n = %zu", i, n);
        }
}
END_TEST

/* ---- bad input ---- */

START_TEST(what_is_no_law_is_refused)
{
    const fvi_kernel_term bad[] = {
        { FVI_KERNEL_POWER, -1, 0.3, 0, 0 },
        { FVI_KERNEL_POWER, INFINITY, 0.3, 0, 0 },
        { FVI_KERNEL_POWER, NAN, 0.3, 0, 0 },
        { FVI_KERNEL_POWER, 1, -0.1, 0, 0 },
        { FVI_KERNEL_POWER, 1, 1.1, 0, 0 },
        { FVI_KERNEL_ZENER, 1, 1.1, 1, 0 },
        { FVI_KERNEL_ZENER, 1, 0.3, -1, 0 },
        { FVI_KERNEL_MAXWELL, 1, 0, INFINITY, 0 },
        { FVI_KERNEL_MAXWELL, 1, 0, NAN, 0 },
        { FVI_KERNEL_DISTRIBUTED, 1, 0.3, 0, 0.3 },
        { FVI_KERNEL_DISTRIBUTED, 1, 0.3, 0, 1.1 },
        { FVI_KERNEL_MAXWELL2, 1, 0.3, 1, 0.4 },
        { FVI_KERNEL_MAXWELL2, 1, 0.3, 1, -0.1 },
        { FVI_KERNEL_MAXWELL2, 1, 0.3, -1, 0.1 },
    };
    for (size_t i = 0; i < LEN(bad); i++)
        ck_assert_int_eq(fvi_kernel_check(&(fvi_kernel){ 1, &bad[i] }), FVI_EDOM);
    const fvi_kernel_term unknown = { (fvi_kernel_kind)1000, 1, 0.3, 1, 1 };
    ck_assert_int_eq(fvi_kernel_check(&(fvi_kernel){ 1, &unknown }), FVI_EINVAL);
    const fvi_kernel_function f = function_of_law(&ref_laws[0]),
                              none = { f.term, NULL, NULL };
    const fvi_kernel_term two[] = { f.term, f.term };
    ck_assert_int_eq(fvi_kernel_check(&(fvi_kernel){ 1, &f.term }), FVI_SUCCESS);
    ck_assert_int_eq(fvi_kernel_check(&(fvi_kernel){ 1, &none.term }),
                     FVI_EFAULT);
    ck_assert_int_eq(fvi_kernel_check(&(fvi_kernel){ 2, two }), FVI_EINVAL);
    ck_assert_int_eq(fvi_kernel_check(&(fvi_kernel){ 0, &unknown }), FVI_EINVAL);
    ck_assert_int_eq(fvi_kernel_check(&(fvi_kernel){ 1, NULL }), FVI_EFAULT);
    ck_assert_int_eq(fvi_kernel_check(NULL), FVI_EFAULT);
}
END_TEST

START_TEST(bad_numbers_leave_everything_untouched)
{
    const fvi_kernel *law = &ref_laws[0];
    const fvi_delta euler = FVI_DELTA_EULER;
    double storage = 7, loss = 7, w[2] = { 7, 7 }, first = 7;
    fvi_history *memory = NULL;
    ck_assert_int_eq(fvi_kernel_moduli(law, 0, &storage, &loss), FVI_EDOM);
    ck_assert_int_eq(fvi_kernel_moduli(law, NAN, &storage, &loss), FVI_EDOM);
    ck_assert_int_eq(fvi_kernel_moduli(law, 1, NULL, &loss), FVI_EFAULT);
    ck_assert_int_eq(fvi_kernel_moduli(NULL, 1, &storage, &loss), FVI_EFAULT);
    ck_assert_int_eq(fvi_kernel_weights(law, euler, 0, 2, w), FVI_EDOM);
    ck_assert_int_eq(fvi_kernel_weights(law, euler, NAN, 2, w), FVI_EDOM);
    ck_assert_int_eq(fvi_kernel_weights(law, euler, 1, 0, w), FVI_EINVAL);
    ck_assert_int_eq(fvi_kernel_weights(law, euler, 1, 2, NULL), FVI_EFAULT);
    ck_assert_int_eq(fvi_kernel_weights(law, FVI_DELTA_L1, 1, 2, w),
                     FVI_EINVAL);
    ck_assert_int_eq(fvi_kernel_weights(NULL, euler, 1, 2, w), FVI_EFAULT);
    const struct {
        double h, tolerance;
        size_t d, steps;
        fvi_history_kind how;
        int code;
    } bad[] = {
        { 0, 0, 1, 9, FVI_HISTORY_AUTO, FVI_EDOM },
        { INFINITY, 0, 1, 9, FVI_HISTORY_AUTO, FVI_EDOM },
        { 1, 1, 1, 9, FVI_HISTORY_AUTO, FVI_EDOM },
        { 1, NAN, 1, 9, FVI_HISTORY_AUTO, FVI_EDOM },
        { 1, 0, 0, 9, FVI_HISTORY_AUTO, FVI_EINVAL },
        { 1, 0, 1, (size_t)-1, FVI_HISTORY_AUTO, FVI_EINVAL },
        { 1, 0, 1, 2000000000, FVI_HISTORY_MODES, FVI_EINVAL },
        { 1, 1e-15, 1, 9, FVI_HISTORY_MODES, FVI_ETOL },
        { 1, 0, 1, 9, (fvi_history_kind)3, FVI_EINVAL },
    };
    for (size_t i = 0; i < LEN(bad); i++)
        ck_assert_int_eq(fvi_kernel_history(law, euler, bad[i].h, bad[i].d,
                                        bad[i].steps, bad[i].how,
                                        bad[i].tolerance, &first, &memory),
                         bad[i].code);
    ck_assert_int_eq(fvi_kernel_history(law, FVI_DELTA_L1, 1, 1, 9,
                                    FVI_HISTORY_AUTO, 0, &first, &memory),
                     FVI_EINVAL);
    ck_assert_int_eq(
        fvi_kernel_history(law, euler, 1, 1, 9, FVI_HISTORY_AUTO, 0, NULL, &memory),
        FVI_EFAULT);
    ck_assert_int_eq(
        fvi_kernel_history(law, euler, 1, 1, 9, FVI_HISTORY_AUTO, 0, &first, NULL),
        FVI_EFAULT);
    ck_assert(storage == 7 && loss == 7 && w[0] == 7 && first == 7 && !memory);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("damping_laws");
    ADD_CASE(suite, "symbol", eq_26_1_growth, eq_26_2_moduli,
             eq_26_2_every_law_is_passive, a_symbol_with_poles_beside_the_cut_is_refused);
    ADD_CASE(suite, "weights", eq_26_3_weights,
             eq_26_16_weights_by_a_function, eq_26_3_one_law_in_two_words);
    ADD_CASE(suite, "bad input", what_is_no_law_is_refused,
             bad_numbers_leave_everything_untouched);
    return run_suite(suite);
}
