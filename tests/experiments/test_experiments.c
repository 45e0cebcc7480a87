/* tests/experiments/test_experiments.c -- H 10: the tools that measure errors and orders.
 * Run alone: make test-experiments
 *
 * test_experiments_panels.c and test_experiments_bagley_torvik.c test the measurements. */
#include <fvi/fvi.h>
#include <fvi/paper/experiments.h>
#include "harness/ulp.h"

#include "experiments_ref.h"

#include <gsl/gsl_math.h>
#include <stddef.h>

/* Under AddressSanitizer, too, malloc may say no. */
const char *__asan_default_options(void)
{
    return "allocator_may_return_null=1";
}

/* ---- (10.1) ---- */

/* What fvi_damped_oscillator promises; L is rho / 2m or the slower rate. The
 * roundings: 5.5 (L t) u in the decay, 4.5 (w t) u in the phase, 3.5 (1 + w t) u
 * in G, a dozen u in the sums. Seen: 0.16 of it. */
START_TEST(eq_10_1_the_oscillator_is_the_exponential_of_its_matrix)
{
    for (size_t i = 0; i < LEN(ref_oscillator); i++) {
        double m = ref_oscillator[i].m, rho = ref_oscillator[i].rho;
        double c = ref_oscillator[i].c, t = ref_oscillator[i].t;
        double x0 = ref_oscillator[i].x0, p0 = ref_oscillator[i].p0, x, p;
        double s = sqrt(fabs(rho * rho - 4 * m * c)) / (2 * m);
        double L =
            rho * rho > 4 * m * c ? c / m / (rho / (2 * m) + s) : rho / (2 * m);
        double g = s * t > 1 ? 1 / s : t;
        double w = rho * rho > 4 * m * c ? 0 : s;
        double size = (24 + 10 * (L + w) * t) * U * exp(-L * t);
        ck_assert_int_eq(fvi_damped_oscillator(m, rho, c, x0, p0, t, &x, &p),
                         FVI_SUCCESS);
        ck_assert_near(x, ref_oscillator[i].x,
                       size * ((1 + L * g) * fabs(x0) + g * fabs(p0) / m),
                       "x, row %zu, t=%g", i, t);
        ck_assert_near(p, ref_oscillator[i].p,
                       size * ((1 + L * g) * fabs(p0) + c * g * fabs(x0)),
                       "p, row %zu, t=%g", i, t);
    }
}
END_TEST

/* To t = 3 at once or in two parts: three times the bound above. For these data
 * L + s <= 1 + rho, and e^{-L t} (1 + L g + g) |start| <= 2.4. Seen: 1.5 u. */
START_TEST(eq_10_1_the_flow_is_a_semigroup)
{
    const double rhos[] = { 0, 0.2, 2, 2 + 1e-9, 5 };
    for (size_t i = 0; i < LEN(rhos); i++) {
        double x, p, y, q;
        fvi_damped_oscillator(1, rhos[i], 1, 1, 0.5, 3, &x, &p);
        fvi_damped_oscillator(1, rhos[i], 1, 1, 0.5, 1.25, &y, &q);
        fvi_damped_oscillator(1, rhos[i], 1, y, q, 1.75, &y, &q);
        double bound = 3 * (24 + 10 * (1 + rhos[i]) * 3) * U * 2.4;
        ck_assert_near(x, y, bound, "x, rho=%g", rhos[i]);
        ck_assert_near(p, q, bound, "p, rho=%g", rhos[i]);
    }
}
END_TEST

/* ---- (10.9) ---- */

/* At alpha = 0 the damping is a spring, at alpha = 1 a mass. Short binary fractions
 * in every element of the matrix: the same matrix, 0 ulp. */
