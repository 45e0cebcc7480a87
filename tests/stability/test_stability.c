/* tests/stability/test_stability.c -- H 14: the load, and the largest step.
 * Run alone: make test-stability */
#include "scalar_run.h"

#include <stdlib.h>

/* (14.3) in numbers: the bounds that the chapter's table prints. */
START_TEST(eq_14_3_load_of_single_oscillators)
{
    /* alpha, kappa, W, R, load: R / 4^{1-alpha} + W (1 - 2 kappa)^2 / 4 */
    const double row[][5] = {
        { 0, 0.5, 3, 4, 1 },    { 0.25, 0.5, 1, 2 * M_SQRT2, 1 },
        { 0.5, 0.5, 9, 2, 1 },  { 0.75, 0.5, 1, M_SQRT2, 1 },
        { 1, 0.5, 7, 1, 1 },    { 0.5, 0, 2, 1, 1 },
        { 0.5, 1, 2, 1, 1 },    { 0.5, 0.25, 4, 1.5, 1 },
        { 1, 0, 1, 0.5, 0.75 }, { 0.5, 0.5, 1, 0.1, 0.05 }
    };
    for (size_t i = 0; i < LEN(row); i++) {
        const fvi_run run =
            scalar_run(row[i][0], row[i][1], row[i][2], row[i][3], 1);
        double load = 0;
        ck_assert_int_eq(fvi_stability_number(&fvi_fractional, &run, &load),
                         FVI_SUCCESS);
        ck_assert_near(load, row[i][4], 8 * U * row[i][4], "row %zu", i);
    }
    /* no potential, kappa = 0: 2 rho h / 4, in exact numbers */
    fvi_run run = scalar_run(0.5, 0, 1, 1, 1);
    scalar.potential = (fvi_potential){ 0 };
    double load = 0;
    ck_assert_int_eq(fvi_stability_number(&fvi_fractional, &run, &load),
                     FVI_SUCCESS);
    ck_assert_double_eq(load, 0.5);
}
END_TEST

/* A nonlinear spring counts with its stiffness at the start, c + 3 g x0^2 = 13, not
 * at the origin: h^2 13 / 4 + 2 rho h / 4 at kappa = 0, alpha = 1/2. */
START_TEST(eq_14_3_load_of_a_nonlinear_spring_is_that_at_the_start)
{
    const double one = 1, damping = 0.5, start = 2, cg[2] = { 1, 1 };
    const fvi_system system = { 1,        &one,
                                &damping, fvi_potential_duffing(cg),
                                { 0 },    NULL, NULL };
    const fvi_run run = { .system = &system,
                          .x0 = &start,
                          .p0 = &one,
                          .h = 0.1,
                          .steps = 1,
                          .kappa = 0,
                          .alpha = 0.5 };
    double load = 0;
    ck_assert_int_eq(fvi_stability_number(&fvi_fractional, &run, &load),
                     FVI_SUCCESS);
    ck_assert_near(load, 0.13 / 4 + 0.1 / 4, 8 * U, "load");
}
END_TEST

/* h enters as h^2 c / m and rho h^(2 - 2 alpha) / m: Bagley-Torvik's step is 2,
 * linear damping's 2 m / rho, and alpha = 1 has all steps or none. */
START_TEST(eq_14_4_largest_step)
{
    fvi_run run = scalar_run(0.75, 0.5, 1, 1, 1);
    double step = 0;
    ck_assert_int_eq(fvi_stability_longest_step(&fvi_fractional, &run, &step),
                     FVI_SUCCESS);
    ck_assert_near(step, 2, 8 * GSL_DBL_EPSILON * 2, "Bagley-Torvik");
    run = scalar_run(0.5, 0.5, 1, 0.25, 1);
    ck_assert_int_eq(fvi_stability_longest_step(&fvi_fractional, &run, &step),
                     FVI_SUCCESS);
    ck_assert_near(step, 8, 8 * GSL_DBL_EPSILON * 8, "linear damping");
    run = scalar_run(0.5, 0, 1, 1, 1); /* h^2 + 2 h = 4 */
    ck_assert_int_eq(fvi_stability_longest_step(&fvi_fractional, &run, &step),
                     FVI_SUCCESS);
    ck_assert_near(step, sqrt(5) - 1, 8 * GSL_DBL_EPSILON * 2, "kappa = 0");
    run = scalar_run(1, 0.5, 1, 0.999, 1);
    ck_assert_int_eq(fvi_stability_longest_step(&fvi_fractional, &run, &step),
                     FVI_SUCCESS);
    ck_assert(step == GSL_POSINF);
    run = scalar_run(1, 0.5, 1, 1.001, 1);
    ck_assert_int_eq(fvi_stability_longest_step(&fvi_fractional, &run, &step),
                     FVI_SUCCESS);
    ck_assert(step == 0);
    m = 0.1; /* the load overflows on the way; the step is 2e-154.5, and tiny */
    run = scalar_run(0, 0.5, 1, 1e308, 1);
    ck_assert_int_eq(fvi_stability_longest_step(&fvi_fractional, &run, &step),
                     FVI_SUCCESS);
    m = 1;
    ck_assert(step < 1e-150);
}
END_TEST

/* A uniform chain without damping: K has the eigenvalues 4 c sin^2(j pi/(2 (d + 1))), and
 * the load is h^2 / 4 times the largest, at kappa = 0. Each pivot has three roundings of
 * terms up to 4 c: 3 u of that in the matrix, as much for the sine. Seen: 0.2 of it. */
