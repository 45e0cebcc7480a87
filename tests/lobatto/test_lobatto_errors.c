/* tests/lobatto/test_lobatto_errors.c -- H 17: corrected momenta, and runs that are refused.
 * Run alone: make test-lobatto_errors */
#include "lobatto_runs.h"
#include "run/whole_run.h"
#include "stages/lobatto_history.h"

#include "lobatto_ref.h"
#include "system/larger.h"

#include <malloc.h>
#include <stdlib.h>

/* ---- momenta ---- */

/* (17.14), the constants, through the function: h = 1, x = k^s / s!, whose difference
 * of order s is 1. Two terms, of some ten roundings each, 1e-3 at most where they
 * cancel: 32 u. Seen: 19 u. */
START_TEST(eq_17_14_constants_are_right)
{
    const double one = 1;
    const fvi_system system = { .d = 1, .mass = &one, .damping = &one };
    for (size_t i = 0; i < LEN(ref_corrections); i++) {
        const size_t s = ref_corrections[i].s;
        const fvi_run run = { .system = &system,
                              .h = 1,
                              .steps = 4,
                              .alpha = (1 + ref_corrections[i].beta) / 2 };
        double q[5], zero[5] = { 0 };
        for (size_t k = 0; k < 5; k++)
            q[k] = gsl_pow_int((double)k, (int)s)
                   / (s == 2   ? 2
                      : s == 3 ? 6
                               : 24);
        ck_assert_int_eq(fvi_lobatto_correct_momenta(methods[s], &run, q, zero), 0);
        const double want =
            s == 2 && ref_corrections[i].beta < 0 ? 0 : ref_corrections[i].want;
        ck_assert_near(zero[2], want, 32 * U * larger(fabs(want), 1e-3),
                       "s=%zu %g", s, ref_corrections[i].beta);
        ck_assert_double_eq(zero[0], 0);
        ck_assert_double_eq(zero[4], 0);
    }
}
END_TEST

/* ---- what is not needed is not taken ---- */

START_TEST(what_needs_no_stages_of_the_past_keeps_none)
{
    const double at[] = { 0.3, 0, 0.5, 1 };
    for (size_t s = 2; s <= 4; s++)
        for (size_t i = 0; i < LEN(at); i++) {
            const double one = 1, rho = i == 0 ? 0 : 0.5;
            const fvi_system system = { 1, &one, &rho, { 0 }, { 0 }, NULL, NULL };
            const fvi_run run = { .system = &system,
                                  .x0 = &one,
                                  .p0 = &one,
                                  .h = 0.1,
                                  .steps = (size_t)1 << 50,
                                  .alpha = at[i],
                                  .memory = FVI_HISTORY_DIRECT };
            fvi_stepper *stepper;
            ck_assert_int_eq(fvi_stepper_start(methods[s], &run, &stepper,
                                               NULL), 0);
            for (size_t k = 0; k < 20; k++)
                ck_assert_int_eq(fvi_stepper_step(stepper), FVI_SUCCESS);
            fvi_stepper_free(stepper);
        }
}
END_TEST

/* ---- errors ---- */

static int no_value(size_t d, const double *q, void *params, double *value)
{
    (void)d, (void)params;
    *value = fabs(q[0]);
    return 0;
}

/* grad U = 1e3 sign(x): Newton's method jumps to and fro. */
static int sign(size_t d, const double *q, void *params, double *g)
{
    (void)d, (void)params;
    g[0] = q[0] >= 0 ? 1e3 : -1e3;
    return 0;
}

static int claimed(size_t d, const double *q, void *params, double *H)
{
    (void)d, (void)q;
    H[0] = *(const double *)params;
    return 0;
}

