/* tests/convolution_quadrature/test_convolution_quadrature_stability.c -- H 13: the edge of
 * stability. Run alone: make test-convolution_quadrature_stability */
#include <fvi/convolution_quadrature_methods.h>
#include <fvi/convolution_quadrature_stability.h>
#include "harness/fvi_runs.h"

#include "convolution_quadrature_ref.h"

#include <gsl/gsl_math.h>

static const fvi_method *const methods[] = { &fvi_cq2_shifted, &fvi_cq_bdf2 };

enum { MOST = 3000 };

static double x[MOST + 1];

static setup scalar(double alpha, double kappa, double W, double R,
                    size_t steps)
{
    return (setup){ .alpha = alpha,
                    .past = FVI_INITIAL_HISTORY_CAPUTO,
                    .kappa = kappa,
                    .h = 1,
                    .steps = steps,
                    .mass = 1,
                    .rho = R,
                    .p0 = 1,
                    .cg = { W, 0 } };
}

/* (13.13) with x_0 = 0 and x_1 = 1 is the integrator, up to the size of the start:
 * for 2 alpha <= 1 there is no drift to subtract. Growing runs magnify rounding
 * as they do the rest: relative to max |x|, 200 steps of some 100 u each. Seen:
 * 3e-15, 0.001 of that. */
START_TEST(eq_13_13_the_recurrence_is_the_integrator)
{
    enum { N = 200 };
    const double some[] = { 0, 0.1, 0.25, 0.5 }, kappas[] = { 0, 0.25, 0.5 };
    double w[N + 1], y[N + 1];
    for (size_t i = 0; i < LEN(some) * LEN(kappas) * LEN(methods); i++) {
        const double alpha = some[i % 4], kappa = kappas[i / 4 % 3];
        const int bdf2 = i >= LEN(some) * LEN(kappas);
        setup a = scalar(alpha, kappa, 0.5, 0.4, N);
        solve(methods[bdf2], &a, x, NULL);
        ck_assert_int_eq(fvi_cq_weights(bdf2 ? FVI_DELTA_BDF2
                                                     : FVI_DELTA_EULER,
                                                2 * alpha, N + 1, w),
                         FVI_SUCCESS);
        ck_assert_int_eq(fvi_cq_oscillator(w, bdf2 ? 0 : alpha, kappa,
                                                   0.5, 0.4, N, y),
                         FVI_SUCCESS);
        for (size_t k = 0; k <= N; k++)
            ck_assert_near(x[k] / x[1], y[k],
                           100 * N * U * farthest(N + 1, y, NULL),
                           "%s alpha=%g kappa=%g k=%zu", methods[bdf2]->name,
                           alpha, kappa, k);
    }
}
END_TEST

/* Q has a relative error of some u of its terms and is steep at the root. Seen: 2
 * ulp. */
START_TEST(eq_13_15_growth_is_the_root_of_the_symbol)
{
    for (size_t i = 0; i < LEN(ref_growth); i++) {
        double growth = 0;
        ck_assert_int_eq(
            fvi_cq_amplification(ref_growth[i].kind, ref_growth[i].theta,
                                  ref_growth[i].alpha, ref_growth[i].kappa,
                                  ref_growth[i].W, ref_growth[i].R, &growth),
            FVI_SUCCESS);
        ck_assert_ulp(growth, ref_growth[i].want, 32, "row %zu", i);
    }
}
END_TEST

/* The bound on R of (13.14); infinite if every step is stable. */
static double bound(const fvi_method *method, double alpha, double kappa,
                    double W)
{
    const double left = 4 - W * gsl_pow_2(1 - 2 * kappa);
    if (method == &fvi_cq_bdf2)
        return left / pow(16, alpha);
    return alpha < 0.5 ? left / pow(4, alpha) / (1 - 2 * alpha) : GSL_POSINF;
}

/* The part of x that alternates in sign: what is slow goes out in the differences,
 * four times what alternates stays in. From k = 1 to steps - 1. */
static void alternate(const fvi_method *method, const setup *a, double *y)
{
    solve(method, a, x, NULL);
    for (size_t k = 1; k < a->steps; k++)
        y[k] = x[k + 1] - 2 * x[k] + x[k - 1];
}

/* Does it reach further in the second half of a run than in the first? */
static int grows(const fvi_method *method, const setup *a)
{
    static double y[MOST];
    const size_t half = a->steps / 2;
    alternate(method, a, y);
    const double slack = a->alpha < 1 ? 1 : 1.01; /* neutral at alpha = 1 */
    return farthest(half - 1, y + half, NULL)
           > slack * farthest(half - 1, y + 1, NULL);
}

