/* tests/experiments/test_experiments_bagley_torvik.c -- H 10, x'' + x + D^(3/2) x = F,
 * F = 8 up to t = 1, then 0, at rest: by the FVI and by the matrix method.
 * Run alone: make test-experiments_bagley_torvik */
#include <fvi/fvi.h>
#include "run/whole_run.h"
#include <fvi/paper/experiments.h>
#include "harness/ulp.h"

#include "experiments_bagley_torvik_ref.h"

#include <stddef.h>
#include <stdlib.h>

static const double ONE = 1, ZERO = 0, STEP[2] = { 8, 1 };

static void by_fvi(double h, size_t N, double *x)
{
    const fvi_system system = { .d = 1,
                                .mass = &ONE,
                                .damping = &ONE,
                                .potential = fvi_potential_harmonic(&ONE),
                                .force = fvi_force_step(STEP) };
    const fvi_run run = { .system = &system,
                          .x0 = &ZERO,
                          .p0 = &ZERO,
                          .h = h,
                          .steps = N,
                          .kappa = 0.5,
                          .alpha = 0.75,
                          .memory = FVI_HISTORY_DIRECT };
    ck_assert_int_eq(fvi_trajectory(&fvi_fractional, &run, x, NULL, NULL),
                     FVI_SUCCESS);
}

static void by_matrix(double h, size_t N, double *x)
{
    ck_assert_int_eq(
        fvi_matrix_method(1, 1, 1, 0.75, fvi_force_step(STEP), h, N, x),
        FVI_SUCCESS);
}

static void by_filled_matrix(double h, size_t N, double *x)
{
    ck_assert_int_eq(
        fvi_matrix_method_simple(1, 1, 1, 0.75, fvi_force_step(STEP), h, N, x),
        FVI_SUCCESS);
}

/* What rounding can do to x, |x| < 4.5, |x'| < 4.
 * FVI: a sum over k increments, |dx| <= 4 h, is off by k u sum |w_n| |dx| <= 8 k h u;
 * times h^(-1/2), in p; x answers a unit in p by less than 0.6: 3 N^2 h^(1/2) u.
 * Matrix method: a row has N roundings of numbers up to
 * 8 + |x| h^(-3/2) (|w_3| + ...) <= 8 + 0.6 h^(-3/2), and at its end some twenty, those
 * of its elements included, of up to 9 h^-2; x answers a unit in every row by less
 * than 3. Seen: 0.006 of it. */
static double increment_roundings(double N, double h)
{
    return 3 * N * N * sqrt(h) * U;
}

static double row_roundings(double N, double h)
{
    return 3 * (N * (8 + 0.6 * pow(h, -1.5)) + 180 / (h * h)) * U;
}

/* ---- (10.9) ---- */

/* h = 1/4, h^(3/2) = 1/8. A row of the matrix has the elements 25, -44, 19 and some
 * that add up to 1; |x| < 3.1; so a dozen roundings of numbers below 140. A unit in
 * every row makes less than 3 in x (claimed in verify/experiments/experiments_bagley_torvik.py).
 * A step of the FVI has less of both. Seen: 4 u. */
START_TEST(eq_10_9_rational_values_at_h_one_quarter)
{
    enum { N = LEN(ref_matrix_quarter) - 1, FEW = LEN(ref_fvi_quarter) - 1 };
    const double bound = 12 * 140 * 3 * U;
    double x[N + 1], simple[N + 1], fvi[FEW + 1];
    by_matrix(0.25, N, x);
    by_filled_matrix(0.25, N, simple);
    for (size_t k = 0; k <= N; k++) {
        ck_assert_near(x[k], ref_matrix_quarter[k], bound, "k=%zu", k);
        ck_assert_near(simple[k], ref_matrix_quarter[k], bound, "k=%zu", k);
    }
    by_fvi(0.25, FEW, fvi);
    for (size_t k = 0; k <= FEW; k++)
        ck_assert_near(fvi[k], ref_fvi_quarter[k], bound, "FVI, k=%zu", k);
}
END_TEST

/* The same operations in the same order: equal to the last bit, unless this GSL
 * was compiled to contract them; then row_roundings for each. Seen: 0. */
