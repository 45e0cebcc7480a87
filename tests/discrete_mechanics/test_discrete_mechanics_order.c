/* tests/discrete_mechanics/test_discrete_mechanics_order.c -- H 2: the orders of the errors.
 * Run alone: make test-discrete_mechanics_order */
#include <fvi/discrete_mechanics.h>
#include <fvi/error.h>
#include "harness/energy.h"
#include "harness/fvi_runs.h"
#include "harness/ulp.h"

#include <gsl/gsl_math.h>
#include <gsl/gsl_sf_ellint.h>
#include <gsl/gsl_sf_elljac.h>

enum { FINEST = 1600 };

static const double one = 1, none = 0, T = 5;

/* ---- nonlinear oscillators that are solved by elliptic functions ---- */

/* REST starts where the motion of START does, but with p = 0, at its turning point:
 * cn = 1 for Duffing, sn = 1 for the pendulum. */
typedef enum { START, REST } motion;

/* Duffing, c = g = 1: x = A cn(omega t + phase), omega^2 = c + g A^2,
 * k^2 = g A^2 / (2 omega^2). Pendulum, g = 1: sin(x/2) = k sn, p = 2 omega k cn.
 * Proved in verify/discrete_mechanics/discrete_mechanics.py. */
static void exact(int kind, motion from, double t, double *x, double *p)
{
    double sn, cn, dn, A = 1.25, k = sin(1), phase = -0.5, p0;
    if (from == REST) {
        exact(kind, START, 0, &A, &p0);
        k = sin(A / 2);
        phase = kind == DUFFING ? 0 : gsl_sf_ellint_Kcomp(k, GSL_PREC_DOUBLE);
    }
    if (kind == DUFFING) {
        const double omega = sqrt(1 + A * A);
        gsl_sf_elljac_e(omega * t + phase, A * A / (2 * omega * omega), &sn,
                        &cn, &dn);
        *x = A * cn;
        *p = -A * omega * sn * dn;
    } else {
        gsl_sf_elljac_e(t + phase, k * k, &sn, &cn, &dn);
        *x = 2 * asin(k * sn);
        *p = 2 * k * cn;
    }
}

static const double cg[] = { 1, 1 };

/* How a run is started, if not by p_0 = -D1 L_d(x_0, x_1). */
typedef enum { MATCHED, TAYLOR, EULER, STILL, CORRECTED } beginning;

/* -D1 L_d(x_0, q_1) for another choice of q_1; then the run starts with q_1. */
static double momentum_of(const fvi_system *system, const setup *a,
                          beginning begin)
{
    double g, D1, q1 = a->x0;
    system->potential.gradient(1, &a->x0, system->potential.params, &g);
    if (begin == MATCHED)
        return a->p0;
    if (begin == CORRECTED)
        return a->p0 + (a->kappa - 0.5) * a->h * g;
    if (begin != STILL)
        q1 += a->h * a->p0;
    if (begin == TAYLOR)
        q1 -= a->h * a->h * g / 2;
    fvi_discrete_slopes(system, a->kappa, a->h, &a->x0, &q1, &D1, NULL);
    return -D1;
}

/* The largest errors of x and p for t <= T, against the motion from START or from
 * REST. If the start is CORRECTED, so is p. */
static void errors(const fvi_method *method, int kind, double kappa,
                   beginning begin, motion to, size_t N, double error[2])
{
    static double x[FINEST + 1], p[FINEST + 1];
    const fvi_system system = {
        1, &one, &none, potential(kind, cg), { 0 }, NULL, NULL
    };
    setup a = { .alpha = 0.5, .kappa = kappa, .h = T / (double)N, .steps = N };
    exact(kind, START, 0, &a.x0, &a.p0);
    const double p0 = momentum_of(&system, &a, begin);
    run(method, &a, &system, &a.x0, &p0, x, p);
    error[0] = error[1] = 0;
    for (size_t k = 1; k <= N; k++) {
        double want[2], g;
        exact(kind, to, (double)k * a.h, want, want + 1);
        fvi_potential_gradient(&system, x + k, &g);
        if (begin == CORRECTED)
            p[k] -= (kappa - 0.5) * a.h * g;
        error[0] = larger(error[0], fabs(x[k] - want[0]));
        error[1] = larger(error[1], fabs(p[k] - want[1]));
    }
}

static void ck_assert_orders(const fvi_method *method, double kappa,
                             beginning begin, motion to, double x_order,
                             double p_order)
{
    const double order[] = { x_order, p_order };
    const int kinds[] = { DUFFING, PENDULUM };
    for (size_t i = 0; i < LEN(kinds); i++) {
        double coarse[2], fine[2];
        errors(method, kinds[i], kappa, begin, to, FINEST / 2, coarse);
        errors(method, kinds[i], kappa, begin, to, FINEST, fine);
        for (size_t j = 0; j < 2; j++) {
            double slope = log2(coarse[j] / fine[j]);
            /* With an error of C h^q (1 + c h) the slope is off by c h / ln 2,
             * h = 1/320: 0.04 allows |c| up to 9. */
            ck_assert_near(slope, order[j], 0.04,
                           "%s, kappa = %g, start %d, to %d, kind %d, %s",
                           method->name, kappa, (int)begin, (int)to, kinds[i],
                           j ? "p" : "x");
        }
    }
}

