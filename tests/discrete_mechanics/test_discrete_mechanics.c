/* tests/discrete_mechanics/test_discrete_mechanics.c -- H 2: trajectories of the methods without memory.
 * Run alone: make test-discrete_mechanics */
#include <fvi/discrete_mechanics.h>
#include <fvi/error.h>
#include "harness/fvi_runs.h"
#include "harness/ulp.h"

#include "discrete_mechanics_ref.h"
#include "discrete_mechanics_runs_ref.h"

#include <gsl/gsl_math.h>

static const double none[3], one[] = { 1, 1, 1 };

static int ramp(double t, size_t d, void *params, double *F)
{
    const double *slope = params;
    for (size_t i = 0; i < d; i++)
        F[i] = slope[i] * t;
    return 0;
}

/* ---- values ---- */

/* Short binary fractions: every operation is exact. 0 ulp by design. */
START_TEST(eq_2_5_and_2_6_the_discrete_lagrangian)
{
    const double mass[] = { 1, 1.5 }, x[] = { 0.5, -0.25 },
                 y[] = { 0.75, 0.125 };
    for (size_t r = 0; r < LEN(ref_lagrangian); r++) {
        const fvi_system system = {
            2,     mass,
            one,   potential(ref_lagrangian[r].kind, ref_lagrangian[r].cg),
            { 0 }, NULL, NULL
        };
        const double kappa = ref_lagrangian[r].kappa;
        double L, D1[2], D2[2], only[2];
        ck_assert_int_eq(
            fvi_discrete_lagrangian(&system, kappa, 0.25, x, y, &L), 0);
        ck_assert_ulp(L, ref_lagrangian[r].L, 0, "L, row %zu", r);
        ck_assert_int_eq(
            fvi_discrete_slopes(&system, kappa, 0.25, x, y, D1, D2), 0);
        for (size_t i = 0; i < 2; i++) {
            ck_assert_ulp(D1[i], ref_lagrangian[r].D1[i], 0, "D1, row %zu", r);
            ck_assert_ulp(D2[i], ref_lagrangian[r].D2[i], 0, "D2, row %zu", r);
        }
        fvi_discrete_slopes(&system, kappa, 0.25, x, y, only, NULL);
        ck_assert_mem_eq(only, D1, sizeof D1);
        fvi_discrete_slopes(&system, kappa, 0.25, x, y, NULL, only);
        ck_assert_mem_eq(only, D2, sizeof D2);
    }
}
END_TEST

/* (2.7), (2.8), (2.13). The script that made the rows also bounds the rounding of
 * each, in units of u: every error at its worst and none against another.
 * Seen: 0.5 of the bound. */
START_TEST(eq_2_7_and_2_8_trajectories_are_the_exact_ones)
{
    for (size_t r = 0; r < LEN(ref_runs); r++) {
        const size_t d = ref_runs[r].d, rows = (ref_runs[r].steps + 1) * d;
        fvi_system system = { d,
                              ref_runs[r].mass,
                              ref_runs[r].rho,
                              potential(ref_runs[r].kind, ref_runs[r].cg),
                              { 0 },
                              NULL, NULL };
        if (ref_runs[r].method != &fvi_midpoint_variational)
            system.force = (fvi_force){ .value = ramp,
                                        .params = (void *)ref_runs[r].ramp };
        const setup a = { .alpha = 0.5,
                          .kappa = ref_runs[r].kappa,
                          .h = ref_runs[r].h,
                          .steps = ref_runs[r].steps };
        double x[40], p[40];
        run(ref_runs[r].method, &a, &system, ref_runs[r].x0, ref_runs[r].p0, x,
            p);
        for (size_t j = 0; j < rows; j++) {
            const size_t row = ref_runs[r].first + j;
            ck_assert_near(x[j], ref_rows[row].x, ref_rows[row].x_units * U,
                           "%s: x, k = %zu", ref_runs[r].name, j / d);
            ck_assert_near(p[j], ref_rows[row].p, ref_rows[row].p_units * U,
                           "%s: p, k = %zu", ref_runs[r].name, j / d);
        }
    }
}
END_TEST