START_TEST(lobatto_start_refuses)
{
    const double one = 1, c = 1;
    const fvi_system good = { 1,     &one, &one, fvi_potential_harmonic(&c),
                              { 0 }, NULL, NULL };
    const fvi_run run = { .system = &good,
                          .x0 = &one,
                          .p0 = &one,
                          .h = 1,
                          .steps = 3,
                          .alpha = 0.3 };
#define WITH(method, field, value, code)                                       \
    {                                                                          \
        fvi_run bad = run;                                                     \
        bad.field = (value);                                                   \
        fvi_stepper *same = (fvi_stepper *)&bad;                               \
        ck_assert_int_eq(fvi_stepper_start(method, &bad, &same, NULL), code);                \
        ck_assert_ptr_eq(same, &bad);                                          \
    }
    for (size_t s = 2; s <= 4; s++) {
        WITH(methods[s], memory, (fvi_history_kind)99, FVI_EINVAL)
        WITH(methods[s], alpha, 1.1, FVI_EDOM)
        WITH(methods[s], h, 0, FVI_EDOM)
        WITH(methods[s], steps, 0, FVI_EINVAL)
        WITH(methods[s], system, NULL, FVI_EFAULT)
        WITH(methods[s], tolerance, 1, FVI_EDOM)
        fvi_run exact = run;
        exact.memory = FVI_HISTORY_MODES;
        exact.tolerance = 1e-15;
        fvi_stepper *stepper = NULL;
        ck_assert_int_eq(fvi_stepper_start(methods[s], &exact, &stepper,
                                           NULL), FVI_ETOL);
        ck_assert_ptr_null(stepper);
    }
#undef WITH
}
END_TEST

static int last_step(const fvi_system *system, const double *x0, size_t s)
{
    const double one = 1;
    const fvi_run run = { .system = system,
                          .x0 = x0,
                          .p0 = &one,
                          .h = 1,
                          .steps = 500,
                          .alpha = 0.3 };
    return fvi_trajectory(methods[s], &run, NULL, NULL, NULL);
}

/* s = 3, no damping: 1 + (h^2/16) (4/6) U'' is 0 at U'' = -24, in exact numbers;
 * in doubles for one of its neighbours. Constant: refused at the start. */
START_TEST(a_singular_equation_is_refused)
{
    const double one = 1, none = 0, start = -0.7;
    double stiffness = -24;
    for (int i = 0; i < 20; i++)
        stiffness = nextafter(stiffness, -25);
    size_t refused[2] = { 0 };
    const fvi_potential promised = fvi_potential_harmonic(&one);
    for (int i = 0; i < 40; i++, stiffness = nextafter(stiffness, 0)) {
        fvi_system system = {
            1,     &one,
            &none, { no_value, sign, claimed, &stiffness, 0, 0, 0, NULL },
            { 0 }, NULL, NULL
        };
        for (int constant = 0; constant <= 1; constant++) {
            if (constant)
                system.potential.quadratic = promised.quadratic;
            int status = last_step(&system, &start, 3);
            ck_assert(status == FVI_ESING || status == FVI_SUCCESS
                      || status == FVI_EMAXITER);
            refused[constant] += status == FVI_ESING;
        }
    }
    ck_assert_uint_gt(refused[0], 0);
    ck_assert_uint_gt(refused[1], 0);
}
END_TEST

/* At rest in the well x = 1 of U = (x^2 - 1)^2 / 4, and some places beside it: grad U
 * and the way of a step are as small as the rounding of x, and no update is small
 * beside them. Newton's method has to see that x is what is rounded. */
START_TEST(eq_17_8_rest_away_from_the_origin_is_solved)
{
    for (size_t s = 3; s <= 4; s++)
        for (int k = -20; k <= 20; k++) {
            const setup a = { .s = s,
                              .alpha = 0.5,
                              .x0 = 1 + k * GSL_DBL_EPSILON,
                              .h = 0.5,
                              .steps = 50,
                              .cg = { -1, 1 } };
            double x[51];
            solve(&a, x, NULL);
            /* it oscillates about 1, from 40 u away; a step rounds x once, and
             * grad U, three times, by less than that: 4 u. Seen: 0.13 of it */
            ck_assert_near(x[50], 1, (40 + 50 * 4) * U, "k=%d", k);
        }
}
END_TEST

