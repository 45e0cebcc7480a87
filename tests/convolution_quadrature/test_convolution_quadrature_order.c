/* tests/convolution_quadrature/test_convolution_quadrature_order.c -- H 13: the orders.
 * Run alone: make test-convolution_quadrature_order */
#include <fvi/exact_solution.h>
#include "harness/fvi_runs.h"

#include "convolution_quadrature_runs.h"

#include <gsl/gsl_fit.h>
#include <gsl/gsl_math.h>

static const double alphas[] = { 0.1, 0.25, 0.5, 0.75, 0.9 };

/* ---- order ---- */

enum { MOST = 6400 };

static double x[MOST + 1], p[MOST + 1], want_x[MOST + 1], want_p[MOST + 1];

/* What x and p should be at the N + 1 nodes of [0, T]. */
typedef void truth(const setup *a, size_t N);

/* Largest errors of x and of p for from <= t, in N steps to T. */
static void errors(const fvi_method *method, setup a, double T, double from,
                   size_t N, truth *exact, double error[2])
{
    a.steps = N;
    a.h = T / (double)N;
    solve(method, &a, x, p);
    exact(&a, N);
    error[0] = error[1] = 0;
    for (size_t k = 0; k <= N; k++)
        if ((double)k * a.h >= from) {
            error[0] = larger(error[0], fabs(x[k] - want_x[k]));
            error[1] = larger(error[1], fabs(p[k] - want_p[k]));
        }
}

/* Slopes of log(error) against log(h) for N = first, 2 first, 4 first, 8 first. */
static void slopes(const fvi_method *method, const setup *a, double T,
                   double from, size_t first, truth *exact, double slope[2])
{
    double logh[4], loge[2][4], c0, cov00, cov01, cov11, sumsq;
    for (size_t i = 0; i < 4; i++) {
        double error[2];
        errors(method, *a, T, from, first << i, exact, error);
        logh[i] = log(T / (double)(first << i));
        for (size_t q = 0; q < 2; q++) {
            loge[q][i] = log(error[q]);
            ck_assert(i == 0 || loge[q][i] < loge[q][i - 1]);
        }
    }
    for (size_t q = 0; q < 2; q++)
        gsl_fit_linear(logh, 1, loge[q], 1, 4, &c0, &slope[q], &cov00, &cov01,
                       &cov11, &sumsq);
}

static void linear(const setup *a, size_t N)
{
    static double t[MOST + 1];
    const double *aT = a->force.params;
    const fvi_linear_oscillator problem = { .m = a->mass,
                                 .c = a->cg[0],
                                 .rho = a->rho,
                                 .alpha = a->alpha,
                                 .past = FVI_INITIAL_HISTORY_CAPUTO,
                                 .x0 = a->x0,
                                 .v0 = a->p0 / a->mass,
                                 .forcing =
                                     aT ? FVI_FORCING_STEP : FVI_FORCING_NONE,
                                 .A = aT ? aT[0] : 0,
                                 .T = aT ? aT[1] : 0 };
    for (size_t k = 0; k <= N; k++)
        t[k] = (double)k * a->h;
    ck_assert_int_eq(fvi_exact_at(&problem, N + 1, t, want_x, want_p, NULL),
                     FVI_SUCCESS);
    for (size_t k = 0; k <= N; k++)
        want_p[k] *= a->mass;
}

//> linear
/* The paper's oscillator, x_0 = 1, p_0 = 1/2, damped in Caputo's way, from t = 1/2
 * on: before that, the fractional powers of the solution are seen. Seen: x and p
 * 1.99 to 2.00. */
