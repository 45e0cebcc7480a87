/* tests/convolution_quadrature/test_convolution_quadrature.c -- Chapter 13: the weights.
 * Run alone: make test-convolution_quadrature */
#include <fvi/convolution_quadrature.h>
#include <fvi/convolution_quadrature_stability.h>
#include "harness/fvi_runs.h"

#include "convolution_quadrature_ref.h"

#include <gsl/gsl_math.h>
#include <gsl/gsl_rng.h>

static void weights(fvi_delta kind, double beta, size_t count, double *w)
{
    ck_assert_int_eq(fvi_cq_weights(kind, beta, count, w), FVI_SUCCESS);
}

/* ---- weights ---- */

/* (13.1), to the errors of the header, relative to the larger of w_0 and w_1. BDF2:
 * at most 36 products and sums of terms with sum |g_n w_j| below 2.1 times that, and
 * 40 roundings in each. Trapezoid: 3 roundings a step, which grow no more than the
 * weights do. L1: a difference of powers, each good to 2 u n^(1 - beta). Seen: 0.28
 * of the bound. */
//> weights
START_TEST(eq_13_1_weights_are_those_of_the_generating_function)
{
    double w[REF_COUNT];
    for (size_t i = 0; i < LEN(ref_weights); i++) {
        const fvi_delta kind = ref_weights[i].kind;
        const double beta = ref_weights[i].beta;
        weights(kind, beta, REF_COUNT, w);
        const double largest = larger(fabs(w[0]), fabs(w[1]));
        const double units = kind == FVI_DELTA_EULER       ? 1
                             : kind == FVI_DELTA_TRAPEZOID ? 3 * REF_COUNT
                             : kind == FVI_DELTA_BDF2
                                 ? 84
                                 : 40 * pow(REF_COUNT, 1 - beta);
        ck_assert_near(w[ref_weights[i].n], ref_weights[i].want,
                       units * U * largest, "kind %d beta=%g n=%zu", (int)kind,
                       beta, ref_weights[i].n);
    }
}
END_TEST
//< weights

/* Integer orders are finite differences, exactly. */
START_TEST(eq_13_2_integer_orders_of_bdf2_and_the_trapezoid)
{
    const double bdf2[3][6] = { { 1 },
                                { 1.5, -2, 0.5 },
                                { 2.25, -6, 5.5, -2, 0.25 } };
    const double trapezoid[3][6] = { { 1 },
                                     { 2, -4, 4, -4, 4, -4 },
                                     { 4, -16, 32, -48, 64, -80 } };
    double w[6], g[FVI_BDF2_TAPS];
    for (int beta = 0; beta <= 2; beta++) {
        weights(FVI_DELTA_BDF2, beta, 6, w);
        for (size_t n = 0; n < 6; n++)
            ck_assert_ulp(w[n], bdf2[beta][n], 0, "beta=%d n=%zu", beta, n);
        weights(FVI_DELTA_TRAPEZOID, beta, 6, w);
        for (size_t n = 0; n < 6; n++)
            ck_assert_ulp(w[n], trapezoid[beta][n], 0, "beta=%d n=%zu", beta,
                          n);
        ck_assert_uint_eq(fvi_cq_bdf2_factor(beta, g), (size_t)beta + 1);
    }
}
END_TEST

/* Retarded and advanced sums with any weights. */
static void back(size_t N, const double *w, const double *z, double *out)
{
    for (size_t k = 0; k <= N; k++) {
        out[k] = 0;
        for (size_t n = 0; n <= k; n++)
            out[k] += w[n] * z[k - n];
    }
}

static void ahead(size_t N, const double *w, const double *z, double *out)
{
    for (size_t k = 0; k <= N; k++) {
        out[k] = 0;
        for (size_t n = 0; n <= N - k; n++)
            out[k] += w[n] * z[k + n];
    }
}

static void small_integers(gsl_rng *random, size_t count, double *z)
{
    for (size_t k = 0; k < count; k++)
        z[k] = (double)gsl_rng_uniform_int(random, 199) - 99;
}

/* (13.3) with weights that are nothing but integers, no rounding at all; and the
 * advanced sum is the retarded one of the reversed sequence. */
//> parts
START_TEST(eq_13_3_any_weights_integrate_by_parts)
{
    enum { N = 40 };
    double w[N + 1], F[N + 1], G[N + 1], DF[N + 1], DG[N + 1], left = 0,
                                                               right = 0;
    gsl_rng *random = gsl_rng_alloc(gsl_rng_mt19937);
    small_integers(random, N + 1, w);
    small_integers(random, N + 1, F);
    small_integers(random, N + 1, G);
    gsl_rng_free(random);
    back(N, w, F, DF);
    ahead(N, w, G, DG);
    for (size_t k = 0; k <= N; k++) {
        left += G[k] * DF[k];
        right += DG[k] * F[k];
    }
    ck_assert_double_eq(left, right);
    double reversed[N + 1], DR[N + 1];
    for (size_t k = 0; k <= N; k++)
        reversed[k] = G[N - k];
    back(N, w, reversed, DR);
    for (size_t k = 0; k <= N; k++)
        ck_assert_double_eq(DG[k], DR[N - k]);
}
END_TEST
//< parts