//> edge
/* Half a percent inside and outside of (13.14); outside, the growth is that of
 * (13.15). A push sets the motion off: a v_0 would be taken out of the damping, were
 * 2 alpha > 1. Seen: the logarithms agree to 0.0013. */
START_TEST(eq_13_14_runs_on_both_sides_of_the_edge)
{
    const double orders[] = { 0.1, 0.25, 0.4, 0.5, 0.75, 1 },
                 kappas[] = { 0, 0.25, 0.5 }, Ws[] = { 0.01, 1, 3 },
                 push[] = { 1, 1 };
    for (size_t i = 0; i < LEN(orders) * LEN(kappas) * LEN(Ws) * 2; i++) {
        const double alpha = orders[i % 6], kappa = kappas[i / 6 % 3],
                     W = Ws[i / 18 % 3];
        const fvi_method *method = methods[i / 54];
        const double R = bound(method, alpha, kappa, W);
        if (!gsl_finite(R))
            continue;
        setup a = scalar(alpha, kappa, W, 0.995 * R, 3000);
        a.p0 = 0;
        a.force = fvi_force_step(push);
        ck_assert_msg(!grows(method, &a), "inside: %s alpha=%g kappa=%g W=%g",
                      method->name, alpha, kappa, W);
        double growth;
        static double y[MOST];
        a.rho = 1.005 * R;
        ck_assert_int_eq(fvi_cq_amplification(method == &fvi_cq_bdf2
                                                   ? FVI_DELTA_BDF2
                                                   : FVI_DELTA_EULER,
                                               method == &fvi_cq_bdf2 ? 0 : alpha,
                                               alpha, kappa, W, a.rho, &growth),
                         FVI_SUCCESS);
        alternate(method, &a, y);
        const double ratio = log(fabs(y[2999] / y[2499])) / (500 * log(growth));
        seen(fabs(ratio - 1), "logarithms differ");
        ck_assert_near(ratio, 1, 0.02, "outside: %s alpha=%g kappa=%g W=%g",
                       method->name, alpha, kappa, W);
    }
}
END_TEST
//< edge

/* alpha >= 1/2, kappa = 1/2: no damping is too strong, no step too long. */
START_TEST(eq_13_14_the_shifted_integrator_is_stable_without_condition)
{
    const double orders[] = { 0.5, 0.6, 0.75, 0.9, 1 },
                 Rs[] = { 0.1, 10, 1e3, 1e6 }, Ws[] = { 0.01, 1, 100, 1e4 },
                 push[] = { 1, 1 };
    for (size_t i = 0; i < LEN(orders) * LEN(Rs) * LEN(Ws); i++) {
        setup a = scalar(orders[i % 5], 0.5, Ws[i / 20], Rs[i / 5 % 4], 2000);
        a.p0 = 0;
        a.force = fvi_force_step(push);
        ck_assert_msg(!grows(&fvi_cq2_shifted, &a), "alpha=%g W=%g R=%g", a.alpha,
                      a.cg[0], a.rho);
    }
}
END_TEST

//> stable
/* (13.17): fvi_cq2_midpoint takes every step, stiffness, damping and order, and every past: a
 * stiff and strongly damped oscillator, W and R from 1e-4 to 1e8, from x_0 = 1 and at
 * rest, stays below 1 as the exact one does; and goes on doing so where fvi_cq2_shifted
 * has left all bounds. Riemann-Liouville's history force makes it overshoot a little. */
