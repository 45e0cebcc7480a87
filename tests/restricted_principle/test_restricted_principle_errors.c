/* tests/restricted_principle/test_restricted_principle_errors.c -- H 3: inputs that are refused.
 * Run alone: make test-restricted_principle_errors */
#include <fvi/error.h>
#include <fvi/paper/restricted_principle.h>
#include "harness/ulp.h"

#include <gsl/gsl_math.h>

static const fvi_powers none = { 0, NULL, NULL };
static const double e1[] = { 1, 2 }, c1[] = { 1, -1 };

/* Every refusal of both functions; the outputs keep their sentinel. */
static void ck_assert_refused(int code, const fvi_system *system, double alpha,
                              double T, const fvi_powers *x,
                              const fvi_powers *y, const fvi_powers *eta)
{
    const fvi_powers good = { 2, e1, c1 };
    double S = 7, dS = 7;
    if (eta == &none)
        ck_assert_int_eq(fvi_action(system, alpha, T, x, y, &S), code);
    ck_assert_int_eq(
        fvi_action_variation(system, alpha, T, x, y, &good, eta, &dS), code);
    ck_assert(S == 7 && dS == 7);
}

START_TEST(a_bad_pair_of_curves_is_refused)
{
    const double m = 2, rho = 0.5, c = 3;
    fvi_system s = { .d = 1,
                     .mass = &m,
                     .damping = &rho,
                     .potential = fvi_potential_harmonic(&c) };
    fvi_system flat = s, negative_mass = s;
    const double pair[] = { 1, 1 }, minus = -1;
    const double bad_exponent[] = { -1, 0.5, 151, GSL_NAN };
    const double bad_alpha[] = { -0.1, 1, GSL_NAN },
                 bad_T[] = { 0, -1, GSL_POSINF, GSL_NAN };
    const fvi_powers good = { 2, e1, c1 },
                     holes[] = { { 1, NULL, c1 }, { 1, e1, NULL } };
    const double huge = GSL_POSINF;
    const fvi_powers infinite = { 1, e1, &huge };
    flat.d = 2;
    flat.mass = flat.damping = pair;
    negative_mass.mass = &minus;
    ck_assert_refused(FVI_EFAULT, NULL, 0.5, 1, &good, &good, &none);
    ck_assert_refused(FVI_EINVAL, &flat, 0.5, 1, &good, &good, &none);
    ck_assert_refused(FVI_EDOM, &negative_mass, 0.5, 1, &good, &good, &none);
    ck_assert_refused(FVI_EFAULT, &s, 0.5, 1, NULL, &good, &none);
    ck_assert_refused(FVI_EFAULT, &s, 0.5, 1, &good, NULL, &none);
    ck_assert_refused(FVI_EFAULT, &s, 0.5, 1, &good, &good, NULL);
    for (size_t i = 0; i < LEN(holes); i++)
        ck_assert_refused(FVI_EFAULT, &s, 0.5, 1, &good, &holes[i], &none);
    for (size_t i = 0; i < LEN(bad_exponent); i++) {
        const fvi_powers f = { 1, &bad_exponent[i], c1 };
        ck_assert_refused(FVI_EDOM, &s, 0.5, 1, &f, &good, &none);
        ck_assert_refused(FVI_EDOM, &s, 0.5, 1, &good, &good, &f);
    }
    ck_assert_refused(FVI_EDOM, &s, 0.5, 1, &infinite, &good, &none);
    for (size_t i = 0; i < LEN(bad_alpha); i++)
        ck_assert_refused(FVI_EDOM, &s, bad_alpha[i], 1, &good, &good, &none);
    for (size_t i = 0; i < LEN(bad_T); i++)
        ck_assert_refused(FVI_EDOM, &s, 0.5, bad_T[i], &good, &good, &none);
    ck_assert_int_eq(fvi_action(&s, 0.5, 1, &good, &good, NULL), FVI_EFAULT);
    ck_assert_int_eq(
        fvi_action_variation(&s, 0.5, 1, &good, &good, &good, &good, NULL),
        FVI_EFAULT);
}
END_TEST

START_TEST(bad_powers_are_refused)
{
    double out[4] = { 7, 7, 7, 7 }, more[4] = { 7, 7, 7, 7 };
    ck_assert_int_eq(fvi_powers_reflect(2, 1, NULL, out), FVI_EFAULT);
    ck_assert_int_eq(fvi_powers_reflect(2, 1, c1, NULL), FVI_EFAULT);
    ck_assert_int_eq(fvi_powers_reflect(0, 1, c1, out), FVI_EINVAL);
    ck_assert_int_eq(fvi_powers_reflect(2, GSL_NAN, c1, out), FVI_EDOM);
    ck_assert_int_eq(fvi_damped_powers(0.5, 1, 1, 2, NULL, out), FVI_EFAULT);
    ck_assert_int_eq(fvi_damped_powers(0.5, 1, 1, 2, out, NULL), FVI_EFAULT);
    ck_assert_int_eq(fvi_damped_powers(0.5, 1, 1, 0, out, more), FVI_EINVAL);
    ck_assert_int_eq(fvi_damped_powers(0.5, 1, 1, 33, out, more), FVI_EINVAL);
    ck_assert_int_eq(fvi_damped_powers(1, 1, 1, 2, out, more), FVI_EDOM);
    ck_assert_int_eq(fvi_damped_powers(-0.1, 1, 1, 2, out, more), FVI_EDOM);
    ck_assert_int_eq(fvi_damped_powers(GSL_NAN, 1, 1, 2, out, more), FVI_EDOM);
    ck_assert_int_eq(fvi_damped_powers(0.5, GSL_NAN, 1, 2, out, more),
                     FVI_EDOM);
    ck_assert_int_eq(fvi_damped_powers(0.5, 1, GSL_POSINF, 2, out, more),
                     FVI_EDOM);
    for (size_t i = 0; i < 4; i++)
        ck_assert(out[i] == 7 && more[i] == 7);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("restricted_principle_errors");
    ADD_CASE(suite, "errors", a_bad_pair_of_curves_is_refused,
             bad_powers_are_refused);
    return run_suite(suite);
}