START_TEST(eq_13_8_order_two_in_x_and_p_on_the_oscillator)
{
    for (size_t i = 0; i < LEN(alphas) * LEN(methods); i++) {
        const setup a = { .alpha = alphas[i / LEN(methods)],
                          .past = FVI_INITIAL_HISTORY_CAPUTO,
                          .kappa = 0.5,
                          .mass = 1,
                          .rho = 0.2,
                          .x0 = 1,
                          .p0 = 0.5,
                          .cg = { 1, 0 } };
        double slope[2];
        slopes(methods[i % LEN(methods)], &a, 4, 0.5, 80, linear, slope);
        seen(slope[0], "order of x");
        seen(slope[1], "order of p");
        ck_assert_near(slope[0], 2, 0.03, "x, %s, alpha = %g",
                       methods[i % LEN(methods)]->name, a.alpha);
        ck_assert_near(slope[1], 2, 0.03, "p, %s, alpha = %g",
                       methods[i % LEN(methods)]->name, a.alpha);
    }
}
END_TEST
//< linear

/* x = x_0 + t^4, and what drives m x'' + c x + g x^3 + rho D^{2 alpha} x = F. */
static int drive(double t, size_t d, void *params, double *F)
{
    const setup *a = params;
    const double q = a->x0 + gsl_pow_4(t), b = 2 * a->alpha,
                 D = tgamma(5) / tgamma(5 - b) * pow(t, 4 - b);
    for (size_t i = 0; i < d; i++)
        F[i] = a->mass * 12 * t * t + (a->cg[0] + a->cg[1] * q * q) * q
               + a->rho * D;
    return 0;
}

static void driven(const setup *a, size_t N)
{
    for (size_t k = 0; k <= N; k++) {
        const double t = (double)k * a->h;
        want_x[k] = a->x0 + gsl_pow_4(t);
        want_p[k] = a->mass * 4 * gsl_pow_3(t);
    }
}

//> duffing
/* A Duffing oscillator driven along x_0 + t^4, all t; and with kappa = 1/4, where
 * only order 1 is left. Seen: 1.98 to 2.00; 0.98 to 1.01. */
START_TEST(eq_13_8_order_two_in_x_and_p_on_a_driven_duffing_oscillator)
{
    for (size_t i = 0; i < LEN(alphas) * LEN(methods); i++) {
        const char *name = methods[i % LEN(methods)]->name;
        setup a = { .alpha = alphas[i / LEN(methods)],
                    .past = FVI_INITIAL_HISTORY_CAPUTO,
                    .kappa = 0.5,
                    .mass = 1.5,
                    .rho = 0.7,
                    .x0 = 0.5,
                    .potential = DUFFING,
                    .cg = { 1, 1 } };
        double slope[2];
        a.force = (fvi_force){ .value = drive, .params = &a };
        slopes(methods[i % LEN(methods)], &a, 1, 0, 320, driven, slope);
        seen(slope[0], "order of x");
        seen(slope[1], "order of p");
        ck_assert_near(slope[0], 2, 0.05, "x, %s, alpha = %g", name, a.alpha);
        ck_assert_near(slope[1], 2, 0.05, "p, %s, alpha = %g", name, a.alpha);
        if (!methods[i % LEN(methods)]->takes_kappa)
            continue;
        a.kappa = 0.25;
        slopes(methods[i % LEN(methods)], &a, 1, 0, 400, driven, slope);
        seen(slope[0], "order of x, kappa = 1/4");
        ck_assert_near(slope[0], 1, 0.05, "kappa = 1/4: x, %s, alpha = %g",
                       name, a.alpha);
    }
}
END_TEST
//< duffing

/* Richardson's extrapolation of fvi_cq2_shifted, 3200 and 6400 steps to a->h N. */
static double fine_x[2][MOST + 1], fine_p[2][MOST + 1];

static void extrapolated(const setup *a, size_t N)
{
    (void)a;
    for (size_t k = 0; k <= N; k++) {
        const size_t i = k * (MOST / 2 / N);
        want_x[k] = (4 * fine_x[1][2 * i] - fine_x[0][i]) / 3;
        want_p[k] = (4 * fine_p[1][2 * i] - fine_p[0][i]) / 3;
    }
}

/* A pendulum with a start that is not at rest, no closed form: both methods tend
 * to the extrapolation of one of them, which is far better than either. Seen:
 * 1.99 to 2.00. */