/* m / h = 1e-400 is below all doubles, and nothing is left of the equation. */
START_TEST(a_mass_that_vanishes_against_the_step_is_refused)
{
    const double light = 1e-200, none = 0, one = 1;
    const fvi_system system = { 1, &light, &none, { 0 }, { 0 }, NULL, NULL };
    const fvi_run run = {
        .system = &system, .x0 = &one, .p0 = &one, .h = 1e200, .steps = 3
    };
    fvi_stepper *stepper = NULL;
    for (size_t s = 2; s <= 4; s++)
        ck_assert_int_eq(fvi_stepper_start(methods[s], &run, &stepper,
                                           NULL), FVI_ESING);
    ck_assert_ptr_null(stepper);
}
END_TEST

/* The matrix of the inner stages has ((s - 2) d)^2 = 2^44 numbers. */
START_TEST(stages_that_find_no_room_are_refused)
{
    enum { D = 1 << 22 };
    double *ones = malloc(D * sizeof *ones);
    ck_assert_ptr_nonnull(ones);
    for (size_t i = 0; i < D; i++)
        ones[i] = 1;
    fvi_system system = { .mass = ones,
                          .damping = ones,
                          .potential = { .value = no_value,
                                         .gradient = sign,
                                         .hessian = claimed,
                                         .params = ones } };
    const fvi_run run = { .system = &system,
                          .x0 = ones,
                          .p0 = ones,
                          .h = 1,
                          .steps = 3,
                          .alpha = 0.5 };
    fvi_stepper *stepper = NULL;
    for (size_t s = 3; s <= 4; s++) {
        system.d = D / (s - 2);
        ck_assert_int_eq(fvi_stepper_start(methods[s], &run, &stepper,
                                           NULL), FVI_ENOMEM);
    }
    ck_assert_ptr_null(stepper);
    free(ones);
}
END_TEST

START_TEST(lobatto_steps_fail_with_their_code)
{
    const double one = 1, none = 0, flat = 0.25, start = -0.7, hard = -4;
    fvi_system system = { .d = 1,
                          .mass = &one,
                          .damping = &none,
                          .potential = { .value = no_value,
                                         .gradient = sign,
                                         .hessian = claimed,
                                         .params = (void *)&flat } };
    ck_assert_int_eq(last_step(&system, &start, 3), FVI_EMAXITER);
    ck_assert_int_eq(last_step(&system, &start, 4), FVI_EMAXITER);
    system.potential = fvi_potential_harmonic(&hard);
    for (size_t s = 2; s <= 4; s++)
        ck_assert_int_eq(last_step(&system, &start, s), FVI_EOVRFLW);
}
END_TEST

START_TEST(momenta_refuse)
{
    const double one = 1;
    const fvi_system system = { .d = 1, .mass = &one, .damping = &one };
    fvi_run run = { .system = &system, .h = 1, .steps = 4, .alpha = 0.7 };
    double q[5] = { 0, 1, 7, 1, 0 }, momentum[5] = { 0 };
    const fvi_method other = { .name = "other" };
    ck_assert_int_eq(fvi_lobatto_correct_momenta(NULL, &run, q, momentum), FVI_EFAULT);
    ck_assert_int_eq(fvi_lobatto_correct_momenta(&fvi_lobatto_m3, NULL, q, momentum),
                     FVI_EFAULT);
    ck_assert_int_eq(fvi_lobatto_correct_momenta(&fvi_lobatto_m3, &run, NULL, momentum),
                     FVI_EFAULT);
    ck_assert_int_eq(fvi_lobatto_correct_momenta(&fvi_lobatto_m3, &run, q, NULL),
                     FVI_EFAULT);
    ck_assert_int_eq(fvi_lobatto_correct_momenta(&other, &run, q, momentum),
                     FVI_EINVAL);
    run.alpha = GSL_NAN;
    ck_assert_int_eq(fvi_lobatto_correct_momenta(&fvi_lobatto_m4, &run, q, momentum),
                     FVI_EDOM);
    run.alpha = 0.7;
    run.h = 0;
    ck_assert_int_eq(fvi_lobatto_correct_momenta(&fvi_lobatto_m4, &run, q, momentum),
                     FVI_EDOM);
    run.h = 1;
    run.steps = 0;
    ck_assert_int_eq(fvi_lobatto_correct_momenta(&fvi_lobatto_m4, &run, q, momentum),
                     FVI_EINVAL);
    run.steps = 4;
    const fvi_kernel_term springpot = { .kind = FVI_KERNEL_POWER, .rho = 1, .alpha = 0.7 };
    const fvi_kernel law = { 1, &springpot };
    run.law = &law; /* alpha is then not that of the run */
    ck_assert_int_eq(fvi_lobatto_correct_momenta(&fvi_lobatto_m4, &run, q, momentum),
                     FVI_EUNSUP);
    run.law = NULL;
    const fvi_system undamped = { .d = 1, .mass = &one };
    run.system = &undamped;
    ck_assert_int_eq(fvi_lobatto_correct_momenta(&fvi_lobatto_m4, &run, q, momentum),
                     FVI_EFAULT);
    run.system = NULL;
    ck_assert_int_eq(fvi_lobatto_correct_momenta(&fvi_lobatto_m4, &run, q, momentum),
                     FVI_EFAULT);
    ck_assert_double_eq(farthest(0, 5, momentum, NULL), 0);
}
END_TEST

