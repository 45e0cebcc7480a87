/* tests/legendre/test_legendre_order.c -- H 8: starts and momenta, and their influence on the order.
 * Run alone: make test-legendre_order */
#include <fvi/error.h>
#include <fvi/paper/half_derivative.h>
#include <fvi/paper/legendre.h>
#include "harness/energy.h"
#include "harness/fvi_runs.h"
#include "harness/ulp.h"

#include "legendre_ref.h"

#include <gsl/gsl_fit.h>
#include <gsl/gsl_math.h>
#include <gsl/gsl_sf_elljac.h>

enum { MOST = 4096 };

/* The paper's problem: m = c = 1, rho = 1/5, x_0 = 1, p_0 = 1/2. */
static const double c = 1, rho = 0.2, x0 = 1, p0 = 0.5;

/* m x'' + rho x' + c x = 0, x(0) = x0, x'(0) = v0. verify/legendre/legendre.py. */
static void exact(double m, double v0, double t, double *x, double *v)
{
    const double gamma = rho / (2 * m), omega = sqrt(c / m - gamma * gamma);
    const double B = (v0 + gamma * x0) / omega, fade = exp(-gamma * t);
    *x = fade * (x0 * cos(omega * t) + B * sin(omega * t));
    *v = fade
         * ((B * omega - gamma * x0) * cos(omega * t)
            - (x0 * omega + gamma * B) * sin(omega * t));
}

/* The slope of log error against log h by least squares. */
static double fitted(size_t n, const double *h, const double *error)
{
    double x[16], y[16], start, slope, cov[4];
    for (size_t i = 0; i < n; i++) {
        x[i] = log(h[i]);
        y[i] = log(error[i]);
    }
    gsl_fit_linear(x, 1, y, 1, n, &start, &slope, &cov[0], &cov[1], &cov[2],
                   &cov[3]);
    return slope;
}

/* The three candidates at the node k >= 1, from the positions alone. */
enum { MATCHED, RAW, QUOTIENT, CANDIDATES };
static const char *const names[] = { "matched", "D2 L_d", "quotient" };

static void candidates(const fvi_system *system, double kappa, double h,
                       const double *x, size_t k, double p[CANDIDATES])
{
    const double D = (x[k] - x[k - 1]) / h; /* alpha = 1/2 */
    fvi_legendre_plus(system, kappa, h, x + k - 1, x + k, &D, NULL,
                      p + MATCHED);
    fvi_legendre_plus(system, kappa, h, x + k - 1, x + k, NULL, NULL, p + RAW);
    p[QUOTIENT] = system->mass[0] * (x[k] - x[k - 1]) / h;
}

static const fvi_system *paper(void)
{
    static const double one = 1;
    static fvi_system system = { 1, &one, &rho, { 0 }, { 0 }, NULL, NULL };
    system.potential = fvi_potential_harmonic(&c);
    return &system;
}

/* Largest errors over t <= T, kappa = 1/2: of each p, and of the energy with it. */
static void paper_errors(double h, double p_error[3], double E_error[3])
{
    static double x[MOST + 1];
    const size_t N = (size_t)lround(15 / h);
    const setup a = { .alpha = 0.5,
                      .past = FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE,
                      .kappa = 0.5,
                      .h = h,
                      .steps = N };
    run(&fvi_fractional, &a, paper(), &x0, &p0, x, NULL);
    for (size_t i = 0; i < CANDIDATES; i++)
        p_error[i] = E_error[i] = 0;
    for (size_t k = 1; k <= N; k++) {
        double p[CANDIDATES], xt, vt;
        candidates(paper(), 0.5, h, x, k, p);
        exact(1, p0, (double)k * h, &xt, &vt);
        for (size_t i = 0; i < CANDIDATES; i++) {
            double E = energy_of(paper(), x + k, p + i);
            p_error[i] = larger(p_error[i], fabs(p[i] - vt));
            E_error[i] =
                larger(E_error[i], fabs(E - energy_of(paper(), &xt, &vt)));
        }
    }
}

/* h = 0.1, ..., 0.00625, against the same errors in 55 digits. A step rounds by
 * less than 16 u, which the oscillator carries on with a factor below 2; the exact
 * solution has some u more: 40 u N. The least error, 3.6e-4 at N = 2400, is known to
 * 3e-8 of itself, and so are slopes over a factor 16 in h. All are on their way to 1.
 * Seen: 0.0013 of the bound, and 1.4e-12. */