/* (13.4). n + 1 products of weights with errors as above, and their sum. Seen: 0.25
 * of the bound. L1: w_0^2 = 4/pi, far from 1. */
//> semigroup
START_TEST(eq_13_4_orders_add_but_not_for_l1)
{
    enum { N = 64 };
    const double pairs[][2] = {
        { 0.5, 0.5 }, { 0.25, 0.25 }, { 0.1, 0.8 }, { 0.9, 0.9 }, { 1, 0.5 }
    };
    double a[N + 1], b[N + 1], sum[N + 1], product[N + 1];
    for (size_t i = 0; i < LEN(pairs); i++)
        for (int kind = FVI_DELTA_EULER; kind <= FVI_DELTA_TRAPEZOID;
             kind++) {
            weights((fvi_delta)kind, pairs[i][0], N + 1, a);
            weights((fvi_delta)kind, pairs[i][1], N + 1, b);
            weights((fvi_delta)kind, pairs[i][0] + pairs[i][1], N + 1,
                    sum);
            back(N, a, b, product);
            const size_t units =
                kind == FVI_DELTA_TRAPEZOID ? 3 * (N + 1) : 84;
            const double A = farthest(N + 1, a, NULL),
                         B = farthest(N + 1, b, NULL);
            for (size_t n = 0; n <= N; n++)
                ck_assert_near(product[n], sum[n],
                               (double)((2 * units + n) * (n + 1)) * U * A * B,
                               "kind %d, orders %g and %g, n=%zu", kind,
                               pairs[i][0], pairs[i][1], n);
        }
    weights(FVI_DELTA_L1, 0.5, N + 1, a);
    back(N, a, a, product);
    ck_assert_near(product[0], 4 / M_PI, 8 * U, "L1, w_0");
    ck_assert_double_gt(fabs(product[1] + 1), 0.05);
}
END_TEST
//< semigroup

/* H_{k+1} = ahead + dx, whatever the kind: a sum done in another order, where a
 * term is rounded once more. (k + 50) u sum |w_n| max|x| on either side.
 * Seen: 6.7e-16. */
START_TEST(eq_13_10_the_next_sum_is_known_but_for_the_next_increment)
{
    enum { N = 300, D = 3 };
    const double betas[] = { 0, 0.3, 1, 1.6, 2 };
    const fvi_history_kind kinds[] = { FVI_HISTORY_DIRECT,
                                      FVI_HISTORY_MODES };
    gsl_rng *random = gsl_rng_alloc(gsl_rng_mt19937);
    for (size_t i = 0; i < LEN(betas) * LEN(kinds); i++) {
        fvi_history *m;
        double x[D] = { 0 }, dx[D], H[D], next[D];
        ck_assert_int_eq(
            fvi_history_alloc(betas[i % 5], D, N, kinds[i / 5], 0, &m),
            FVI_SUCCESS);
        for (size_t k = 0; k <= N; k++) {
            ck_assert_int_eq(fvi_history_ahead(m, x, next), FVI_SUCCESS);
            for (size_t j = 0; j < D; j++) {
                dx[j] = gsl_rng_uniform(random) - x[j];
                x[j] += dx[j];
            }
            ck_assert_int_eq(fvi_history_push(m, x, dx, H), FVI_SUCCESS);
            for (size_t j = 0; j < D; j++)
                ck_assert_near(next[j] + dx[j], H[j], 8 * (N + 50) * U,
                               "beta=%g kind %zu k=%zu", betas[i % 5], i / 5,
                               k);
        }
        next[0] = 7;
        ck_assert_int_eq(fvi_history_ahead(m, x, next), FVI_EINVAL);
        ck_assert_int_eq(fvi_history_ahead(m, x, NULL), FVI_EFAULT);
        ck_assert_int_eq(fvi_history_ahead(m, NULL, next), FVI_EFAULT);
        ck_assert_int_eq(fvi_history_ahead(NULL, x, next), FVI_EFAULT);
        ck_assert_double_eq(next[0], 7);
        fvi_history_free(m);
    }
    gsl_rng_free(random);
}
END_TEST

/* ---- errors ---- */