START_TEST(eq_13_17_the_stable_method_takes_every_step)
{
    const double orders[] = { 0.05, 0.25, 0.4, 0.5, 0.6, 0.8, 0.95 };
    size_t lost = 0;
    for (size_t i = 0; i < LEN(orders) * 49; i++) {
        const double alpha = orders[i % 7],
                     W = pow(10, 2. * (double)(i / 7 % 7) - 4),
                     R = pow(10, 2. * (double)(i / 49) - 4);
        for (int past = FVI_INITIAL_HISTORY_HELD; past <= FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE;
             past++) {
            setup a = scalar(alpha, 0.5, W, R, 2000);
            a.past = (fvi_initial_history)past;
            a.x0 = 1;
            a.p0 = 0;
            if (past == FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE && alpha > 0.5)
                continue;
            solve(&fvi_cq2_midpoint, &a, x, NULL);
            ck_assert_msg(
                farthest(2001, x, NULL)
                    <= (past == FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE ? 1.1 : 1 + 1e-9),
                "alpha=%g W=%g R=%g past=%d: %g", alpha, W, R, past,
                farthest(2001, x, NULL));
        }
        const double one = 1;
        double load = 7, R_most = bound(&fvi_cq2_shifted, alpha, 0.5, W);
        const fvi_system system = { 1,     &one, &R, fvi_potential_harmonic(&W),
                                    { 0 }, NULL, NULL };
        const double x0 = 1, p0 = 0;
        fvi_run run = fvi_run_default(&system, &x0, &p0, 1, 1);
        run.alpha = alpha;
        run.kappa = 0.1; /* which is not used */
        ck_assert_int_eq(fvi_stability_number(&fvi_cq2_midpoint, &run, &load), 0);
        ck_assert(load == 0);
        lost += R > R_most;
    }
    ck_assert_uint_ge(lost, 60);
}
END_TEST
//< stable

/* Nothing damps the alternating mode, (13.17) at -1: a held body that begins with a
 * velocity is stopped by a damping of order > 1, and what that leaves of v rings on.
 * fvi_cq2_shifted lets it die out. */
START_TEST(eq_13_17_what_is_stiff_rings)
{
    setup a = scalar(0.6, 0.5, 0.25, 5e5, 2000);
    a.past = FVI_INITIAL_HISTORY_HELD;
    a.x0 = 1;
    a.p0 = 0.25;
    solve(&fvi_cq2_midpoint, &a, x, NULL);
    const double stable = fabs(x[2000] - x[1999]);
    solve(&fvi_cq2_shifted, &a, x, NULL);
    const double shifted = fabs(x[2000] - x[1999]);
    seen(stable, "fvi-stable");
    seen(shifted, "fvi-shifted");
    ck_assert_double_ge(stable, a.p0 / 10); /* a share of h v_0 */
    ck_assert_double_le(shifted, stable / 1000);
}
END_TEST

//> trapezoid
/* Trapezoidal weights in the place of w: whatever the damping, there is a growing
 * mode, and (13.15) says how fast it grows. The other solutions are by then growth^-n
 * / n of it at most, up to a factor; rounding of the weights. Seen: 0.07. */
START_TEST(eq_13_15_trapezoidal_weights_are_always_unstable)
{
    enum { N = 2000 };
    const double Rs[] = { 0.01, 0.1, 1 },
                 alphas[] = { 0.1, 0.25, 0.5, 0.75, 0.9 };
    for (size_t i = 0; i < LEN(Rs) * LEN(alphas); i++) {
        const double alpha = alphas[i / 3], R = Rs[i % 3];
        double w[N + 1], growth;
        ck_assert_int_eq(fvi_cq_amplification(FVI_DELTA_TRAPEZOID, 0,
                                               alpha, 0.5, 1, R, &growth),
                         FVI_SUCCESS);
        ck_assert_double_ge(growth, 1);
        if (growth < 1.01)
            continue; /* too slow to be seen, R = 0.01, alpha = 0.1 */
        const size_t n = (size_t)smaller(N, 600 / log(growth));
        ck_assert_int_eq(fvi_cq_weights(FVI_DELTA_TRAPEZOID,
                                                2 * alpha, n + 1, w),
                         FVI_SUCCESS);
        ck_assert_int_eq(fvi_cq_oscillator(w, 0, 0.5, 1, R, n, x),
                         FVI_SUCCESS);
        ck_assert_near(
            pow(fabs(x[n] / x[n / 2]), 1 / (double)(n - n / 2)), growth,
            40 / (double)n * pow(growth, -(double)n / 2) + 3 * (double)n * U,
            "alpha=%g R=%g", alpha, R);
    }
}
END_TEST
//< trapezoid

int main(void)
{
    Suite *suite = suite_create("13 convolution quadrature: stability");
    ADD_CASE(suite, "values", eq_13_15_growth_is_the_root_of_the_symbol);
    ADD_CASE(suite, "identities", eq_13_13_the_recurrence_is_the_integrator);
    ADD_CASE(suite, "runs", eq_13_14_runs_on_both_sides_of_the_edge,
             eq_13_14_the_shifted_integrator_is_stable_without_condition,
             eq_13_17_the_stable_method_takes_every_step,
             eq_13_17_what_is_stiff_rings,
             eq_13_15_trapezoidal_weights_are_always_unstable);
    return run_suite(suite);
}
