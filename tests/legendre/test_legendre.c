/* tests/legendre/test_legendre.c -- H 8: the momenta.
 * Run alone: make test-legendre */
#include <fvi/error.h>
#include <fvi/paper/half_derivative.h>
#include <fvi/paper/integration_by_parts.h>
#include <fvi/paper/legendre.h>
#include "harness/fvi_runs.h"
#include "harness/ulp.h"

#include "legendre_ref.h"

#include <gsl/gsl_math.h>

static const double none[3];
static const double quartic[] = { 1, 2 }, mass3[] = { 1, 2, 0.5 };
static const double start_x[] = { 0.5, -0.75, 1 },
                    start_p[] = { 1, 0.25, -0.5 };

/* ---- values ---- */

/* Short binary fractions: every operation is exact. 0 ulp by design. */
static const double mass2[] = { 1, 1.5 }, rho2[] = { 0.5, 0.75 };
static const double here[] = { 0.5, -0.25 }, there[] = { 0.75, 0.125 };

static fvi_system momentum_system(size_t row)
{
    return (fvi_system){
        2,     mass2,
        rho2,  potential(ref_momenta[row].kind, ref_momenta[row].cg),
        { 0 }, NULL, NULL
    };
}

START_TEST(eq_8_1_the_momentum_that_a_step_begins_with)
{
    for (size_t r = 0; r < LEN(ref_momenta); r++) {
        const fvi_system s = momentum_system(r);
        double p[2];
        ck_assert_int_eq(
            fvi_legendre_minus(&s, ref_momenta[r].kappa, 0.25, here, there, p),
            0);
        for (size_t i = 0; i < 2; i++)
            ck_assert_ulp(p[i], ref_momenta[r].minus[i], 0, "minus %zu", r);
    }
}
END_TEST

START_TEST(eq_8_2_the_momentum_that_a_step_ends_with)
{
    const double D[] = { 1.25, -0.5 }, F[] = { -0.375, 2 };
    for (size_t r = 0; r < LEN(ref_momenta); r++) {
        const fvi_system s = momentum_system(r);
        const struct {
            const char *name;
            const double *D, *F, *want;
        } cases[] = { { "plus", NULL, NULL, ref_momenta[r].plus },
                      { "damped", D, NULL, ref_momenta[r].damped },
                      { "forced", NULL, F, ref_momenta[r].forced },
                      { "both", D, F, ref_momenta[r].both } };
        for (size_t j = 0; j < LEN(cases); j++) {
            double p[2];
            ck_assert_int_eq(fvi_legendre_plus(&s, ref_momenta[r].kappa, 0.25,
                                               here, there, cases[j].D,
                                               cases[j].F, p),
                             0);
            for (size_t i = 0; i < 2; i++)
                ck_assert_ulp(p[i], cases[j].want[i], 0, "%s %zu",
                              cases[j].name, r);
        }
    }
}
END_TEST

/* ---- identities ---- */

static int ramp(double t, size_t d, void *params, double *F)
{
    const double *slope = params;
    for (size_t i = 0; i < d; i++)
        F[i] = slope[i] * t;
    return 0;
}

/* A run of Algorithm 3, three masses in a quartic chain, two of them damped, and a
 * force: at every node the momentum is F^- of the step ahead and F^+ of the step
 * behind. Each stored x is rounded, and the slopes multiply that by m/h; with the
 * 10 roundings of p and of each slope less than 64 u m max|x| / h (H 2).
 * The two sums of H 5 add at most 2 (N + 5) u h rho h^(-2 alpha)
 * (sum |alpha_n|)^2 max|x|, where sum |alpha_n| <= 2. Seen: 0.005 of the bound. */