/* GSL's elliptic functions: sn^2 + cn^2 = 1 and the energy is one number, both to
 * some rounding errors; far below the errors that are measured. Seen: 1.3e-15. */
START_TEST(eq_2_4_exact_solutions_conserve_energy)
{
    for (int i = 0; i < 4; i++) {
        const int kind = i % 2 ? DUFFING : PENDULUM;
        const motion from = i / 2 ? REST : START;
        const fvi_system system = { 1,     &one, &none, potential(kind, cg),
                                    { 0 }, NULL, NULL };
        double x, p, x0, p0;
        exact(kind, from, 0, &x, &p);
        const double E = energy_of(&system, &x, &p);
        exact(kind, START, 0, &x0, &p0);
        ck_assert_near(x, x0, 8 * U, "the same start, kind %d", kind);
        ck_assert_near(p, from == REST ? 0 : p0, 16 * U, "p, kind %d", kind);
        for (double t = 0; t <= T; t += 0.25) {
            exact(kind, from, t, &x, &p);
            ck_assert_near(energy_of(&system, &x, &p), E, 64 * U, "t = %g", t);
        }
    }
}
END_TEST

/* Seen, in all of the following: within 0.025 of the order. */
START_TEST(eq_2_14_kappa_one_half_has_order_2_others_order_1)
{
    for (double kappa = 0; kappa <= 1; kappa += 0.25) {
        const double order = kappa == 0.5 ? 2 : 1;
        ck_assert_orders(&fvi_midpoint_variational, kappa, MATCHED, START, order, order);
    }
}
END_TEST

//> start
START_TEST(eq_2_14_the_start_alone_makes_the_difference)
{
    for (double kappa = 0; kappa <= 1; kappa += 0.25) {
        /* x_1 by Taylor: positions of order 2; p is what it is. */
        ck_assert_orders(&fvi_midpoint_variational, kappa, TAYLOR, START, 2,
                         kappa == 0.5 ? 2 : 1);
        /* p_0 and every p_k corrected by (kappa - 1/2) h U'. */
        ck_assert_orders(&fvi_midpoint_variational, kappa, CORRECTED, START, 2, 2);
        /* x_1 = x_0 + h v_0 costs one order. */
        ck_assert_orders(&fvi_midpoint_variational, kappa, EULER, START, 1, 1);
        /* x_1 = x_0 does not come near, but to the motion from rest: half a step
         * late, as is the velocity of a step, which is p for kappa = 0. */
        ck_assert_orders(&fvi_midpoint_variational, kappa, STILL, START, 0, 0);
        ck_assert_orders(&fvi_midpoint_variational, kappa, STILL, REST, 1,
                         kappa == 0 ? 2 : 1);
    }
}
END_TEST
//< start

START_TEST(eq_2_13_euler_has_order_1)
{
    ck_assert_orders(&fvi_euler_explicit, 0, MATCHED, START, 1, 1);
    ck_assert_orders(&fvi_euler_implicit, 0, MATCHED, START, 1, 1);
}
END_TEST

/* m x'' + U' + rho x' = F has the solution sin t + 2 if F is what is left over. */
static int drive(double t, size_t d, void *params, double *F)
{
    const double *rho = params, x = sin(t) + 2;
    for (size_t i = 0; i < d; i++)
        F[i] = -sin(t) + (1 + x * x) * x + *rho * cos(t);
    return 0;
}

/* Damping and force act at the end of a step only, so (2.8) has order 1, for
 * every kappa; for the same reason, half an impulse h F(0)/2 is missing in p_0. */
START_TEST(eq_2_8_lagrange_dalembert_has_order_1)
{
    static double x[FINEST + 1];
    const double rho = 0.5;
    for (double kappa = 0; kappa <= 1; kappa += 0.5) {
        double error[2] = { 0 };
        for (size_t i = 0; i < 2; i++) {
            const size_t N = FINEST / 2 * (i + 1);
            const setup a = { .alpha = 0.5,
                              .kappa = kappa,
                              .h = T / (double)N,
                              .steps = N,
                              .mass = 1,
                              .rho = rho,
                              .x0 = 2,
                              .p0 = 1,
                              .potential = DUFFING,
                              .cg = { 1, 1 },
                              .force = { .value = drive, .params = (void *)&rho } };
            solve(&fvi_lagrange_dalembert, &a, x, NULL);
            for (size_t k = 1; k <= N; k++)
                error[i] =
                    larger(error[i], fabs(x[k] - sin((double)k * a.h) - 2));
        }
        ck_assert_near(log2(error[0] / error[1]), 1, 0.04, "kappa = %g", kappa);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("02 orders");
    ADD_CASE(suite, "order", eq_2_4_exact_solutions_conserve_energy,
             eq_2_14_kappa_one_half_has_order_2_others_order_1,
             eq_2_14_the_start_alone_makes_the_difference,
             eq_2_13_euler_has_order_1, eq_2_8_lagrange_dalembert_has_order_1);
    return run_suite(suite);
}