START_TEST(bad_arguments_are_refused_and_nothing_is_touched)
{
    double w[] = { 7, 7, 7 };
    const fvi_delta E = FVI_DELTA_EULER, L = FVI_DELTA_L1,
                         none = (fvi_delta)4;
    ck_assert_int_eq(fvi_cq_weights(E, 0.5, 3, NULL), FVI_EFAULT);
    ck_assert_int_eq(fvi_cq_weights(E, 0.5, 0, w), FVI_EINVAL);
    ck_assert_int_eq(fvi_cq_weights(none, 0.5, 3, w), FVI_EINVAL);
    const double bad[] = { -0x1p-1074, 2 + 0x1p-51, GSL_NAN, GSL_POSINF };
    for (int kind = FVI_DELTA_EULER; kind <= FVI_DELTA_L1; kind++)
        for (size_t i = 0; i < LEN(bad); i++)
            ck_assert_int_eq(
                fvi_cq_weights((fvi_delta)kind, bad[i], 3, w),
                FVI_EDOM);
    ck_assert_int_eq(fvi_cq_weights(L, 1, 3, w), FVI_EDOM);
    for (size_t n = 0; n < 3; n++)
        ck_assert_double_eq(w[n], 7);
    weights(L, 1 - 0x1p-53, 1, w);
    ck_assert_double_eq(w[1], 7);
}
END_TEST

START_TEST(bad_symbols_are_refused)
{
    const double nan = GSL_NAN, inf = GSL_POSINF;
    const fvi_delta E = FVI_DELTA_EULER;
    const struct {
        fvi_delta kind;
        double theta, alpha, kappa, W, R;
        int status;
    } bad[] = {
        { FVI_DELTA_L1, 0, 0.5, 0.5, 1, 1, FVI_EINVAL },
        { (fvi_delta)9, 0, 0.5, 0.5, 1, 1, FVI_EINVAL },
        { E, -0.1, 0.5, 0.5, 1, 1, FVI_EDOM },
        { E, 1.1, 0.5, 0.5, 1, 1, FVI_EDOM },
        { E, nan, 0.5, 0.5, 1, 1, FVI_EDOM },
        { E, 0, -0.1, 0.5, 1, 1, FVI_EDOM },
        { E, 0, 1.1, 0.5, 1, 1, FVI_EDOM },
        { E, 0, nan, 0.5, 1, 1, FVI_EDOM },
        { E, 0, 0.5, -0.1, 1, 1, FVI_EDOM },
        { E, 0, 0.5, 1.1, 1, 1, FVI_EDOM },
        { E, 0, 0.5, 0.5, 0, 1, FVI_EDOM },
        { E, 0, 0.5, 0.5, inf, 1, FVI_EDOM },
        { E, 0, 0.5, 0.5, 1, 0, FVI_EDOM },
        { E, 0, 0.5, 0.5, 1, -1, FVI_EDOM },
        { E, 0, 0.5, 0.5, 1, nan, FVI_EDOM },
    };
    for (size_t i = 0; i < LEN(bad); i++) {
        double growth = 7, w[3] = { 1, 1, 1 }, x[3] = { 7, 7, 7 };
        ck_assert_int_eq(fvi_cq_amplification(bad[i].kind, bad[i].theta,
                                               bad[i].alpha, bad[i].kappa,
                                               bad[i].W, bad[i].R, &growth),
                         bad[i].status);
        ck_assert_double_eq(growth, 7);
        int status = fvi_cq_oscillator(w, bad[i].theta, bad[i].kappa,
                                               bad[i].W, bad[i].R, 2, x);
        if (bad[i].kind == E && bad[i].alpha == 0.5 && bad[i].W > 0
            && bad[i].R != 0) {
            ck_assert_int_eq(status, FVI_EDOM);
            ck_assert_double_eq(x[0], 7);
        }
    }
    double w = 1, x[2];
    ck_assert_int_eq(fvi_cq_amplification(E, 0, 0.5, 0.5, 1, 1, NULL),
                     FVI_EFAULT);
    ck_assert_int_eq(fvi_cq_oscillator(NULL, 0, 0.5, 1, 1, 1, x),
                     FVI_EFAULT);
    ck_assert_int_eq(fvi_cq_oscillator(&w, 0, 0.5, 1, 1, 1, NULL),
                     FVI_EFAULT);
    ck_assert_int_eq(fvi_cq_oscillator(&w, 0, 0.5, 1, 1, 0, x),
                     FVI_EINVAL);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("13 convolution quadrature");
    ADD_CASE(suite, "values",
             eq_13_1_weights_are_those_of_the_generating_function,
             eq_13_2_integer_orders_of_bdf2_and_the_trapezoid);
    ADD_CASE(suite, "identities", eq_13_3_any_weights_integrate_by_parts,
             eq_13_4_orders_add_but_not_for_l1,
             eq_13_10_the_next_sum_is_known_but_for_the_next_increment);
    ADD_CASE(suite, "errors", bad_arguments_are_refused_and_nothing_is_touched,
             bad_symbols_are_refused);
    return run_suite(suite);
}