/* ---- identities ---- */

static const double quartic[] = { 1, 2 }, mass3[] = { 1, 2, 0.5 };
static const double start_x[] = { 0.5, -0.75, 1 },
                    start_p[] = { 1, 0.25, -0.5 };

/* The positions of a run put back into (2.7) or (2.8), three masses in a quartic
 * chain. Each stored x is rounded by u |x|, which the slopes multiply by m/h; the
 * slopes and p have some 10 roundings of terms that are at most (m/h) max |x|.
 * In all less than 64 u max(m) max|x| / h. Seen: 0.013 of it. */
START_TEST(eq_2_7_runs_make_the_action_stationary)
{
    enum { N = 200 };
    const double rho[] = { 0.5, 0, 1 }, push[] = { 0.25, 0, -0.5 };
    double x[3 * (N + 1)];
    for (int forced = 0; forced <= 1; forced++)
        for (double kappa = 0; kappa <= 1; kappa += 0.25) {
            const fvi_system system = { 3,
                                        mass3,
                                        forced ? rho : none,
                                        fvi_potential_chain(quartic),
                                        { .value = forced ? ramp : NULL,
                                          .params = (void *)push },
                                        NULL, NULL };
            const setup a = {
                .alpha = 0.5, .kappa = kappa, .h = 0.05, .steps = N
            };
            run(forced ? &fvi_lagrange_dalembert : &fvi_midpoint_variational, &a,
                &system, start_x, start_p, x, NULL);
            const double size = farthest(LEN(x), x, NULL);
            for (size_t k = 1; k < N; k++) {
                const double *at = x + 3 * k;
                double D1[3], D2[3];
                fvi_discrete_slopes(&system, kappa, a.h, at, at + 3, D1, NULL);
                fvi_discrete_slopes(&system, kappa, a.h, at - 3, at, NULL, D2);
                for (size_t i = 0; i < 3; i++) {
                    double f = -rho[i] * (at[i] - at[i - 3])
                               + a.h * push[i] * (double)k * a.h;
                    ck_assert_near(D1[i] + D2[i] + (forced ? f : 0), 0,
                                   64 * U * 2 * size / a.h, "kappa %g, k %zu",
                                   kappa, k);
                }
            }
        }
}
END_TEST

/* The inverse of a step is the step with 1 - kappa, momenta reversed: p = -D1 and
 * p = D2 change places. There and back 2 x 20 steps; a step makes errors of less
 * than 32 u max|z|, and multiplies older ones by at most 1 + h Lambda, where
 * Lambda = max(1/m, |Hess U|) < 64. h = 1/1024. Seen: 8e-5 of the bound. */
START_TEST(eq_2_9_time_runs_back_with_1_minus_kappa)
{
    enum { N = 20 };
    const fvi_system system = { 3,     mass3,
                                none,  fvi_potential_chain(quartic),
                                { 0 }, NULL, NULL };
    for (double kappa = 0; kappa <= 1; kappa += 0.25) {
        setup a = { .kappa = kappa, .h = 0x1p-10, .steps = N };
        double x[3 * (N + 1)], p[3 * (N + 1)], reversed[3];
        run(&fvi_midpoint_variational, &a, &system, start_x, start_p, x, p);
        for (size_t i = 0; i < 3; i++)
            reversed[i] = -p[3 * N + i];
        a.kappa = 1 - kappa;
        run(&fvi_midpoint_variational, &a, &system, x + 3 * N, reversed, x, p);
        const double bound = 2 * N * 32 * U * 2 * exp(2 * N * a.h * 64);
        for (size_t i = 0; i < 3; i++) {
            ck_assert_near(x[3 * N + i], start_x[i], bound, "x, %g", kappa);
            ck_assert_near(-p[3 * N + i], start_p[i], bound, "p, %g", kappa);
        }
    }
}
END_TEST

/* ---- errors ---- */

