/* tests/stability/test_stability_warnings.c -- The warnings of a run that is not reliable.
 * Run alone: make test-stability_warnings */
#include "scalar_run.h"

#include <stdint.h>
#include <string.h>

START_TEST(a_run_without_a_solution_is_warned_of)
{
    const char *text = "left";
    fvi_run run = scalar_run(0.8, 0.5, 1, 0.2, 10);
    run.past = FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE;
    x0 = 0;
    ck_assert_int_eq(fvi_warning_of_initial_history(&run, &text), 0);
    ck_assert_ptr_null(text);
    x0 = 1;
    ck_assert_int_eq(fvi_warning_of_initial_history(&run, &text), 1);
    ck_assert_ptr_nonnull(strstr(text, "no solution"));
    run.alpha = 0.5;
    ck_assert_int_eq(fvi_warning_of_initial_history(&run, &text), 0);
    ck_assert_ptr_null(text);
    run.alpha = 0.8;
    rho = 0;
    ck_assert_int_eq(fvi_warning_of_initial_history(&run, &text), 0);
    ck_assert_ptr_null(text);
    run.past = FVI_INITIAL_HISTORY_HELD;
    rho = 0.2;
    ck_assert_int_eq(fvi_warning_of_initial_history(&run, &text), 0);
    ck_assert_ptr_null(text);
    x0 = 0;
}
END_TEST

/* kappa = 1/2: load = 4^alpha R / 4, R = rho at h = m = 1. */
START_TEST(a_step_that_is_too_long_is_warned_of)
{
    char text[FVI_WARNING_ROOM] = "left";
    fvi_run run = scalar_run(0.5, 0.5, 1, 1.99, 10);
    ck_assert(!fvi_warning_of_step(&fvi_fractional, &run, sizeof text, text));
    ck_assert_str_eq(text, "");
    rho = 2.02;
    ck_assert(fvi_warning_of_step(&fvi_fractional, &run, sizeof text, text));
    ck_assert_str_eq(text, "this step is unstable (load 1.01, above 1); "
                           "stable below h = 0.9901");
    ck_assert(!fvi_warning_of_step(&fvi_variable_step, &run, sizeof text, text));
    run.alpha = 1;
    ck_assert(fvi_warning_of_step(&fvi_fractional, &run, sizeof text, text));
    ck_assert_str_eq(text, "this step is unstable (load 2.02, above 1); "
                           "no step is stable: rho / m is 2.02");
}
END_TEST

/* U = x^4 / 4, kappa = 1: load = 3 x^2 h^2 / 4 is 0 at the start and above 1 beyond 1.16. */
START_TEST(a_run_that_gets_stiffer_is_warned_of_once)
{
    static const double cg[2] = { 0, 1 };
    char text[FVI_WARNING_ROOM] = "left";
    fvi_run run = scalar_run(0.5, 1, 1, 0, 100);
    scalar.potential = fvi_potential_duffing(cg);
    fvi_watch watch = fvi_watch_begin(&fvi_fractional, &run, 0);
    const double near = 1.1, far = 1.2;
    for (size_t k = 1; k < 8; k++)
        ck_assert(!fvi_warning_along(&watch, &fvi_fractional, &run, k, &near,
                                     sizeof text, text));
    ck_assert_str_eq(text, "left");
    ck_assert(fvi_warning_along(&watch, &fvi_fractional, &run, 8, &far,
                                sizeof text, text));
    ck_assert_str_eq(text, "this step is unstable where the run is at t = 8 "
                           "(load 1.08, above 1)");
    ck_assert(!fvi_warning_along(&watch, &fvi_fractional, &run, 16, &far,
                                 sizeof text, text));
    ck_assert(fvi_watch_begin(&fvi_fractional, &run, 1).next == SIZE_MAX);
    run.kappa = 0.5; /* the load knows no U */
    ck_assert(fvi_watch_begin(&fvi_fractional, &run, 0).next == SIZE_MAX);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("14 stability, warnings");
    ADD_CASE(suite, "values", a_run_without_a_solution_is_warned_of,
             a_step_that_is_too_long_is_warned_of,
             a_run_that_gets_stiffer_is_warned_of_once);
    return run_suite(suite);
}