START_TEST(eq_8_3_momenta_match_at_every_node)
{
    enum { N = 60 };
    const double rho[] = { 0.5, 0, 0.25 }, push[] = { 0.25, 0, -0.5 };
    const double alphas[] = { 0, 0.3, 0.5, 0.75, 1 };
    const fvi_system system = { 3,
                                mass3,
                                rho,
                                fvi_potential_chain(quartic),
                                { .value = ramp, .params = (void *)push },
                                NULL, NULL };
    double x[3 * (N + 1)], p[3 * (N + 1)], D[3 * (N + 1)];
    for (size_t r = 0; r < LEN(alphas) * 5; r++) {
        const setup a = { .alpha = alphas[r / 5],
                          .past = FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE,
                          .kappa = 0.25 * (double)(r % 5),
                          .h = 0.05,
                          .steps = N };
        run(&fvi_fractional, &a, &system, start_x, start_p, x, p);
        fvi_delta_twice(a.alpha, a.h, N, 3, x, D);
        const double bound =
            (64 * 2 / a.h + 8 * (N + 5) * pow(a.h, 1 - 2 * a.alpha)) * U
            * farthest(LEN(x), x, NULL);
        //> matching
        for (size_t k = 0; k <= N; k++) {
            const double *at = x + 3 * k;
            double minus[3], plus[3], F[3];
            ramp((double)k * a.h, 3, (void *)push, F);
            if (k < N)
                fvi_legendre_minus(&system, a.kappa, a.h, at, at + 3, minus);
            if (k > 0)
                fvi_legendre_plus(&system, a.kappa, a.h, at - 3, at, D + 3 * k,
                                  F, plus);
            for (size_t i = 0; i < 3; i++) {
                if (k < N)
                    ck_assert_near(minus[i], p[3 * k + i], bound,
                                   "F^-, k = %zu, run %zu", k, r);
                if (k > 0)
                    ck_assert_near(plus[i], p[3 * k + i], bound,
                                   "F^+, k = %zu, run %zu", k, r);
            }
        }
        //< matching
    }
}
END_TEST

/* F^- after its inverse, and its inverse after F^-. x_{k+1} is rounded, and what
 * Newton's method leaves is a few roundings of the terms of (2.10); |D12 L_d| is at
 * most m/h + h |U''|, |its inverse| at most h/m as U'' >= 0 here (h^2 |U''| < m for
 * the pendulum: 2 h/m): 64 u (m/h + h |U''|) max(|x|, |y|) there, and that times
 * 2 h/m back. Seen: 0.006 of the bound. */
START_TEST(eq_8_4_there_and_back)
{
    const double h = 0.125, cg[] = { 1, 2 }, y[] = { 0.625, -0.5, 0.75 };
    const int kinds[] = { HARMONIC, DUFFING, CHAIN, PENDULUM };
    for (size_t r = 0; r < LEN(kinds) * 5; r++) {
        const fvi_system s = { 3,     mass3,
                               none,  potential(kinds[r % LEN(kinds)], cg),
                               { 0 }, NULL, NULL };
        const double kappa = 0.25 * (double)(r / LEN(kinds));
        double p[3], next[3];
        const double bound = 64 * U * (2 / h + h * 64);
        fvi_legendre_minus(&s, kappa, h, start_x, y, p);
        ck_assert_int_eq(fvi_legendre_inverse(&s, kappa, h, start_x, p, next),
                         0);
        for (size_t i = 0; i < 3; i++)
            ck_assert_near(next[i], y[i], bound * 2 * h / 0.5, "y, run %zu", r);
        ck_assert_int_eq(
            fvi_legendre_inverse(&s, kappa, h, start_x, start_p, next), 0);
        fvi_legendre_minus(&s, kappa, h, start_x, next, p);
        for (size_t i = 0; i < 3; i++)
            ck_assert_near(p[i], start_p[i], bound, "p, run %zu", r);
    }
}
END_TEST

/* Statement 2: the rows of a run with kappa = 0 put into (8.5), with the momenta
 * p^alpha of the memory. The first line rounds twice; the second is good to 8 u
 * max(|p|, h |U'|), and its memory as above. Seen: 0.06 of the bound. */
