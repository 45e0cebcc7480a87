/* tests/test_step_search_passed_over.c -- Chapter 18: steps that are no steps.
 * Run alone: make test-step_search_passed_over */
#include "convolution_quadrature.h"
#include "step_search.h"
#include "ulp.h"

#include <gsl/gsl_errno.h>

static void claimed(size_t d, const double *x, const void *params, double *H)
{
    (void)d, (void)x, (void)params;
    H[0] = 0;
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
    const fvi_system system = { 1, &one, &none, u, { 0 } };
    const fvi_run run = { .system = &system,
                          .x0 = &one,
                          .p0 = &one,
                          .h = 2.2,
                          .steps = 128,
                          .kappa = 0.5,
                          .alpha = 0.5 };
    double x[129];
    fvi_step_found found;
    ck_assert_int_eq(fvi_trajectory(&fvi_shifted, &run, x, NULL, NULL),
                     GSL_EMAXITER);
    ck_assert_int_eq(
        fvi_step_search(&fvi_shifted, &run, 1e-2, 1 << 20, x, NULL, &found),
        GSL_SUCCESS);
    ck_assert(found.parts >= 8 && found.estimate <= 1e-2);
}
END_TEST

/* U = -x^2/2, where 1/h - h/4 = 0 at h = 2: the run of half the step does not even
 * start. x grows to e^512 / 2 = 10^222; a tenth of that is asked for. */
START_TEST(steps_that_do_not_start_are_passed_over)
{
    const double one = 1, none = 0, hill = -1;
    const fvi_system system = {
        1, &one, &none, fvi_potential_harmonic(&hill), { 0 }
    };
    const fvi_run run = { &system, &one, &none, 4, 128, 0.5, 0.5, 0, 0, 0 };
    double x[129];
    fvi_step_found found;
    ck_assert_int_eq(
        fvi_step_search(&fvi_shifted, &run, 1e221, 1 << 20, x, NULL, &found),
        GSL_SUCCESS);
    ck_assert_double_lt(fabs(x[128] - cosh(512)), 1e221);
}
END_TEST

int main(void)
{
    gsl_set_error_handler_off(); /* the default handler aborts */
    Suite *suite = suite_create("the search for a step: passed over");
    ADD_CASE(suite, "steps", steps_that_cannot_be_solved_are_passed_over,
             steps_that_do_not_start_are_passed_over);
    return run_suite(suite);
}