START_TEST(bad_arguments_are_refused_and_outputs_untouched)
{
    const fvi_system good = { 1,     one, none, fvi_potential_harmonic(one),
                              { 0 }, NULL, NULL };
    fvi_system bad = good;
    bad.mass = none;
    double L = 7, D[2] = { 7, 7 };
    const double x = 1, y = 2;
#define BOTH(code, system, kappa, h, a, b)                                     \
    ck_assert_int_eq(fvi_discrete_lagrangian(system, kappa, h, a, b, &L),      \
                     code);                                                    \
    ck_assert_int_eq(fvi_discrete_slopes(system, kappa, h, a, b, D, D + 1),    \
                     code)
    BOTH(FVI_EFAULT, NULL, 0.5, 1, &x, &y);
    BOTH(FVI_EDOM, &bad, 0.5, 1, &x, &y);
    BOTH(FVI_EFAULT, &good, 0.5, 1, NULL, &y);
    BOTH(FVI_EFAULT, &good, 0.5, 1, &x, NULL);
    BOTH(FVI_EDOM, &good, -0x1p-1074, 1, &x, &y);
    BOTH(FVI_EDOM, &good, 1 + 0x1p-52, 1, &x, &y);
    BOTH(FVI_EDOM, &good, GSL_NAN, 1, &x, &y);
    BOTH(FVI_EDOM, &good, 0.5, 0, &x, &y);
    BOTH(FVI_EDOM, &good, 0.5, -1, &x, &y);
    BOTH(FVI_EDOM, &good, 0.5, GSL_NAN, &x, &y);
    BOTH(FVI_EDOM, &good, 0.5, GSL_POSINF, &x, &y);
    ck_assert_int_eq(fvi_discrete_lagrangian(&good, 0.5, 1, &x, &y, NULL),
                     FVI_EFAULT);
    ck_assert(L == 7 && D[0] == 7 && D[1] == 7);
}
END_TEST

/* Algorithm 1 has no place for damping or force; the others know alpha = 1/2. */
START_TEST(methods_refuse_what_they_do_not_know)
{
    const double kick[] = { 1, 1 };
    fvi_system system = {
        1, one, one, fvi_potential_harmonic(one), { 0 }, NULL, NULL
    };
    fvi_run r = { .system = &system,
                  .x0 = one,
                  .p0 = one,
                  .h = 0.1,
                  .steps = 1,
                  .kappa = 0.5,
                  .alpha = 0.5 };
    fvi_stepper *const kept = (fvi_stepper *)&r, *s = kept;
    ck_assert_int_eq(fvi_stepper_start(&fvi_midpoint_variational, &r, &s,
                                       NULL), FVI_EINVAL);
    system.damping = none;
    system.force = fvi_force_step(kick);
    ck_assert_int_eq(fvi_stepper_start(&fvi_midpoint_variational, &r, &s,
                                       NULL), FVI_EINVAL);
    r.alpha = 0.25;
    ck_assert_int_eq(fvi_stepper_start(&fvi_lagrange_dalembert, &r, &s,
                                       NULL), FVI_EDOM);
    ck_assert_int_eq(fvi_stepper_start(&fvi_euler_explicit, &r, &s,
                                       NULL), FVI_EDOM);
    ck_assert_int_eq(fvi_stepper_start(&fvi_euler_implicit, &r, &s,
                                       NULL), FVI_EDOM);
    ck_assert_ptr_eq(s, kept);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("02 discrete mechanics");
    ADD_CASE(suite, "values", eq_2_5_and_2_6_the_discrete_lagrangian,
             eq_2_7_and_2_8_trajectories_are_the_exact_ones);
    ADD_CASE(suite, "identities", eq_2_7_runs_make_the_action_stationary,
             eq_2_9_time_runs_back_with_1_minus_kappa);
    ADD_CASE(suite, "errors", bad_arguments_are_refused_and_outputs_untouched,
             methods_refuse_what_they_do_not_know);
    return run_suite(suite);
}