START_TEST(eq_8_5_kappa_0_is_the_fractional_symplectic_euler_method)
{
    enum { N = 60 };
    const double alphas[] = { 0.1, 0.3, 0.5, 0.75, 1 }, rho = 0.5, h = 0.05;
    double x[N + 1], p[N + 1], p_alpha[N + 1], term[N + 1], g;
    for (size_t r = 0; r < LEN(alphas); r++) {
        const setup a = { alphas[r], 0,    h, N,   FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE,
                          2,         rho,  1, 0.5, DUFFING,
                          { 1, 1 },  { 0 } };
        solve(&fvi_fractional, &a, x, p);
        fvi_delta_minus(a.alpha, h, N, 1, x, p_alpha);
        for (size_t k = 0; k <= N; k++)
            p_alpha[k] *= -h * rho;
        fvi_delta_minus(a.alpha, h, N, 1, p_alpha, term);
        const double size = farthest(N + 1, p, NULL) + h * 8;
        const double bound = 8 * U * size
                             + 8 * (N + 5) * rho * pow(h, 1 - 2 * a.alpha) * U
                                   * farthest(N + 1, x, NULL);
        for (size_t k = 0; k < N; k++) {
            ck_assert_near(x[k + 1], x[k] + h * p[k] / 2, 4 * U * 2, "x, %zu",
                           k);
            g = (1 + x[k + 1] * x[k + 1]) * x[k + 1];
            ck_assert_near(p[k + 1], p[k] - h * g + term[k + 1], bound,
                           "p, k = %zu, alpha = %g", k, a.alpha);
        }
    }
}
END_TEST

/* Statement 3, in short binary fractions: two steps of a Duffing oscillator, ten
 * of a harmonic one. 0 ulp. */
//> half
START_TEST(eq_8_6_alpha_one_half_is_linear_damping_exactly)
{
    const double h = 0.25, m = 2, rho = 0.5;
    const int kinds[] = { DUFFING, HARMONIC };
    const size_t steps[] = { 2, 10 };
    for (size_t r = 0; r < 2; r++) {
        const setup a = {
            0.5,      0,    h, steps[r], FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE,
            m,        rho,  1, 0.5,      kinds[r],
            { 1, 1 }, { 0 }
        };
        double x[11], p[11];
        solve(&fvi_fractional, &a, x, p);
        for (size_t k = 0; k < steps[r]; k++) {
            double next = x[k] + h * p[k] / m;
            double g = kinds[r] == DUFFING ? (1 + next * next) * next : next;
            ck_assert_ulp(x[k + 1], next, 0, "x, k = %zu", k);
            ck_assert_ulp(p[k + 1], p[k] - h * g - h * rho * p[k] / m, 0,
                          "p, k = %zu", k);
        }
    }
}
END_TEST
//< half

/* Its determinant: the map is a polynomial of degree 3 in each variable, whose
 * derivative the five points (1, -8, 0, 8, -1)/12 delta give exactly. 0 ulp. */
START_TEST(eq_8_6_areas_shrink_by_1_minus_h_rho_over_m)
{
    const double h = 0.25, m = 2, rho = 0.5, delta = 0.25;
    const double weight[] = { 1, -8, 0, 8, -1 };
    double M[2][2] = { { 0 } };
    for (size_t column = 0; column < 2; column++)
        for (size_t j = 0; j < 5; j++) {
            const double shift = ((double)j - 2) * delta;
            const setup a = { 0.5,
                              0,
                              h,
                              1,
                              FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE,
                              m,
                              rho,
                              0.5 + (column == 0 ? shift : 0),
                              1 + (column == 1 ? shift : 0),
                              DUFFING,
                              { 1, 2 },
                              { 0 } };
            double x[2], p[2];
            solve(&fvi_fractional, &a, x, p);
            M[0][column] += weight[j] * x[1];
            M[1][column] += weight[j] * p[1];
        }
    ck_assert_ulp((M[0][0] * M[1][1] - M[0][1] * M[1][0]) / 9, 1 - h * rho / m,
                  0, "determinant");
}
END_TEST

/* ---- errors ---- */