START_TEST(eq_13_8_order_two_on_a_pendulum_that_both_agree_upon)
{
    for (size_t i = 0; i < LEN(alphas); i++) {
        setup a = { .alpha = alphas[i],
                    .past = FVI_INITIAL_HISTORY_CAPUTO,
                    .kappa = 0.5,
                    .mass = 1,
                    .rho = 0.4,
                    .x0 = 1,
                    .p0 = 0.5,
                    .potential = PENDULUM,
                    .cg = { 2, 0 } };
        for (size_t j = 0; j < 2; j++) {
            a.steps = (size_t)MOST / 2 << j;
            a.h = 4 / (double)a.steps;
            solve(&fvi_cq2_shifted, &a, fine_x[j], fine_p[j]);
        }
        for (size_t j = 0; j < LEN(methods); j++) {
            double slope[2];
            slopes(methods[j], &a, 4, 0.5, 100, extrapolated, slope);
            seen(slope[0], "order of x");
            seen(slope[1], "order of p");
            ck_assert_near(slope[0], 2, 0.05, "x, %s, alpha = %g",
                           methods[j]->name, a.alpha);
            ck_assert_near(slope[1], 2, 0.05, "p, %s, alpha = %g",
                           methods[j]->name, a.alpha);
        }
    }
}
END_TEST

//> bagley-torvik
/* x'' + x + D^{3/2} x = 8 for t <= 1, then 0, to T = 20: the jump is at a node.
 * The five errors were found by another program, against an inverse Laplace
 * transform. And the orders of both methods; that of p from t = 2 on, where start and
 * jump are forgotten, and over all nodes. Seen: x 2.00, p 1.99, and 1.41 to 1.47. */
START_TEST(eq_13_12_the_jump_of_bagley_and_torvik)
{
    const double aT[] = { 8, 1 },
                 known[] = { 3.468424e-3, 8.653632e-4, 2.161186e-4, 5.400051e-5,
                             1.349661e-5 };
    const setup a = { .alpha = 0.75,
                      .past = FVI_INITIAL_HISTORY_CAPUTO,
                      .kappa = 0.5,
                      .mass = 1,
                      .rho = 1,
                      .cg = { 1, 0 },
                      .force = fvi_force_step(aT) };
    double error[2], slope[2];
    for (size_t i = 0; i < LEN(known); i++) {
        errors(&fvi_cq2_shifted, a, 20, 0, (size_t)200 << i, linear, error);
        ck_assert_near(error[0] / known[i], 1, 1e-6, "N = %zu",
                       (size_t)200 << i);
    }
    //> orders
    for (size_t j = 0; j < LEN(methods); j++) {
        slopes(methods[j], &a, 20, 0, 400, linear, slope);
        seen(slope[0], "order of x");
        seen(slope[1], "order of p");
        ck_assert_near(slope[0], 2, 0.03, "x, %s", methods[j]->name);
        ck_assert_double_lt(slope[1], 1.6);
        slopes(methods[j], &a, 20, 2, 400, linear, slope);
        seen(slope[1], "order of p, t >= 2");
        ck_assert_near(slope[1], 2, 0.03, "p, %s", methods[j]->name);
    }
    //< orders
}
END_TEST
//< bagley-torvik

/* 3 * 0.1 is one ulp above 0.3: still the same node, the same bits. And at the node
 * of the jump itself p is not off by a quarter of it, h 8/4 = 0.02, as it would be with
 * the mean in (13.9): Seen 3.3e-5. */
START_TEST(eq_13_12_a_jump_a_rounding_away_is_at_the_node)
{
    const double decimal[] = { 8, 0.3 }, product[] = { 8, 3 * 0.1 },
                 below[] = { 8, 0.3 - 0x1p-54 };
    ck_assert(decimal[1] < product[1]);
    for (size_t j = 0; j < LEN(methods); j++) {
        setup a = { .alpha = 0.3,
                    .past = FVI_INITIAL_HISTORY_CAPUTO,
                    .kappa = 0.5,
                    .h = 0.1,
                    .steps = 40,
                    .mass = 1,
                    .rho = 0.5,
                    .cg = { 1, 0 } };
        double other[41];
        a.force = fvi_force_step(product);
        solve(methods[j], &a, x, p);
        a.force = fvi_force_step(decimal);
        solve(methods[j], &a, other, NULL);
        ck_assert_mem_eq(x, other, sizeof other);
        a.force = fvi_force_step(below);
        solve(methods[j], &a, other, NULL);
        ck_assert_mem_eq(x, other, sizeof other);
        a.force = fvi_force_step(product);
        a.h = 0.01;
        a.steps = 30;
        solve(methods[j], &a, x, p);
        linear(&a, 30);
        ck_assert_near(p[30], want_p[30], 1e-3, "%s", methods[j]->name);
    }
}
END_TEST