START_TEST(eq_8_8_three_momenta_all_of_order_1)
{
    double h[LEN(ref_errors)], p[3][LEN(h)], E[3][LEN(h)];
    for (size_t i = 0; i < LEN(h); i++) {
        double p_error[3], E_error[3];
        h[i] = ref_errors[i].h;
        paper_errors(h[i], p_error, E_error);
        for (size_t j = 0; j < CANDIDATES; j++) {
            const double bound = 40 * U * 15 / h[i];
            ck_assert_near(p_error[j], ref_errors[i].p[j], bound, "p, %zu", j);
            ck_assert_near(E_error[j], ref_errors[i].E[j], bound, "E, %zu", j);
            p[j][i] = p_error[j];
            E[j][i] = E_error[j];
        }
    }
    for (size_t j = 0; j < CANDIDATES; j++) {
        const double of_p = fitted(LEN(h), h, p[j]),
                     of_E = fitted(LEN(h), h, E[j]);
        ck_assert_near(of_p, ref_slopes[j].p, 4e-8, "p, %zu", j);
        ck_assert_near(of_E, ref_slopes[j].E, 4e-8, "E, %zu", j);
        seen(of_p, "slope of p, %s", names[j]);
        seen(of_E, "slope of E, %s", names[j]);
    }
    for (size_t i = 0; i < LEN(h);
         i++) /* which has the smallest in the energy */
        ck_assert(E[MATCHED][i] < E[RAW][i] / 2
                  && E[RAW][i] < E[QUOTIENT][i] / 1.5);
}
END_TEST

/* Without damping and with kappa = 1/2 the matched momentum has order 2, the
 * quotient order 1. Duffing, c = g = 1, x = A cn (H 2). h = 1/160 to 1/320:
 * |slope - order| below 0.04 allows a second coefficient 9 times the first.
 * Seen: within 0.014. */
START_TEST(eq_8_8_the_quotient_loses_an_order_without_damping)
{
    static double x[MOST + 1];
    const double one = 1, none = 0, cg[] = { 1, 1 }, A = 1.25;
    const double omega = sqrt(1 + A * A), k2 = A * A / (2 * omega * omega);
    const fvi_system system = { 1,     &one, &none, fvi_potential_duffing(cg),
                                { 0 }, NULL, NULL };
    const double order[] = { 2, 2, 1 };
    double error[CANDIDATES][2] = { { 0 } }, sn, cn, dn;
    for (size_t i = 0; i < 2; i++) {
        const size_t N = 800 * (i + 1);
        const setup a = { .alpha = 0.5,
                          .past = FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE,
                          .kappa = 0.5,
                          .h = 5 / (double)N,
                          .steps = N };
        gsl_sf_elljac_e(-0.5, k2, &sn, &cn, &dn);
        const double x_0 = A * cn, p_0 = -A * omega * sn * dn;
        run(&fvi_fractional, &a, &system, &x_0, &p_0, x, NULL);
        for (size_t k = 1; k <= N; k++) {
            double p[CANDIDATES];
            candidates(&system, 0.5, a.h, x, k, p);
            gsl_sf_elljac_e(omega * (double)k * a.h - 0.5, k2, &sn, &cn, &dn);
            for (size_t j = 0; j < CANDIDATES; j++)
                error[j][i] =
                    larger(error[j][i], fabs(p[j] + A * omega * sn * dn));
        }
    }
    for (size_t j = 0; j < CANDIDATES; j++)
        ck_assert_near(log2(error[j][0] / error[j][1]), order[j], 0.04,
                       "momentum %zu", j);
}
END_TEST

/* (8.8), (8.9): against the oscillator of mass M = m - rho h / 2 the positions and
 * each momentum, as the expansion says, have order 2, for every kappa.
 * h = 1/128 to 1/256: 0.04 allows a second coefficient 7 times the first.
 * Seen: within 0.003. */
START_TEST(eq_8_9_the_integrator_moves_the_mass_m_minus_rho_h_over_2)
{
    static double x[MOST + 1];
    for (double kappa = 0; kappa <= 1; kappa += 0.25) {
        double error[1 + CANDIDATES][2] = { { 0 } };
        for (size_t i = 0; i < 2; i++) {
            const size_t N = 15 * 128 * (i + 1);
            const double h = 15 / (double)N, M = 1 - rho * h / 2;
            const setup a = { .alpha = 0.5,
                              .past = FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE,
                              .kappa = kappa,
                              .h = h,
                              .steps = N };
            run(&fvi_fractional, &a, paper(), &x0, &p0, x, NULL);
            for (size_t k = 1; k <= N; k++) {
                double p[CANDIDATES], z, v;
                candidates(paper(), kappa, h, x, k, p);
                exact(M, (p0 - (kappa - 0.5) * h * c * x0) / M, (double)k * h,
                      &z, &v);
                const double want[] = { M * v + (kappa - 0.5) * h * c * z,
                                        (M + rho * h) * v
                                            + (kappa - 0.5) * h * c * z,
                                        (M + rho * h) * v + h * c * z / 2 };
                for (size_t j = 0; j < CANDIDATES; j++)
                    error[j][i] = larger(error[j][i], fabs(p[j] - want[j]));
                error[CANDIDATES][i] =
                    larger(error[CANDIDATES][i], fabs(x[k] - z));
            }
        }
        for (size_t j = 0; j <= CANDIDATES; j++)
            ck_assert_near(log2(error[j][0] / error[j][1]), 2, 0.04,
                           "kappa = %g, row %zu", kappa, j);
    }
}
END_TEST