START_TEST(bad_steps_are_refused_and_outputs_untouched)
{
    const double one = 1, x = 1, y = 2, nan = GSL_NAN, inf = GSL_POSINF,
                 huge = 1e308;
    const double soft = -4, cubic[] = { 0, 1 }, zero = 0;
    const fvi_system good = { 1,     &one, &one, fvi_potential_harmonic(&one),
                              { 0 }, NULL, NULL };
    fvi_system bad = good, singular = good, hopeless = good, freely = good;
    freely.potential = (fvi_potential){ 0 };
    bad.mass = NULL;
    singular.potential = fvi_potential_harmonic(&soft); /* 1 - 4/4 = 0 */
    hopeless.potential = potential(CUBIC, cubic); /* d + (d/2)^2/2 = -8: none */
    double p = 7;
#define REFUSE(code, system, kappa, h, a, b)                                   \
    ck_assert_int_eq(fvi_legendre_minus(system, kappa, h, a, b, &p), code);    \
    ck_assert_int_eq(fvi_legendre_plus(system, kappa, h, a, b, &x, &x, &p),    \
                     code);                                                    \
    ck_assert_int_eq(fvi_legendre_inverse(system, kappa, h, a, b, &p), code)
    REFUSE(FVI_EFAULT, NULL, 0.5, 1, &x, &y);
    REFUSE(FVI_EFAULT, &bad, 0.5, 1, &x, &y);
    REFUSE(FVI_EFAULT, &good, 0.5, 1, NULL, &y);
    REFUSE(FVI_EFAULT, &good, 0.5, 1, &x, NULL);
    REFUSE(FVI_EDOM, &good, -0x1p-1074, 1, &x, &y);
    REFUSE(FVI_EDOM, &good, 1 + 0x1p-52, 1, &x, &y);
    REFUSE(FVI_EDOM, &good, nan, 1, &x, &y);
    REFUSE(FVI_EDOM, &good, 0.5, 0, &x, &y);
    REFUSE(FVI_EDOM, &good, 0.5, nan, &x, &y);
    REFUSE(FVI_EDOM, &good, 0.5, inf, &x, &y);
    ck_assert_int_eq(fvi_legendre_minus(&good, 0.5, 1, &x, &y, NULL),
                     FVI_EFAULT);
    ck_assert_int_eq(fvi_legendre_plus(&good, 0.5, 1, &x, &y, NULL, NULL, NULL),
                     FVI_EFAULT);
    ck_assert_int_eq(fvi_legendre_inverse(&good, 0.5, 1, &x, &y, NULL),
                     FVI_EFAULT);
#define FAIL(code, system, h, x, p_)                                           \
    ck_assert_int_eq(fvi_legendre_inverse(&system, 0.5, h, x, p_, &p), code)
    FAIL(FVI_EDOM, good, 1, &nan, &y);
    FAIL(FVI_EDOM, good, 1, &x, &inf);
    FAIL(FVI_EDOM, good, 0x1p-1074, &x, &y); /* m / h is infinite */
    FAIL(FVI_ESING, singular, 1, &x, &y);
    FAIL(FVI_EMAXITER, hopeless, 1, &zero, &(const double){ -8 });
    FAIL(FVI_EOVRFLW, freely, 10, &zero, &huge);
    ck_assert_double_eq(p, 7);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("08 legendre");
    ADD_CASE(suite, "values", eq_8_1_the_momentum_that_a_step_begins_with,
             eq_8_2_the_momentum_that_a_step_ends_with);
    ADD_CASE(suite, "identities", eq_8_3_momenta_match_at_every_node,
             eq_8_4_there_and_back,
             eq_8_5_kappa_0_is_the_fractional_symplectic_euler_method,
             eq_8_6_alpha_one_half_is_linear_damping_exactly,
             eq_8_6_areas_shrink_by_1_minus_h_rho_over_m);
    ADD_CASE(suite, "errors", bad_steps_are_refused_and_outputs_untouched);
    return run_suite(suite);
}
