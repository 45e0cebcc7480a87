/* tests/step_search/test_step_search_passed_over.c -- H 18: steps that are too long to be made.
 * Run alone: make test-step_search_passed_over
 *
 * All tests run under error handlers that end the process, GSL's and one of the test. A step that is too long is no
 * mistake of the caller, so no error handler may be called. */
#include <fvi/fvi.h>
#include "run/whole_run.h"
#include "error_control/step_search.h"
#include "harness/ulp.h"

#include <stdlib.h>

static int claimed(size_t d, const double *x, void *params, double *H)
{
    (void)d, (void)x, (void)params;
    H[0] = 0;
    return 0;
}

/* U = x^2/2, and 0 for its Hessian. Newton's errors are multiplied by
 * 1 - (1/h + h/4) / (1/h): -1.21 for h = 2.2, and descending from there does not
 * know how exact its gradients are. At h/8 it is 0.02, and the run goes on. */
START_TEST(steps_that_cannot_be_solved_are_passed_over)
{
    const double one = 1, none = 0;
    fvi_potential u = fvi_potential_harmonic(&one);
    u.hessian = claimed;
    u.quadratic = NULL;
    const fvi_system system = { 1, &one, &none, u, { 0 }, NULL, NULL };
    const fvi_run run = { .system = &system,
                          .x0 = &one,
                          .p0 = &one,
                          .h = 2.2,
                          .steps = 128,
                          .kappa = 0.5,
                          .alpha = 0.5 };
    double x[129];
    fvi_step_found found;
    ck_assert_int_eq(fvi_trajectory(&fvi_cq2_shifted, &run, x, NULL, NULL),
                     FVI_EMAXITER);
    ck_assert_int_eq(
        fvi_step_search(&fvi_cq2_shifted, &run, 1e-2, 1 << 20, x, NULL, &found),
        FVI_SUCCESS);
    ck_assert(found.parts >= 8 && found.estimate <= 1e-2);
}
END_TEST

/* U = -x^2/2, where 1/h - h/4 = 0 at h = 2: the run of half the step, or that of the
 * caller's, does not even start. x grows to e^512 / 2 = 10^222, or e^256 / 2; a
 * tenth of that is asked for. */
START_TEST(steps_that_do_not_start_are_passed_over)
{
    const double one = 1, none = 0, hill = -1, h[] = { 4, 2 };
    const fvi_system system = { 1,     &one,
                                &none, fvi_potential_harmonic(&hill),
                                { 0 }, NULL, NULL };
    for (size_t i = 0; i < 2; i++) {
        const fvi_run run = {
            .system = &system,
            .x0 = &one,
            .p0 = &none,
            .h = h[i],
            .steps = 128,
            .kappa = 0.5,
            .alpha = 0.5,
        };
        const double end = cosh(128 * h[i]);
        double x[129];
        fvi_step_found found;
        ck_assert_int_eq(fvi_step_search(&fvi_cq2_shifted, &run, end / 20, 1 << 20,
                                         x, NULL, &found),
                         FVI_SUCCESS);
        ck_assert_double_lt(fabs(x[128] - end), end / 20);
    }
}
END_TEST

/* h w = 1280 and explicit damping: all steps allowed overflow. And 10^-30 is not
 * reached: that is no mistake either. */
START_TEST(a_search_in_vain_ends_no_process)
{
    const double one = 1, rho = 1e9, c[] = { 1e8, 1 };
    double x[129];
    fvi_step_found found;
    for (size_t i = 0; i < 2; i++) {
        const fvi_system system = {
            1,     &one, i == 0 ? &rho : &one, fvi_potential_harmonic(c + i),
            { 0 }, NULL, NULL
        };
        const fvi_run run = {
            .system = &system,
            .x0 = &one,
            .p0 = &one,
            .h = 0.128,
            .steps = 128,
            .kappa = 0.5,
            .alpha = 0.3,
        };
        ck_assert_int_eq(fvi_step_search(&fvi_fractional, &run, 1e-30, 1 << 12,
                                         x, NULL, &found),
                         FVI_ETOL);
        ck_assert_int_eq(isinf(found.estimate) != 0, i == 0);
    }
}
END_TEST

static void end(const char *reason, const char *file, int line, int code)
{
    fprintf(stderr, "%s:%d: %s (%d)\n", file, line, reason, code);
    abort();
}

int main(void)
{
    fvi_set_error_handler(end);
    Suite *suite = suite_create("the search for a step: passed over");
    ADD_CASE(suite, "steps", steps_that_cannot_be_solved_are_passed_over,
             steps_that_do_not_start_are_passed_over,
             a_search_in_vain_ends_no_process);
    return run_suite(suite);
}
