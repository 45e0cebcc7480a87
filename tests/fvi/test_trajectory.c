/* tests/fvi/test_trajectory.c -- Runs: rows one by one, rows in arrays, and runs that are refused.
 * Run alone: make test-trajectory */
#include <fvi/fvi.h>
#include "run/whole_run.h"
#include <fvi/paper/algorithm_3.h>
#include "harness/energy.h"
#include "harness/ulp.h"

#include <gsl/gsl_math.h>

static const double one[] = { 1, 1 }, none[] = { 0, 0 }, half[] = { 0.5, -0.5 };

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
    ADD_CASE(suite, "errors", start_refuses, algorithm_3_refuses);
    return run_suite(suite);
}