START_TEST(eq_10_9_at_both_ends_the_damping_is_a_spring_and_a_mass)
{
    int (*const both[])(double, double, double, double, fvi_force, double,
                        size_t, double *) = { fvi_matrix_method,
                                              fvi_matrix_method_simple };
    enum { N = 40 };
    const double aw[2] = { 1, 2 };
    const fvi_force wave = fvi_force_cosine(aw);
    double x[N + 1], want[N + 1];
    for (size_t i = 0; i < 2 * LEN(both); i++) {
        const double alpha = (double)(i % 2);
        ck_assert_int_eq(both[i / 2](1, 0.5, 2, alpha, wave, 0.25, N, x), 0);
        ck_assert_int_eq(both[i / 2](1 + alpha / 2, 0, 2.5 - alpha / 2, 0.5,
                                     wave, 0.25, N, want),
                         0);
        ck_assert_double_gt(fabs(want[N]), 1e-3);
        for (size_t k = 0; k <= N; k++)
            ck_assert_ulp(x[k], want[k], 0, "alpha=%g k=%zu", alpha, k);
    }
}
END_TEST

/* ---- (10.3) ---- */

/* K h^2: logarithms below 4.5, each rounded once. In the slope an error counts at
 * most 2 / log 2 times, which makes 40 u with the roundings of the sums; in log K
 * twice that. Seen: 8 u; 32 u in K. */
START_TEST(eq_10_3_the_slope_of_a_power_is_its_exponent)
{
    const double h[] = { 0.5, 0.25, 0.125, 0.0625 };
    double e[4], order, K;
    for (size_t i = 0; i < 4; i++)
        e[i] = 3 * h[i] * h[i];
    for (size_t n = 2; n <= 4; n++) {
        ck_assert_int_eq(fvi_observed_order(n, h, e, &order, &K), FVI_SUCCESS);
        ck_assert_near(order, 2, 40 * U, "n=%zu", n);
        ck_assert_near(K, 3, 400 * U, "n=%zu", n);
    }
    const double noisy[] = { 8, 1, 1, 0.125 }; /* logs 3, 0, 0, -3: slope 9/5 */
    ck_assert_int_eq(fvi_observed_order(4, h, noisy, &order, NULL),
                     FVI_SUCCESS);
    ck_assert_near(order, 1.8, 40 * U, "least squares");
}
END_TEST

/* ---- errors ---- */

static const double OUTSIDE[] = { -1, GSL_NAN, GSL_POSINF, GSL_NEGINF };

START_TEST(bad_oscillators_are_refused_and_outputs_untouched)
{
    double x = 7, p = 8;
    ck_assert_int_eq(fvi_damped_oscillator(1, 1, 1, 1, 1, 1, NULL, NULL),
                     FVI_EFAULT);
    for (size_t i = 0; i < 6; i++)
        for (size_t j = 0; j < LEN(OUTSIDE); j++) {
            double a[6] = { 1, 1, 1, 1, 1, 1 };
            if ((i == 3 || i == 4) && j == 0)
                continue; /* x0 and p0 may be negative */
            a[i] = OUTSIDE[j];
            ck_assert_int_eq(fvi_damped_oscillator(a[0], a[1], a[2], a[3], a[4],
                                                   a[5], &x, &p),
                             FVI_EDOM);
        }
    const double range[][3] = { { 0, 1, 1 },     { 1e-141, 1, 1 },
                                { 1e141, 1, 1 }, { 1, 1e-141, 1 },
                                { 1, 1e141, 1 }, { 1, 1, 1e-141 },
                                { 1, 1, 1e141 } };
    for (size_t i = 0; i < LEN(range); i++)
        ck_assert_int_eq(fvi_damped_oscillator(range[i][0], range[i][1],
                                               range[i][2], 1, 1, 1, &x, &p),
                         FVI_EDOM);
    ck_assert_int_eq(fvi_damped_oscillator(1e-10, 0, 0, 1, 1e300, 1, &x, &p),
                     FVI_EOVRFLW);
    ck_assert_int_eq(fvi_damped_oscillator(1, 0, 1e10, 1e300, 0, 1e-3, &x, &p),
                     FVI_EOVRFLW);
    ck_assert(x == 7 && p == 8);
    ck_assert_int_eq(fvi_damped_oscillator(1, 0, 0, 1, 2, 3, &x, NULL), 0);
    ck_assert_int_eq(fvi_damped_oscillator(1, 0, 0, 1, 2, 3, NULL, &p), 0);
    ck_assert(x == 7 && p == 2); /* 1 + 2 * 3 */
}
END_TEST

