/* tests/fvi/test_trajectory.c -- Runs: rows as they come, rows in arrays, and what is
 * refused. Run alone: make test-trajectory */
#include <fvi/fvi.h>
#include "run/whole_run.h"
#include <fvi/paper/algorithm_3.h>
#include "harness/energy.h"
#include "harness/ulp.h"

#include <gsl/gsl_math.h>

static const double one[] = { 1, 1 }, none[] = { 0, 0 }, half[] = { 0.5, -0.5 };

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

/* ---- rows ---- */

/* Printed as they come, or stored, with or without the rest: the same bits. */
START_TEST(rows_are_the_same_streamed_and_stored)
{
    enum { N = 40 };
    const double cg[] = { 1, 0.5 };
    const double rho[] = { 0.5, 0.25 };
    const fvi_system system = { 2,     one, rho, fvi_potential_chain(cg),
                                { 0 }, NULL, NULL };
    const fvi_run run = { .system = &system,
                          .x0 = one,
                          .p0 = half,
                          .h = 0.1,
                          .steps = N,
                          .kappa = 0.5,
                          .alpha = 0.3 };
    double x[2 * N + 2], p[2 * N + 2], energy[N + 1], only[2 * N + 2];
    ck_assert_int_eq(fvi_trajectory(&fvi_fractional, &run, x, p, energy), 0);
    ck_assert_int_eq(fvi_trajectory(&fvi_fractional, &run, NULL, only, NULL),
                     0);
    ck_assert_mem_eq(p, only, sizeof p);
    fvi_stepper *s;
    ck_assert_int_eq(fvi_stepper_start(&fvi_fractional, &run, &s,
                                       NULL), FVI_SUCCESS);
    for (size_t k = 0; k <= N; k++) {
        ck_assert_uint_eq(s->k, k);
        ck_assert_double_eq(s->t, (double)k * 0.1);
        ck_assert_mem_eq(s->x, x + 2 * k, 2 * sizeof *x);
        ck_assert_mem_eq(s->p, p + 2 * k, 2 * sizeof *p);
        ck_assert_double_eq(energy[k], energy_of(&system, s->x, s->p));
        ck_assert_int_eq(fvi_stepper_step(s), k < N ? FVI_SUCCESS : FVI_EINVAL);
    }
    ck_assert_uint_eq(s->k, N); /* the run was over, and nothing was touched */
    ck_assert_mem_eq(s->x, x + 2 * N, 2 * sizeof *x);
    fvi_stepper_free(s);
}
END_TEST

/* 2^50 steps are announced: no room for them is taken where there is no damping,
 * nor where the damping has two or three weights. */
START_TEST(what_needs_no_memory_takes_none)
{
    const double c = 1, alphas[] = { 0.3, 0, 0.5, 1 };
    for (size_t i = 0; i < LEN(alphas); i++) {
        const fvi_system system = {
            1,     one, i == 0 ? none : half, fvi_potential_harmonic(&c),
            { 0 }, NULL, NULL
        };
        const fvi_run run = { .system = &system,
                              .x0 = one,
                              .p0 = one,
                              .h = 0.1,
                              .steps = (size_t)1 << 50,
                              .kappa = 0.5,
                              .alpha = alphas[i],
                              .memory = FVI_HISTORY_DIRECT };
        fvi_stepper *s;
        ck_assert_int_eq(fvi_stepper_start(&fvi_fractional, &run, &s,
                                           NULL), FVI_SUCCESS);
        for (size_t k = 0; k < 100; k++)
            ck_assert_int_eq(fvi_stepper_step(s), FVI_SUCCESS);
        fvi_stepper_free(s);
    }
}
END_TEST

/* ---- errors ---- */

