/* tests/fvi/test_trajectory_failures.c -- Steps that fail: numbers that are no longer finite, and equations that
 * cannot be solved.
 * Run alone: make test-trajectory_failures */
#include <fvi/fvi.h>
#include "run/whole_run.h"
#include <fvi/paper/algorithm_3.h>
#include "harness/ulp.h"

#include <gsl/gsl_math.h>

static const double one[] = { 1 }, none[] = { 0 };

/* ---- potentials that no step can cope with, in one dimension ---- */

static int no_value(size_t d, const double *x, void *params, double *value)
{
    (void)d, (void)params;
    *value = fabs(x[0]);
    return 0;
}

/* grad U = sign(x): Newton's method jumps to and fro. */
static int sign(size_t d, const double *x, void *params, double *g)
{
    (void)d, (void)params;
    g[0] = x[0] >= 0 ? 1 : -1;
    return 0;
}

/* The Hessian is a number that the test chooses, and not the right one. */
static int claimed(size_t d, const double *x, void *params, double *H)
{
    (void)d, (void)x;
    H[0] = *(const double *)params;
    return 0;
}

/* ---- failures ---- */

/* What comes out of a step is no mistake of the caller: no handler hears of it. */
static void unheard(const char *reason, const char *file, int line, int code)
{
    ck_abort_msg("%s:%d: %s (%d)", file, line, reason, code);
}

/* x = 1, 1e100, 1e200, 1e300: the step from k = 3 leaves the doubles. */
START_TEST(a_value_that_stops_being_finite_is_reported_with_its_step)
{
    fvi_error_handler *before = fvi_set_error_handler(unheard);
    const double c = -1e100;
    const fvi_system system = { 1,     one, one, fvi_potential_harmonic(&c),
                                { 0 }, NULL, NULL };
    const fvi_run run = { .system = &system,
                          .x0 = one,
                          .p0 = none,
                          .h = 1,
                          .steps = 5,
                          .kappa = 1,
                          .alpha = 0.3 };
    double x[6] = { 7, 7, 7, 7, 7, 7 };
    ck_assert_int_eq(fvi_trajectory(&fvi_fractional, &run, x, NULL, NULL),
                     FVI_EOVRFLW);
    for (size_t k = 0; k < 4; k++)
        ck_assert_near(x[k] / pow(10, 100. * (double)k), 1, 1e-13, "k = %zu",
                       k);
    ck_assert_double_eq(x[4], 7); /* rows that are not there are not written */
    fvi_stepper *s;
    ck_assert_int_eq(fvi_stepper_start(&fvi_fractional, &run, &s,
                                       NULL), FVI_SUCCESS);
    while (fvi_stepper_step(s) == FVI_SUCCESS)
        continue;
    ck_assert_uint_eq(s->k, 3);
    fvi_stepper_free(s);
    fvi_set_error_handler(before);
}
END_TEST

static int explodes(double t, size_t d, void *params, double *F)
{
    (void)params;
    for (size_t i = 0; i < d; i++)
        F[i] = t >= 4 ? GSL_DBL_MAX : 0; /* twice of it is infinite */
    return 0;
}

/* A force that is too large reaches the momentum one step before the position. */
START_TEST(a_momentum_that_stops_being_finite_is_reported_at_once)
{
    const fvi_system system = {
        1, one, none, { 0 }, { .value = explodes }, NULL, NULL
    };
    const fvi_run run = { .system = &system,
                          .x0 = one,
                          .p0 = none,
                          .h = 2,
                          .steps = 5,
                          .kappa = 0.5,
                          .alpha = 0.5 };
    fvi_stepper *s;
    ck_assert_int_eq(fvi_stepper_start(&fvi_fractional, &run, &s,
                                       NULL), FVI_SUCCESS);
    ck_assert_int_eq(fvi_stepper_step(s), FVI_SUCCESS);
    ck_assert_int_eq(fvi_stepper_step(s), FVI_EOVRFLW);
    ck_assert_uint_eq(s->k, 1);
    fvi_stepper_free(s);
}
END_TEST

/* The equation of a step is d + g(x + d/2)/2 = 1 here. */
START_TEST(a_step_that_cannot_be_solved_is_reported)
{
    const struct {
        double hessian, x0;
        int status;
    } bad[] = {
        { 0, -0.5, FVI_EMAXITER }, /* 1.5 or 0.5, and back */
        { -4, -0.5, FVI_ESING },   /* J = 1 - 4/4 */
    };
    for (size_t i = 0; i < LEN(bad); i++) {
        const fvi_system system = {
            1,
            one,
            one,
            { no_value, sign, claimed, (void *)&bad[i].hessian, 0, 0, 0, NULL },
            { 0 },
            NULL, NULL
        };
        const fvi_run run = { .system = &system,
                              .x0 = &bad[i].x0,
                              .p0 = one,
                              .h = 1,
                              .steps = 5,
                              .kappa = 0.5,
                              .alpha = 0.3 };
        fvi_stepper *s;
        ck_assert_int_eq(fvi_stepper_start(&fvi_fractional, &run, &s,
                                           NULL), FVI_SUCCESS);
        ck_assert_int_eq(fvi_stepper_step(s), bad[i].status);
        ck_assert_uint_eq(s->k, 0);
        fvi_stepper_free(s);
        double x[6] = { 7, 7, 7, 7, 7, 7 };
        ck_assert_int_eq(
            fvi_algorithm_3(&system, 0.3, 0.5, 1, 5, run.x0[0], 1, x),
            bad[i].status);
        ck_assert_double_eq(x[0], 7);
    }
}
END_TEST

/* The same equation, or, for the implicit Euler method, d + g(x + d) = 1. */
START_TEST(every_implicit_method_reports_a_step_that_cannot_be_solved)
{
    const fvi_method *const methods[] = {
        &fvi_midpoint_variational, &fvi_lagrange_dalembert,
        &fvi_fractional,  &fvi_cq2_shifted,
        &fvi_cq_bdf2,        &fvi_euler_implicit
    };
    for (size_t i = 0; i < 2 * LEN(methods); i++) {
        const fvi_method *method = methods[i / 2];
        const double full = method == &fvi_euler_implicit ? -1 : -4;
        const double x0 = -0.5, hessian = i % 2 ? full : 0;
        const fvi_system system = {
            1,     one,
            none,  { no_value, sign, claimed, (void *)&hessian, 0, 0, 0, NULL },
            { 0 }, NULL, NULL
        };
        const fvi_run run = { .system = &system,
                              .x0 = &x0,
                              .p0 = one,
                              .h = 1,
                              .steps = 5,
                              .kappa = 0.5,
                              .alpha = 0.5 };
        fvi_stepper *s;
        ck_assert_int_eq(fvi_stepper_start(method, &run, &s,
                                           NULL), FVI_SUCCESS);
        ck_assert_int_eq(fvi_stepper_step(s), i % 2 ? FVI_ESING : FVI_EMAXITER);
        ck_assert_uint_eq(s->k, 0);
        fvi_stepper_free(s);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("trajectory: steps that fail");
    ADD_CASE(suite, "failures", a_value_that_stops_being_finite_is_reported_with_its_step,
             a_momentum_that_stops_being_finite_is_reported_at_once,
             a_step_that_cannot_be_solved_is_reported,
             every_implicit_method_reports_a_step_that_cannot_be_solved);
    return run_suite(suite);
}