START_TEST(bad_error_studies_are_refused_and_outputs_untouched)
{
    const fvi_method *fvi = &fvi_fractional;
    double e[3] = { 7, 8, 9 };
    ck_assert_int_eq(fvi_oscillator_errors(fvi, 1, 1, 1, 1, 1, 0.1, 5, NULL),
                     FVI_EFAULT);
    ck_assert_int_eq(fvi_oscillator_errors(NULL, 1, 1, 1, 1, 1, 0.1, 5, e),
                     FVI_EFAULT);
    ck_assert_int_eq(fvi_oscillator_errors(fvi, 1, 1, 1, 1, 1, 0.1, 0, e),
                     FVI_EINVAL);
    ck_assert_int_eq(fvi_oscillator_errors(fvi, 1, 1, 1, 1, 1, 0, 5, e),
                     FVI_EDOM);
    ck_assert_int_eq(fvi_oscillator_errors(fvi, 0, 1, 1, 1, 1, 0.1, 5, e),
                     FVI_EDOM);
    ck_assert_int_eq(fvi_oscillator_errors(fvi, 1, 1, -1, 1, 1, 0.1, 5, e),
                     FVI_EDOM); /* fvi_damped_oscillator's */
    ck_assert_int_eq(
        fvi_oscillator_errors(&fvi_midpoint_variational, 1, 1, 1, 1, 1, 0.1, 5, e),
        FVI_EINVAL);
    ck_assert_int_eq(
        fvi_oscillator_errors(&fvi_euler_explicit, 1, 1, 1, 1, 1, 1e20, 50, e),
        FVI_EOVRFLW);
    ck_assert(e[0] == 7 && e[1] == 8 && e[2] == 9);
}
END_TEST

static int infinite(double t, size_t d, void *params, double *F)
{
    (void)params;
    for (size_t i = 0; i < d; i++)
        F[i] = t > 2 ? GSL_POSINF : 0;
    return 0;
}