START_TEST(start_refuses)
{
    const double minus[] = { -1 }, singular = -4, c = 1;
    fvi_system good = { 1, one, one, fvi_potential_harmonic(&c), { 0 }, NULL, NULL };
    fvi_system no_mass = good, bad_mass = good, no_room = good, partial = good,
               nothing = good, caves_in = good, pushed = good;
    no_mass.mass = NULL;
    bad_mass.mass = minus;
    no_room.d = SIZE_MAX;
    partial.potential.hessian = NULL;
    nothing.d = 0;
    caves_in.potential = fvi_potential_harmonic(&singular); /* 1 - 4/4 = 0 */
    pushed.damping = none;
    pushed.force = fvi_force_step(one);
    const double nan = GSL_NAN, inf = GSL_POSINF;
    const fvi_run run = { .system = &good,
                          .x0 = one,
                          .p0 = one,
                          .h = 1,
                          .steps = 3,
                          .kappa = 0.5,
                          .alpha = 0.3 };
#define WITH(field, value, code)                                               \
    {                                                                          \
        fvi_run bad = run;                                                     \
        bad.field = (value);                                                   \
        fvi_stepper *s = (fvi_stepper *)&bad;                                  \
        ck_assert_int_eq(fvi_stepper_start(&fvi_fractional, &bad, &s, NULL), code);          \
        ck_assert_ptr_eq(s, &bad);                                             \
        double x[] = { 7 };                                                    \
        ck_assert_int_eq(fvi_trajectory(&fvi_fractional, &bad, x, x, x),       \
                         code);                                                \
        ck_assert_double_eq(x[0], 7);                                          \
    }
    WITH(system, NULL, FVI_EFAULT)
    WITH(system, &no_mass, FVI_EFAULT)
    WITH(system, &bad_mass, FVI_EDOM)
    WITH(system, &no_room, FVI_EINVAL)
    WITH(system, &partial, FVI_EINVAL)
    WITH(system, &nothing, FVI_EINVAL)
    WITH(system, &caves_in, FVI_ESING)
    WITH(x0, NULL, FVI_EFAULT)
    WITH(p0, NULL, FVI_EFAULT)
    WITH(x0, &nan, FVI_EDOM)
    WITH(p0, &inf, FVI_EDOM)
    WITH(steps, 0, FVI_EINVAL)
    WITH(steps, SIZE_MAX, FVI_EINVAL)
    WITH(h, 0, FVI_EDOM)
    WITH(h, -0.1, FVI_EDOM)
    WITH(h, nan, FVI_EDOM)
    WITH(h, inf, FVI_EDOM)
    WITH(kappa, -0.1, FVI_EDOM)
    WITH(kappa, 1.1, FVI_EDOM)
    WITH(kappa, nan, FVI_EDOM)
    WITH(alpha, -0.1, FVI_EDOM)
    WITH(alpha, 1.1, FVI_EDOM)
    WITH(alpha, nan, FVI_EDOM)
    WITH(tolerance, -1, FVI_EDOM)
    WITH(tolerance, 1, FVI_EDOM)
    WITH(tolerance, nan, FVI_EDOM)
    WITH(memory, (fvi_history_kind)99, FVI_EINVAL)
#undef WITH
    fvi_stepper *s = NULL;
    ck_assert_int_eq(fvi_stepper_start(NULL, &run, &s, NULL), FVI_EFAULT);
    ck_assert_int_eq(fvi_stepper_start(&fvi_fractional, NULL, &s,
                                       NULL), FVI_EFAULT);
    ck_assert_int_eq(fvi_stepper_start(&fvi_fractional, &run, NULL,
                                       NULL), FVI_EFAULT);
    ck_assert_int_eq(fvi_stepper_start(&fvi_midpoint_variational, &run, &s,
                                       NULL), FVI_EINVAL);
    ck_assert_int_eq(fvi_stepper_start(&fvi_lagrange_dalembert, &run, &s,
                                       NULL), FVI_EDOM);
    fvi_run forced = run;
    forced.system = &pushed;
    ck_assert_int_eq(fvi_stepper_start(&fvi_midpoint_variational, &forced, &s,
                                       NULL), FVI_EINVAL);
    ck_assert_ptr_null(s);
    fvi_run undamped = forced; /* no memory is there to refuse these */
    undamped.alpha = 1.1;
    ck_assert_int_eq(fvi_stepper_start(&fvi_fractional, &undamped, &s,
                                       NULL), FVI_EDOM);
    undamped.alpha = 0.5;
    undamped.h = -0.1; /* nor a solver */
    ck_assert_int_eq(fvi_stepper_start(&fvi_euler_explicit, &undamped, &s,
                                       NULL), FVI_EDOM);
    undamped.h = 1;
    undamped.tolerance = 1;
    ck_assert_int_eq(fvi_stepper_start(&fvi_fractional, &undamped, &s,
                                       NULL), FVI_EDOM);
    ck_assert_ptr_null(s);
    fvi_run long_run = forced; /* starts, but cannot be stored */
    long_run.steps = SIZE_MAX;
    double x[] = { 7 };
    ck_assert_int_eq(fvi_trajectory(&fvi_fractional, &long_run, x, NULL, NULL),
                     FVI_EINVAL);
    ck_assert_double_eq(x[0], 7);
    ck_assert_int_eq(fvi_stepper_step(NULL), FVI_EFAULT);
    fvi_stepper_free(NULL);
}
END_TEST

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
        F[i] = t >= 2 ? GSL_POSINF : 0;
    return 0;
}

