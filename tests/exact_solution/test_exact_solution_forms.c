/* tests/exact_solution/test_exact_solution_forms.c -- H 11: closed forms and series.
 * Run alone: make test-exact_solution_forms */
#include "exact_problems.h"
#include "system/larger.h"

#include <complex.h>

/* (11.13): m x'' + b x' + c x = 0 by its two exponentials; they lose what lies
 * between the roots, 1 / |s1 - s2| here below 2. */
static void two_exponentials(double m, double b, double c, double x0, double v0,
                             double t, double *x, double *v)
{
    double complex root = csqrt(b * b - 4 * m * c) / (2 * m);
    double complex s1 = root - b / (2 * m), s2 = -root - b / (2 * m);
    double complex a1 = (v0 - s2 * x0) / (s1 - s2) * cexp(s1 * t);
    double complex a2 = (s1 * x0 - v0) / (s1 - s2) * cexp(s2 * t);
    *x = creal(a1 + a2);
    *v = creal(s1 * a1 + s2 * a2);
}

START_TEST(eq_11_13_integer_orders_have_closed_forms)
{
    const double rhos[] = { 0, 0.2, 1.9, 2.5, 30 }, times[] = { 0, 1e-3, 1, 9 };
    const double x0 = 1, v0 = -0.5, kept[4] = { x0, 0, x0, x0 };
    for (size_t i = 0; i < LEN(rhos) * LEN(times) * 4; i++) {
        double rho = rhos[i / 4 / LEN(times)], t = times[i / 4 % LEN(times)];
        size_t k = i % 4; /* alpha = 0, 1 Riemann-Liouville; 1/2, 1 Caputo */
        fvi_linear_oscillator p = { 1,
                         1,
                         rho,
                         k == 2   ? 0.5
                         : k == 0 ? 0
                                  : 1,
                         k > 1 ? FVI_INITIAL_HISTORY_CAPUTO : FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE,
                         kept[k],
                         v0,
                         FVI_FORCING_NONE,
                         0,
                         0,
                         0, NULL };
        double mass = 1 + (k % 2 ? rho : 0), spring = 1 + (k == 0 ? rho : 0);
        double jump = k == 1 && t > 0 ? v0 / mass : v0; /* of x' at t = 0 */
        double x, v, X, V;
        solve(&p, t, &x, &v);
        two_exponentials(mass, k == 2 ? rho : 0, spring, p.x0, jump, t, &X, &V);
        ck_assert_near(x, X, 2 * TOL, "k=%zu rho=%g t=%g", k, rho, t);
        ck_assert_near(v, V, 12 * TOL, "k=%zu rho=%g t=%g", k, rho, t);
    }
}
END_TEST

/* Critical damping, a free particle, one braked by rho x', and alpha = 0 where
 * Caputo's spring rests at x0: it has c x + rho (x - x0). */
START_TEST(eq_11_13_special_closed_forms)
{
    for (double t = 1e-4; t < 40; t *= 3) {
        fvi_linear_oscillator p = { .m = 1,
                         .c = 1,
                         .rho = 2,
                         .alpha = 0.5,
                         .x0 = 1,
                         .v0 = 2,
                         .past = FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE };
        ck_assert_near(solve_x(p, t), exp(-t) * (1 + 3 * t), 2 * TOL, "t=%g",
                       t);
        p = (fvi_linear_oscillator){ .m = 2,
                          .x0 = 1,
                          .v0 = 3,
                          .alpha = 0.3,
                          .forcing = FVI_FORCING_STEP,
                          .A = 5,
                          .T = 1e300 };
        double want = 1 + 3 * t + 1.25 * t * t;
        ck_assert_near(solve_x(p, t), want, TOL * want, "t=%g", t);
        p = (fvi_linear_oscillator){ .m = 2,
                          .rho = 4,
                          .x0 = 1,
                          .v0 = 3,
                          .alpha = 0.5,
                          .past = FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE };
        want = 1 - 1.5 * expm1(-2 * t);
        ck_assert_near(solve_x(p, t), want, TOL * want, "t=%g", t);
        p = (fvi_linear_oscillator){
            .m = 1, .c = 1, .rho = 3, .past = FVI_INITIAL_HISTORY_CAPUTO, .x0 = 4
        };
        ck_assert_near(solve_x(p, t), 3 + cos(2 * t), 4 * TOL, "t=%g", t);
    }
}
END_TEST

/* sum over j, k of (-1)^(j+k) binom(j+k, j) X^j Y^k s^(q + step j + two k), turned
 * into a function of t: s^e gives t^(-e-1) / Gamma(-e), nothing if e = 0, 1, 2 ... */