/* (8.7), the remark on kappa~: momenta -D1 L_d + kappa~ h rho Delta Delta x and
 * D2 L_d - (1 - kappa~) h rho Delta Delta x, matched, give the positions of a run
 * that started from p_0 - kappa~ rho h^(1 - 2 alpha) x_0. 20 steps; in each the two
 * ways round differently, by less than 128 u (m/h + rho h^(1-2 alpha)) in p, and
 * the oscillator carries that on with a factor below 2 in x. Seen: 1e-3 of it. */
START_TEST(eq_8_7_kappa_tilde_is_another_start)
{
    enum { N = 20 };
    const double h = 0.125, alphas[] = { 0.25, 0.5, 0.75 };
    for (size_t r = 0; r < LEN(alphas) * 5; r++) {
        const double tilde = 0.25 * (double)(r % 5);
        const setup a = { .alpha = alphas[r / 5],
                          .past = FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE,
                          .kappa = 0.25,
                          .h = h,
                          .steps = N };
        const double power = pow(h, 1 - 2 * a.alpha);
        const double start = p0 - tilde * rho * power * x0;
        double x[N + 1], want[N + 1], D[N + 1], p = p0;
        run(&fvi_fractional, &a, paper(), &x0, &start, want, NULL);
        x[0] = x0;
        for (size_t k = 0; k < N; k++) {
            fvi_delta_twice(a.alpha, h, k, 1, x, D);
            if (k > 0) {
                const double share = (1 - tilde) * D[k];
                fvi_legendre_plus(paper(), a.kappa, h, x + k - 1, x + k, &share,
                                  NULL, &p);
            }
            p -= tilde * h * rho * D[k]; /* so that -D1 L_d is left */
            fvi_legendre_inverse(paper(), a.kappa, h, x + k, &p, x + k + 1);
            ck_assert_near(x[k + 1], want[k + 1],
                           2 * (double)(k + 1) * 128 * U
                               * (1 / h + rho * power),
                           "k = %zu, run %zu", k + 1, r);
        }
    }
}
END_TEST

/* At alpha = 1/2 another kappa~ is a wrong start for ever: p_0 misses kappa~ rho x_0,
 * and x the answer to that impulse, in the limit. What is left goes like h: its
 * extrapolation to h = 0 from h and h/2 is off by less than h^2. Seen: 5e-6. */
START_TEST(eq_8_7_another_start_is_wrong_at_alpha_one_half)
{
    static double x[MOST + 1];
    const double T = 4, tilde = 1;
    const double gamma = rho / 2, omega = sqrt(c - gamma * gamma);
    const double impulse =
        -tilde * rho * x0 * exp(-gamma * T) * sin(omega * T) / omega;
    double off[2], z, v;
    exact(1, p0, T, &z, &v);
    for (size_t i = 0; i < 2; i++) {
        const size_t N = 512 * (i + 1);
        const setup a = { .alpha = 0.5,
                          .past = FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE,
                          .kappa = 0.5,
                          .h = T / (double)N,
                          .steps = N };
        const double start = p0 - tilde * rho * x0;
        run(&fvi_fractional, &a, paper(), &x0, &start, x, NULL);
        off[i] = x[N] - z;
    }
    const double h = T / 512;
    ck_assert_near(2 * off[1] - off[0], impulse, h * h, "limit");
    ck_assert_double_gt(fabs(impulse), 0.1);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("08 starts and momenta");
    ADD_CASE(suite, "order", eq_8_8_three_momenta_all_of_order_1,
             eq_8_8_the_quotient_loses_an_order_without_damping,
             eq_8_9_the_integrator_moves_the_mass_m_minus_rho_h_over_2,
             eq_8_7_kappa_tilde_is_another_start,
             eq_8_7_another_start_is_wrong_at_alpha_one_half);
    return run_suite(suite);
}