START_TEST(eq_14_3_long_chains)
{
    enum { D = 100000 };
    static const size_t sizes[] = { 1, 2, 3, 50, D };
    static double one[D], zero[D];
    for (size_t i = 0; i < D; i++)
        one[i] = 1;
    const double spring[] = { 3, 0 }, h = 0.5;
    for (size_t i = 0; i < LEN(sizes); i++) {
        const size_t d = sizes[i];
        const fvi_system chain = { d,     one,
                                   zero,  fvi_potential_chain(spring),
                                   { 0 }, NULL, NULL };
        const fvi_run run = {
            .system = &chain, .x0 = zero, .h = h, .alpha = 0.5
        };
        double load, s = sin((double)d * M_PI / (2 * (double)(d + 1)));
        ck_assert_int_eq(fvi_stability_number(&fvi_fractional, &run, &load),
                         FVI_SUCCESS);
        ck_assert_near(load, h * h * spring[0] * s * s,
                       8 * U * h * h * spring[0], "d = %zu", d);
    }
}
END_TEST

START_TEST(bad_questions_are_refused_and_outputs_are_untouched)
{
    fvi_run run = scalar_run(0.5, 0.5, 1, 1, 1);
    double kept = 7;
    int modes = 7;
    int (*const both[])(const fvi_method *, const fvi_run *,
                        double *) = { fvi_stability_number, fvi_stability_longest_step };
    const fvi_method *const fvi = &fvi_fractional;
    for (size_t i = 0; i < 2; i++) {
        fvi_run bad = run;
        ck_assert_int_eq(both[i](NULL, &run, &kept), FVI_EFAULT);
        ck_assert_int_eq(both[i](fvi, NULL, &kept), FVI_EFAULT);
        ck_assert_int_eq(both[i](fvi, &run, NULL), FVI_EFAULT);
        bad.x0 = NULL;
        ck_assert_int_eq(both[i](fvi, &bad, &kept), FVI_EFAULT);
        bad = run;
        bad.system = NULL;
        ck_assert_int_eq(both[i](fvi, &bad, &kept), FVI_EFAULT);
        const double outside[] = { -0.1, 1.1, GSL_NAN };
        for (size_t j = 0; j < LEN(outside); j++) {
            bad = run;
            bad.kappa = outside[j];
            ck_assert_int_eq(both[i](fvi, &bad, &kept), FVI_EDOM);
            bad = run;
            bad.alpha = outside[j];
            ck_assert_int_eq(both[i](fvi, &bad, &kept), FVI_EDOM);
        }
    }
    fvi_run bad = run;
    bad.h = 0;
    ck_assert_int_eq(fvi_stability_number(&fvi_fractional, &bad, &kept),
                     FVI_EDOM);
    bad.h = 1e300;
    bad.alpha = 0;
    ck_assert_int_eq(fvi_stability_number(&fvi_fractional, &bad, &kept),
                     FVI_EOVRFLW);
    bad.kappa = 0;
    ck_assert_int_eq(fvi_stability_number(&fvi_fractional, &bad, &kept),
                     FVI_EOVRFLW);

    const double wrong[][4] = { { -0.1, 0.5, 1, 1 },        { 1.1, 0.5, 1, 1 },
                                { 0.5, -0.1, 1, 1 },        { 0.5, 1.1, 1, 1 },
                                { 0.5, 0.5, 0, 1 },         { 0.5, 0.5, 1, 0 },
                                { 0.5, 0.5, 1, GSL_POSINF } };
    for (size_t i = 0; i < LEN(wrong); i++) {
        const double *w = wrong[i];
        ck_assert_int_eq(fvi_unstable_roots(w[0], w[1], w[2], w[3], &modes),
                         FVI_EDOM);
        ck_assert_int_eq(fvi_amplification(w[0], w[1], w[2], w[3], &kept), FVI_EDOM);
    }
    ck_assert_int_eq(fvi_unstable_roots(0.5, 0.5, 1, 1, NULL), FVI_EFAULT);
    ck_assert_int_eq(fvi_amplification(0.5, 0.5, 1, 1, NULL), FVI_EFAULT);
    ck_assert(kept == 7 && modes == 7);
}
END_TEST

/* The Hessian has 2^44 numbers; kappa = 1/2 needs none. */
START_TEST(a_hessian_that_finds_no_room_is_reported)
{
    enum { D = 1 << 22 };
    double *ones = malloc(D * sizeof *ones), kept = 7;
    ck_assert_ptr_nonnull(ones);
    for (size_t i = 0; i < D; i++)
        ones[i] = 1;
    fvi_system system = { D,     ones, ones, fvi_potential_harmonic(ones),
                          { 0 }, NULL, NULL };
    system.potential.diagonals = 0; /* it is never asked for */
    fvi_run run = { .system = &system, .x0 = ones, .h = 1, .alpha = 0.5 };
    ck_assert_int_eq(fvi_stability_number(&fvi_fractional, &run, &kept),
                     FVI_ENOMEM);
    ck_assert_int_eq(fvi_stability_longest_step(&fvi_fractional, &run, &kept),
                     FVI_ENOMEM);
    ck_assert_double_eq(kept, 7);
    run.kappa = 0.5;
    ck_assert_int_eq(fvi_stability_number(&fvi_fractional, &run, &kept),
                     FVI_SUCCESS);
    ck_assert_double_eq(kept, 0.5);
    free(ones);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("14 stability");
    ADD_CASE(suite, "values", eq_14_3_load_of_single_oscillators,
             eq_14_3_load_of_a_nonlinear_spring_is_that_at_the_start,
             eq_14_4_largest_step, eq_14_3_long_chains);
    ADD_CASE(suite, "errors",
             bad_questions_are_refused_and_outputs_are_untouched,
             a_hessian_that_finds_no_room_is_reported);
    return run_suite(suite);
}