/* An infinite force reaches the momentum one step before the position. */
START_TEST(a_momentum_that_stops_being_finite_is_reported_at_once)
{
    const fvi_system system = {
        1, one, none, { 0 }, { .value = explodes }, NULL, NULL
    };
    const fvi_run run = { .system = &system,
                          .x0 = one,
                          .p0 = none,
                          .h = 1,
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
            { no_value, sign, claimed, (void *)&bad[i].hessian, 0, 0, 0 },
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
            none,  { no_value, sign, claimed, (void *)&hessian, 0, 0, 0 },
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

START_TEST(algorithm_3_refuses)
{
    const double minus = -1, c = 1;
    const fvi_system good = { 1,     one, one, fvi_potential_harmonic(&c),
                              { 0 }, NULL, NULL };
    fvi_system two = good, light = good, undamped = good;
    two.d = 2;
    light.mass = &minus;
    undamped.damping = none;
    const struct {
        const fvi_system *system;
        double alpha, kappa, h;
        size_t N;
        double x0, p0;
        int status;
    } bad[] = {
        { NULL, 0.5, 0.5, 0.1, 3, 1, 1, FVI_EFAULT },
        { &two, 0.5, 0.5, 0.1, 3, 1, 1, FVI_EINVAL },
        { &light, 0.5, 0.5, 0.1, 3, 1, 1, FVI_EDOM },
        { &good, -0.1, 0.5, 0.1, 3, 1, 1, FVI_EDOM },
        { &good, 1.1, 0.5, 0.1, 3, 1, 1, FVI_EDOM },
        { &good, GSL_NAN, 0.5, 0.1, 3, 1, 1, FVI_EDOM },
        { &good, 0.5, -0.1, 0.1, 3, 1, 1, FVI_EDOM },
        { &good, 0.5, 1.1, 0.1, 3, 1, 1, FVI_EDOM },
        { &good, 0.5, 0.5, 0, 3, 1, 1, FVI_EDOM },
        { &good, 0.5, 0.5, GSL_POSINF, 3, 1, 1, FVI_EDOM },
        { &good, 0.5, 0.5, 0.1, 0, 1, 1, FVI_EINVAL },
        { &good, 0.5, 0.5, 0.1, SIZE_MAX, 1, 1, FVI_EINVAL },
        { &undamped, 0.5, 0.5, 0.1, (size_t)1 << 50, 1, 1, FVI_ENOMEM },
        { &good, 0.5, 0.5, 0.1, 3, GSL_NAN, 1, FVI_EDOM },
        { &good, 0.5, 0.5, 0.1, 3, 1, GSL_POSINF, FVI_EDOM },
        { &good, 0.5, 0.5, 1, 3, 1e308, 1.7e308, FVI_EOVRFLW },
        { &good, 1, 0.5, 1e-200, 3, 1, 1, FVI_EOVRFLW },
    };
    for (size_t i = 0; i < LEN(bad); i++) {
        double x[4] = { 7, 7, 7, 7 };
        int status =
            fvi_algorithm_3(bad[i].system, bad[i].alpha, bad[i].kappa, bad[i].h,
                            bad[i].N, bad[i].x0, bad[i].p0, x);
        ck_assert_msg(status == bad[i].status, "row %zu: %d", i, status);
        for (size_t k = 0; k < 4; k++)
            ck_assert_double_eq(x[k], 7);
    }
    ck_assert_int_eq(fvi_algorithm_3(&good, 0.5, 0.5, 0.1, 3, 1, 1, NULL),
                     FVI_EFAULT);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("trajectory");
    ADD_CASE(suite, "rows", rows_are_the_same_streamed_and_stored,
             what_needs_no_memory_takes_none);
    ADD_CASE(suite, "errors", start_refuses,
             a_value_that_stops_being_finite_is_reported_with_its_step,
             a_momentum_that_stops_being_finite_is_reported_at_once,
             a_step_that_cannot_be_solved_is_reported,
             every_implicit_method_reports_a_step_that_cannot_be_solved,
             algorithm_3_refuses);
    return run_suite(suite);
}