static double heap(void)
{
#ifdef __GLIBC__
    struct mallinfo2 info = mallinfo2();
    return (double)(info.uordblks + info.hblkhd);
#else
    return 0;
#endif
}

/* The heap keeps what was announced, and what malloc adds: up to 64 bytes in front
 * of a block, rounding up to a page if it is large; it may hand out freed blocks
 * first. Where malloc does not count (sanitizers), no one can tell. */
START_TEST(bytes_of_the_stages_are_what_is_kept)
{
    const double betas[] = { -1, -0.4, 0, 0.4, 1 };
    const size_t steps[] = { 3, 65, 3000 };
    for (size_t i = 0; i < 3 * LEN(steps) * LEN(betas) * 2; i++) {
        const size_t s = 2 + i % 3, N = steps[i / 3 % 3], d = i % 2 ? 40 : 1;
        const double beta = betas[i / 9 % 5];
        const fvi_history_kind kind =
            i < 45 ? FVI_HISTORY_DIRECT : FVI_HISTORY_AUTO;
        fvi_lobatto_history *m = NULL;
        const double before = heap();
        ck_assert_int_eq(fvi_lobatto_history_alloc(s, beta, d, N, kind, 0, 0, &m),
                         FVI_SUCCESS);
        const double taken = heap() - before,
                     said = fvi_lobatto_history_bytes(s, beta, d, N, kind, 0);
        fvi_lobatto_history_free(m);
        if (heap() > 0)
            ck_assert_msg(fabs(taken - said) <= 8192,
                          "s=%zu beta=%g d=%zu N=%zu: said %g, kept %g", s,
                          beta, d, N, said, taken);
    }
    ck_assert(fvi_lobatto_history_bytes(9, 0.4, 1, 9, FVI_HISTORY_AUTO, 0) == 0);
    /* more than can be addressed, or nearly */
    ck_assert(fvi_lobatto_history_bytes(4, 0.4, 1, (size_t)1 << 40,
                                       FVI_HISTORY_DIRECT, 0)
              > 8 * 20 * 1e12);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("lobatto_errors");
    ADD_CASE(suite, "values", eq_17_14_constants_are_right);
    ADD_CASE(suite, "errors", what_needs_no_stages_of_the_past_keeps_none,
             lobatto_start_refuses, a_singular_equation_is_refused,
             eq_17_8_rest_away_from_the_origin_is_solved,
             a_mass_that_vanishes_against_the_step_is_refused,
             stages_that_find_no_room_are_refused,
             lobatto_steps_fail_with_their_code, momenta_refuse,
             bytes_of_the_stages_are_what_is_kept);
    return run_suite(suite);
}