static double asked[40];
static size_t calls;

static int listen(double t, size_t d, void *params, double *F)
{
    (void)d, (void)params;
    asked[calls++] = t;
    F[0] = 0;
    return 0;
}

/* Two values of F in a step, each from within it: just after t_k, just before
 * t_{k+1}, 4 ulp of it away or, with the roundings of t, at most 6. */
START_TEST(eq_13_12_the_force_is_asked_within_the_step)
{
    for (size_t j = 0; j < LEN(methods); j++) {
        const setup a = { .alpha = 0.3,
                          .past = FVI_INITIAL_HISTORY_CAPUTO,
                          .kappa = 0.5,
                          .h = 0.1,
                          .steps = 20,
                          .mass = 1,
                          .rho = 0.5,
                          .x0 = 1,
                          .cg = { 1, 0 },
                          .force = { .value = listen } };
        calls = 0;
        solve(methods[j], &a, x, p);
        ck_assert_uint_eq(calls, 2 * a.steps);
        for (size_t k = 0; k < a.steps; k++) {
            const double t = (double)k * a.h, next = (double)(k + 1) * a.h;
            ck_assert(asked[2 * k] > t && asked[2 * k + 1] < next);
            ck_assert(asked[2 * k] <= t * (1 + 12 * U) + 1e-300);
            ck_assert(asked[2 * k + 1] >= next * (1 - 12 * U));
        }
    }
}
END_TEST

/* Of p over all t: the first sixteen nodes of fvi_cq2_midpoint from v_0 = 2, where the damping of
 * v_0 t is not smooth. x has 2 there, too, or more. A fit over h = 1/256 to 1/2048. */
START_TEST(eq_13_16_orders_of_the_first_nodes)
{
    const double some[] = { 0.15, 0.3, 0.6, 0.7 };
    for (size_t i = 0; i < LEN(some); i++) {
        const double want = (some[i] < 0.5 ? 2 : 3) - 2 * some[i];
        double last[2] = { 0 }, order[2] = { 0 };
        for (size_t N = 256; N <= 2048; N *= 2) {
            setup a = { .alpha = some[i],
                        .past = FVI_INITIAL_HISTORY_CAPUTO,
                        .kappa = 0.5,
                        .mass = 1,
                        .rho = 0.5,
                        .x0 = 1,
                        .p0 = 2,
                        .cg = { 1, 0 } };
            double error[2];
            errors(&fvi_cq2_midpoint, a, 16 / (double)N, 0, 16, linear, error);
            for (size_t q = 0; q < 2; q++) {
                order[q] = log2(last[q] / error[q]);
                last[q] = error[q];
            }
        }
        seen(order[1] - want, "order of p, less expected");
        ck_assert_near(order[1], want, 0.15, "p, alpha = %g", some[i]);
        ck_assert(order[0] >= 1.9 && order[0] <= want + 1.75);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("13 convolution quadrature: order");
    ADD_CASE(suite, "order", eq_13_8_order_two_in_x_and_p_on_the_oscillator,
             eq_13_8_order_two_in_x_and_p_on_a_driven_duffing_oscillator,
             eq_13_8_order_two_on_a_pendulum_that_both_agree_upon,
             eq_13_12_the_jump_of_bagley_and_torvik,
             eq_13_12_a_jump_a_rounding_away_is_at_the_node,
             eq_13_12_the_force_is_asked_within_the_step,
             eq_13_16_orders_of_the_first_nodes);
    return run_suite(suite);
}