START_TEST(eq_10_9_substitution_is_gsl_s_triangular_solve)
{
    enum { N = 400 };
    double simple[N + 1], x[N + 1];
    by_matrix(0.05, N, x);
    by_filled_matrix(0.05, N, simple);
    for (size_t k = 0; k <= N; k++)
        ck_assert_near(simple[k], x[k], 2 * row_roundings(N, 0.05), "k=%zu", k);
}
END_TEST

/* ---- (10.8) ---- */

/* The reference: where on the grid x is farthest from the exact solution, what
 * that is there, by how much it is missed; and the largest error at the tenths. */
typedef struct {
    size_t per_unit, k;
    double exact, error, tenths;
} expected;

static double at_tenths(const double *x, size_t n, const double *y, size_t m)
{
    double worst = 0;
    for (size_t j = 0; j < LEN(ref_bagley_torvik); j++)
        worst = larger(worst, fabs(x[j * n / 10] - y[j * m / 10]));
    return worst;
}

/* Returns the largest error at the tenths. */
static double compare(const double *x, expected want, double bound)
{
    const size_t n = want.per_unit;
    double worst = at_tenths(x, n, ref_bagley_torvik, 10);
    ck_assert_near(fabs(x[want.k] - want.exact), want.error, bound,
                   "h=1/%zu k=%zu", n, want.k);
    ck_assert_near(worst, want.tenths, bound, "h=1/%zu, tenths", n);
    return worst;
}

enum { T = 20, FINEST = 200, FVIS = LEN(ref_fvi_errors) };

START_TEST(eq_10_8_bagley_torvik_errors)
{
    static double x[T * FINEST + 1], benchmark[T * FINEST + 1];
    double h[FVIS], error[FVIS], against[FVIS];
    by_matrix(1.0 / FINEST, T * FINEST, benchmark);
    for (size_t i = 0; i < FVIS; i++) {
        const size_t n = ref_fvi_errors[i].per_unit, N = T * n;
        const expected want = { n, ref_fvi_errors[i].k, ref_fvi_errors[i].x,
                                ref_fvi_errors[i].error,
                                ref_fvi_errors[i].tenths };
        h[i] = 1 / (double)n;
        by_fvi(h[i], N, x);
        double bound = increment_roundings((double)N, h[i]);
        error[i] = compare(x, want, bound);
        against[i] = at_tenths(x, n, benchmark, FINEST);
        ck_assert_near(against[i], ref_fvi_errors[i].against,
                       bound + row_roundings(T * FINEST, 1.0 / FINEST),
                       "against, h=1/%zu", n);
        seen(error[i], "FVI, h=%g", h[i]);
        seen(against[i], "from the benchmark, h=%g", h[i]);
        if (i > 2) /* h < 1/40: the benchmark's own error is in the way */
            ck_assert_double_gt(against[i], against[i - 1]);
    }
    const size_t halved[] = { 0, 1, 2, 4, 5 }; /* h = 0.1, 0.05, ... */
    double slope = 0.96;
    for (size_t i = 1; i < LEN(halved); i++) {
        size_t to = halved[i], from = halved[i - 1];
        double before = slope, other = log2(against[from] / against[to]);
        slope = log2(error[from] / error[to]); /* rises to the order, 1 */
        ck_assert(before < slope && slope < 1);
        seen(slope, "slope to h=%g", h[to]);
        seen(other, "slope from the benchmark, to h=%g", h[to]);
    }
    fvi_observed_order(4, h, against, &slope, NULL);
    seen(slope, "slope from the benchmark, four points");
    for (size_t i = 0; i < LEN(ref_matrix_errors); i++) {
        const size_t n = ref_matrix_errors[i].per_unit, N = T * n;
        const expected want = { n, ref_matrix_errors[i].k,
                                ref_matrix_errors[i].x,
                                ref_matrix_errors[i].error,
                                ref_matrix_errors[i].tenths };
        by_matrix(1 / (double)n, N, x);
        double own = compare(x, want, row_roundings((double)N, 1 / (double)n));
        seen(own, "matrix method, h=%g", 1 / (double)n);
        for (size_t j = 0; j < FVIS; j++)
            if (n == ref_fvi_errors[j].per_unit)
                seen(own / error[j], "matrix method over FVI");
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("10 experiments, Bagley and Torvik's problem");
    ADD_CASE(suite, "values", eq_10_9_rational_values_at_h_one_quarter,
             eq_10_8_bagley_torvik_errors);
    ADD_CASE(suite, "identities",
             eq_10_9_substitution_is_gsl_s_triangular_solve);
    return run_suite(suite);
}