START_TEST(bad_matrix_methods_are_refused_and_x_is_untouched)
{
    int (*const both[])(double, double, double, double, fvi_force, double,
                        size_t, double *) = { fvi_matrix_method,
                                              fvi_matrix_method_simple };
    const fvi_force none = { 0 }, bad = { .value = infinite };
    for (size_t i = 0; i < 2; i++) {
        double x[4] = { 6, 7, 8, 9 };
        ck_assert_int_eq(both[i](1, 1, 1, 0.5, none, 0.1, 3, NULL), FVI_EFAULT);
        ck_assert_int_eq(both[i](1, 1, 1, 0.5, none, 0.1, 1, x), FVI_EINVAL);
        ck_assert_int_eq(both[i](1, 1, 1, 0.5, none, 0.1, SIZE_MAX, x),
                         FVI_EINVAL);
        ck_assert_int_eq(both[i](0, 1, 1, 0.5, none, 0.1, 3, x), FVI_EDOM);
        ck_assert_int_eq(both[i](1, 1, 1, 1.5, none, 0.1, 3, x), FVI_EDOM);
        ck_assert_int_eq(both[i](1, 1, 1, 0.5, none, 0, 3, x), FVI_EDOM);
        for (size_t j = 0; j < LEN(OUTSIDE); j++) {
            double o = OUTSIDE[j];
            ck_assert_int_eq(both[i](o, 1, 1, 0.5, none, 0.1, 3, x), FVI_EDOM);
            ck_assert_int_eq(both[i](1, o, 1, 0.5, none, 0.1, 3, x), FVI_EDOM);
            ck_assert_int_eq(both[i](1, 1, o, 0.5, none, 0.1, 3, x), FVI_EDOM);
            ck_assert_int_eq(both[i](1, 1, 1, o, none, 0.1, 3, x), FVI_EDOM);
            ck_assert_int_eq(both[i](1, 1, 1, 0.5, none, o, 3, x), FVI_EDOM);
        }
        ck_assert_int_eq(both[i](1, 1, 1, 0.5, bad, 1, 3, x), FVI_EOVRFLW);
        ck_assert_int_eq(both[i](1, 1, 1, 0.5, none, 1e-200, 3, x),
                         FVI_EOVRFLW);
        ck_assert(x[0] == 6 && x[1] == 7 && x[2] == 8 && x[3] == 9);
        ck_assert_int_eq(both[i](1, 1, 1, 0.5, none, 0.1, 2, x), FVI_SUCCESS);
        ck_assert(x[0] == 0 && x[1] == 0 && x[2] == 0 && x[3] == 9);
    }
    double x[1] = { 6 };
    ck_assert_int_eq(
        fvi_matrix_method_simple(1, 1, 1, 0.5, none, 0.1, SIZE_MAX / 64, x),
        FVI_EINVAL);
    ck_assert_int_eq(
        fvi_matrix_method(1, 1, 1, 0.5, none, 0.1, SIZE_MAX / 64, x),
        FVI_ENOMEM);
    ck_assert_int_eq(
        fvi_matrix_method_simple(1, 1, 1, 0.5, none, 0.1, (size_t)1 << 29, x),
        FVI_ENOMEM);
    ck_assert(x[0] == 6);
}
END_TEST

START_TEST(bad_slopes_are_refused_and_outputs_untouched)
{
    const double h[] = { 1, 0.5 }, same[] = { 0.5, 0.5 };
    double order = 7, K = 8;
    ck_assert_int_eq(fvi_observed_order(2, NULL, h, &order, &K), FVI_EFAULT);
    ck_assert_int_eq(fvi_observed_order(2, h, NULL, &order, &K), FVI_EFAULT);
    ck_assert_int_eq(fvi_observed_order(2, h, h, NULL, NULL), FVI_EFAULT);
    ck_assert_int_eq(fvi_observed_order(1, h, h, &order, &K), FVI_EINVAL);
    ck_assert_int_eq(fvi_observed_order(SIZE_MAX / 2, h, h, &order, &K),
                     FVI_EINVAL);
    ck_assert_int_eq(fvi_observed_order(2, same, h, &order, &K), FVI_EDOM);
    for (size_t j = 0; j <= LEN(OUTSIDE); j++) {
        const double bad[] = { 1, j < LEN(OUTSIDE) ? OUTSIDE[j] : 0 };
        ck_assert_int_eq(fvi_observed_order(2, bad, h, &order, &K), FVI_EDOM);
        ck_assert_int_eq(fvi_observed_order(2, h, bad, &order, &K), FVI_EDOM);
    }
    ck_assert(order == 7 && K == 8);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("10 experiments");
    ADD_CASE(suite, "values",
             eq_10_1_the_oscillator_is_the_exponential_of_its_matrix);
    ADD_CASE(suite, "identities", eq_10_1_the_flow_is_a_semigroup,
             eq_10_9_at_both_ends_the_damping_is_a_spring_and_a_mass,
             eq_10_3_the_slope_of_a_power_is_its_exponent);
    ADD_CASE(suite, "errors", bad_oscillators_are_refused_and_outputs_untouched,
             bad_error_studies_are_refused_and_outputs_untouched,
             bad_matrix_methods_are_refused_and_x_is_untouched,
             bad_slopes_are_refused_and_outputs_untouched);
    return run_suite(suite);
}