static double series(double X, double Y, double q, double step, double two,
                     double t, double *size)
{
    double sum = 0;
    *size = 0;
    for (int n = 25; n >= 0; n--)
        for (int j = 0; j <= n; j++) {
            double e = -(q + step * j + two * (n - j));
            if (e <= 0 && e == floor(e))
                continue;
            double binomial =
                round(exp(lgamma(n + 1) - lgamma(j + 1) - lgamma(n - j + 1)));
            double term = binomial * pow(-X, j) * pow(-Y, n - j) * pow(t, e - 1)
                          / tgamma(e);
            sum += term;
            *size += fabs(term);
        }
    return sum;
}

/* Small t: powers of 1/s. Relative to x itself, which is as small as t. pow and
 * tgamma are good to 20 u; the terms left out, n > 25, are below (R + C)^26 for
 * R + C < 0.4. Seen: 6 u. */
START_TEST(eq_11_9_power_series_for_small_times)
{
    const double alphas[] = { 0,   1e-10,       0.1,  0.25, 0.5 - 0x1p-54,
                              0.5, 0.5 + 1e-10, 0.75, 0.9 };
    for (size_t i = 0; i < LEN(alphas); i++)
        for (double t = 1e-6, b = 2 * alphas[i]; t < 0.4; t *= 5) {
            double x, v, size;
            fvi_linear_oscillator p = oscillator(alphas[i], 0, 0, 1);
            solve(&p, t, &x, &v);
            double X = series(RHO, 1, -2, b - 2, -2, t, &size);
            ck_assert_near(x, X, TOL * size, "x, alpha=%g t=%g", b / 2, t);
            double V = series(RHO, 1, -1, b - 2, -2, t, &size);
            ck_assert_near(v, V, TOL * size, "v, alpha=%g t=%g", b / 2, t);
        }
}
END_TEST

/* Large t: powers of s. The tail is smaller by t^(-2 alpha) than the integrand at
 * |s| = 1/t, which is 1/t: TOL of that. The oscillation is below e^-55. */
START_TEST(eq_11_9_tails)
{
    const double alphas[] = { 0.15, 0.25, 0.4, 0.6, 0.75, 0.9 };
    for (size_t i = 0; i < LEN(alphas); i++)
        for (double t = 2e3, b = 2 * alphas[i]; t < 1e5; t *= 3) {
            double size, x = series(RHO, 1, 0, b, 2, t, &size);
            double caputo = RHO * series(RHO, 1, b - 1, b, 2, t, &size);
            double first = -RHO * pow(t, -1 - b) / tgamma(-b);
            ck_assert_near(x / first, 1, 3 * pow(t, -b) + 22 / (t * t),
                           "alpha=%g", b / 2); /* the next two terms */
            ck_assert_near(solve_x(oscillator(b / 2, 0, 0, 1), t), x, TOL / t,
                           "alpha=%g t=%g", b / 2, t);
            caputo += series(RHO, 1, 1, b, 2, t, &size); /* that of m s x0 */
            ck_assert_near(solve_x(oscillator(b / 2, 1, 1, 0), t), caputo,
                           TOL * pow(t, -b), "alpha=%g t=%g", b / 2, t);
        }
}
END_TEST

/* No damping, m = c = 1: x = (cos t - cos wt) / (w^2 - 1), written so that no
 * digit is lost; w = 1 + 2^-k, and t = 2^j: the arguments are exact. */
START_TEST(eq_11_12_resonance)
{
    for (int j = -3; j <= 13; j++)
        for (int k = 1; k <= 45; k += 4) {
            double t = ldexp(1, j), e = k < 45 ? ldexp(1, -k) : 0, w = 1 + e;
            fvi_linear_oscillator p = { .m = 1,
                             .c = 1,
                             .alpha = 0.3,
                             .A = 1,
                             .w = w,
                             .forcing = FVI_FORCING_COSINE };
            double slow = e > 0 ? sin(e * t / 2) / e : t / 2;
            double want = 2 * sin((1 + e / 2) * t) * slow / (w + 1);
            ck_assert_near(solve_x(p, t), want, TOL * smaller(t, 1 / e),
                           "t=2^%d w=1+2^-%d", j, k);
        }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("11 exact solution, closed forms and series");
    ADD_CASE(suite, "closed forms", eq_11_12_resonance,
             eq_11_13_integer_orders_have_closed_forms,
             eq_11_13_special_closed_forms);
    ADD_CASE(suite, "series", eq_11_9_power_series_for_small_times,
             eq_11_9_tails);
    return run_suite(suite);
}
