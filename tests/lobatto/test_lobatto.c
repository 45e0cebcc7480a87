/* tests/lobatto/test_lobatto.c -- H 17: the matrices W_n and the sums over them.
 * Run alone: make test-lobatto */
#include <fvi/error.h>
#include "harness/ulp.h"
#include "stages/lobatto_history.h"

#include "lobatto_ref.h"

#include <gsl/gsl_math.h>
#include <stdlib.h>

enum { N = 60 };

/* What the first four matrices may be off, in units of max|W_0|: see the first
 * test. */
#define NEAR (1000 * U)

static double W[(N + 1) * 16], V[(N + 1) * 16];

static void weights(size_t s, double beta, double *w)
{
    ck_assert_int_eq(fvi_lobatto_weights(s, beta, N + 1, w, NULL), FVI_SUCCESS);
}

static double largest(size_t n, const double *v)
{
    double max = 0;
    for (size_t i = 0; i < n; i++)
        max = larger(max, fabs(v[i]));
    return max;
}

/* ---- values ---- */

//> values
/* (17.5). The first four pass through 4 to 6 square roots and as many squares. Each
 * square doubles the relative error, 64 times in all, and each root leaves some ten
 * roundings: of the order of 1000 u; not a proof. Seen: 160 u. The rest are sums of
 * a hundred nodes without cancellation: 100 u. Seen: 13 u. Both of max|W_0|. */
START_TEST(eq_17_5_weights_match_cauchys_integral)
{
    for (size_t r = 0; r < LEN(ref_matrices); r++) {
        const size_t s = ref_matrices[r].s, n = ref_matrices[r].n;
        weights(s, ref_matrices[r].beta, W);
        const double bound =
            (n <= FVI_LAGS ? NEAR : 100 * U) * largest(s * s, W);
        for (size_t i = 0; i < s * s; i++) {
            const double got = W[n * s * s + i], want = ref_matrices[r].want[i];
            seen(fabs(got - want) / largest(s * s, W) / U,
                 n <= FVI_LAGS ? "u, first four" : "u, the rest");
            ck_assert_near(got, want, bound, "s=%zu beta=%g n=%zu entry %zu", s,
                           ref_matrices[r].beta, n, i);
        }
    }
}
END_TEST
//< values

/* ---- identities ---- */

static const double betas[] = { -0.99, -0.8, -0.5, -0.1, 1e-9,
                                0.2,   0.5,  0.8,  0.99 };

/* beta = 1, 0, -1: Delta itself, 1, and 1/Delta = A + z/(1-z) 1 b^T. Bound as
 * for the first four, |W_0| <= 12; beyond them 1 b^T to a few roundings, or zero.
 * Seen: 5e-15, 3 u. */
START_TEST(eq_17_5_whole_orders_are_local)
{
    for (size_t s = 2; s <= 4; s++) {
        const fvi_lobatto_rule *r = fvi_lobatto(s);
        for (int beta = -1; beta <= 1; beta++) {
            weights(s, beta, W);
            for (size_t e = 0; e < (N + 1) * s * s; e++) {
                const size_t n = e / s / s, i = e / s % s, j = e % s;
                double want = n == 0 && i == j;
                if (beta == 1)
                    want = n == 0   ? r->D[i][j] + (i + j == 0) / r->b[0]
                           : n == 1 ? -(i == 0 && j == s - 1) / r->b[0]
                                    : 0;
                if (beta == -1 && n > 0)
                    want = r->b[j];
                else if (beta == -1 && i + 1 == s)
                    want = r->b[j]; /* the last row of A */
                else if (beta == -1)
                    continue;
                ck_assert_near(W[e], want, n <= FVI_LAGS ? 12 * NEAR : 4 * U,
                               "s=%zu beta=%d n=%zu", s, beta, n);
            }
        }
    }
}
END_TEST

/* The sum over n of W_n^(p) W_{k-n}^(q). */
static void product(size_t s, size_t k, const double *p, const double *q,
                    double *out)
{
    for (size_t e = 0; e < s * s; e++) {
        out[e] = 0;
        for (size_t n = 0; n <= k; n++)
            for (size_t l = 0; l < s; l++)
                out[e] += p[n * s * s + e / s * s + l]
                          * q[(k - n) * s * s + l * s + e % s];
    }
}

//> semigroup
/* W^(a) * W^(a) = W^(2a), also with negative orders, where W^(a) * W^(-a) = 1.
 * The bound of the first four, times the other factor; that of the rest and of the
 * sum of 60 products is smaller. Seen: 0.05 of the bound. */
START_TEST(eq_17_5_orders_add)
{
    static double sum[(N + 1) * 16];
    for (size_t s = 2; s <= 4; s++)
        for (size_t t = 0; t < 5; t++) {
            const double p[] = { 0.25, 0.45, -0.4, 0.6, -0.3 },
                         q[] = { 0.25, 0.45, -0.4, -0.6, 0.8 };
            weights(s, p[t], W);
            weights(s, q[t], V);
            weights(s, p[t] + q[t], sum);
            double sizes = 0;
            for (size_t i = 0; i < (N + 1) * s * s; i++)
                sizes += fabs(W[i]);
            for (size_t k = 0; k <= N; k++) {
                double got[16];
                product(s, k, W, V, got);
                for (size_t i = 0; i < s * s; i++)
                    ck_assert_near(got[i], sum[k * s * s + i],
                                   NEAR * sizes * largest(s * s, V),
                                   "s=%zu orders %g %g k=%zu", s, p[t], q[t],
                                   k);
            }
        }
}
END_TEST
//< semigroup

//> reversal
/* P W_n P = B^(-1) W_n^T B, and with it the integration by parts of two sequences
 * of random stages below 1/2: four lags of N s terms, 1/4 each. Seen: 0.09 of the
 * bounds. */
START_TEST(eq_17_6_reversal_transposes_and_sums_by_parts)
{
    srand(17);
    for (size_t s = 2; s <= 4; s++)
        for (size_t t = 0; t < LEN(betas); t++) {
            const double *b = fvi_lobatto(s)->b;
            double f[N * 4], g[N * 4], left = 0, right = 0;
            weights(s, betas[t], W);
            const double unit = NEAR * largest(s * s, W);
            for (size_t i = 0; i < N * s; i++) {
                f[i] = rand() / (double)RAND_MAX - 0.5;
                g[i] = rand() / (double)RAND_MAX - 0.5;
            }
            for (size_t n = 0; n < N; n++)
                for (size_t i = 0; i < s; i++)
                    for (size_t j = 0; j < s; j++) {
                        const double *w = W + n * s * s,
                                     back = w[(s - 1 - i) * s + s - 1 - j];
                        ck_assert_near(back, w[j * s + i] * b[j] / b[i], unit,
                                       "s=%zu beta=%g n=%zu", s, betas[t], n);
                        for (size_t k = n; k < N; k++) {
                            left += b[i] * f[k * s + i] * w[i * s + j]
                                    * g[(k - n) * s + j];
                            right +=
                                b[i] * back * f[k * s + j] * g[(k - n) * s + i];
                        }
                    }
            ck_assert_near(left, right, unit * N * (double)s, "s=%zu beta=%g",
                           s, betas[t]);
        }
}
END_TEST
//< reversal

/* h rho sum v^T B Y for random v, step by step. (17.11) says that it is not
 * negative; the weights are off by NEAR. Seen: never below zero. */
START_TEST(eq_17_11_the_damping_only_takes)
{
    srand(11);
    for (size_t s = 2; s <= 4; s++)
        for (size_t t = 0; t < LEN(betas); t++)
            for (int kind = FVI_HISTORY_DIRECT; kind <= FVI_HISTORY_MODES;
                 kind += FVI_HISTORY_MODES - FVI_HISTORY_DIRECT) {
                fvi_lobatto_history *m;
                ck_assert_int_eq(fvi_lobatto_history_alloc(s, betas[t], 1, N,
                                                          (fvi_history_kind)kind, 0,
                                                          0, &m),
                                 FVI_SUCCESS);
                const double *w = fvi_lobatto_history_w0(m),
                             *b = fvi_lobatto(s)->b;
                double work = 0, H[4] = { 0 }, v[4], scale = 0;
                for (size_t k = 0; k < N; k++) {
                    for (size_t i = 0; i < s; i++)
                        v[i] = rand() / (double)RAND_MAX - 0.5
                               + (k % 2 ? 0.4 : -0.4); /* the harder */
                    for (size_t i = 0; i < s; i++) {
                        double Y = H[i];
                        for (size_t j = 0; j < s; j++)
                            Y += w[i * s + j] * v[j];
                        work += b[i] * v[i] * Y;
                        scale += fabs(Y);
                    }
                    ck_assert_double_ge(work, -NEAR * scale);
                    ck_assert_int_eq(fvi_lobatto_history_push(m, v, H, NULL),
                                     FVI_SUCCESS);
                }
                fvi_lobatto_history_free(m);
            }
}
END_TEST

//> fast
/* (17.12) against (17.9), three coordinates at once, stages all in [1/2, 1], so
 * that nothing cancels. The k terms of s products round to at most 4 k s^2 u of the
 * sum of |W|, which is below max(1, k^(-beta)); the nodes leave the tolerance.
 * Seen: 0.14 of the bound. */
START_TEST(eq_17_12_modes_equal_the_direct_sum)
{
    enum { MANY = 800, D = 3 };
    const double tolerances[] = { 1e-3, 1e-6, 1e-10, 1e-13, 1e-14, 0 };
    srand(12);
    for (size_t s = 2; s <= 4; s++)
        for (size_t t = 0; t < LEN(betas); t++) {
            fvi_lobatto_history *direct, *fast[LEN(tolerances)];
            ck_assert_int_eq(fvi_lobatto_history_alloc(s, betas[t], D, MANY,
                                                      FVI_HISTORY_DIRECT, 0, 0,
                                                      &direct),
                             FVI_SUCCESS);
            for (size_t e = 0; e < LEN(tolerances); e++)
                ck_assert_int_eq(
                    fvi_lobatto_history_alloc(s, betas[t], D, MANY,
                                             FVI_HISTORY_MODES, 0,
                                             tolerances[e], &fast[e]),
                    FVI_SUCCESS);
            seen((double)fvi_lobatto_few_nodes(s, betas[t], MANY, 1e-13, NULL,
                                               NULL, NULL, 0),
                 "nodes");
            double v[4 * D], H[4 * D], G[4 * D];
            for (size_t k = 0; k < MANY; k++) {
                for (size_t i = 0; i < s * D; i++)
                    v[i] = 0.5 + 0.5 * rand() / (double)RAND_MAX;
                fvi_lobatto_history_push(direct, v, H, NULL);
                const double size = larger(1, pow((double)k + 1, -betas[t]));
                for (size_t e = 0; e < LEN(tolerances); e++) {
                    const double keep =
                        tolerances[e] > 0 ? tolerances[e] : 1e-13;
                    fvi_lobatto_history_push(fast[e], v, G, NULL);
                    for (size_t i = 0; i < s * D; i++)
                        ck_assert_near(G[i], H[i],
                                       keep * size
                                           + 4 * (double)((k + 1) * s * s) * U
                                                 * size,
                                       "s=%zu beta=%g k=%zu tolerance %g", s,
                                       betas[t], k, keep);
                }
            }
            fvi_lobatto_history_free(direct);
            for (size_t e = 0; e < LEN(tolerances); e++)
                fvi_lobatto_history_free(fast[e]);
        }
}
END_TEST
//< fast

/* Nodes with all that belongs to them; and sum_j q_j r_j^(n-1) a_j(row) a_j(column). */
enum { MOST = 512 };
typedef struct {
    size_t Q;
    double q[MOST], p[MOST], a[FVI_STAGES * MOST];
} nodes;

static double sum_of(const nodes *m, double n, size_t row, size_t column)
{
    double sum = 0;
    for (size_t j = 0; j < m->Q; j++) {
        const double power = m->p[j] < 0.5 ? exp((n - 1) * log1p(-m->p[j])) : pow(1 - m->p[j], n - 1);
        sum += m->q[j] * power * m->a[row * MOST + j] * m->a[column * MOST + j];
    }
    return sum;
}

/* A run's few nodes against the nodes of the weights, whose tolerance is 1e-16. Entries of a are at most 1/b_1 at
 * mu = 0, and those of W_0 are of the size b_1^-beta, so the sums may differ by the tolerance of that over b_1; and by
 * roundings of up to 300 terms. Seen: 0.2 of it. Nodes that hardly decay are seen where beta is near -1. */
START_TEST(eq_17_12_few_nodes_are_the_sums_of_all)
{
    static nodes all, few;
    const double lengths[] = { 64, 1000, 1e6 }, tolerances[] = { 1e-3, 1e-8, 1e-13, 1e-14 };
    for (size_t s = 2; s <= FVI_STAGES; s++)
        for (size_t t = 0; t < LEN(betas); t++)
            for (size_t l = 0; l < LEN(lengths); l++) {
                const double at[] = { 4, 20, floor(lengths[l] / 3), lengths[l] };
                all.Q = fvi_lobatto_nodes(s, betas[t], lengths[l], 1e-16, 0, all.q, NULL, all.p, all.a, MOST);
                double W0[FVI_STAGES * FVI_STAGES];
                ck_assert_int_eq(fvi_lobatto_weights(s, betas[t], 1, W0, NULL), FVI_SUCCESS);
                for (size_t e = 0; e < LEN(tolerances); e++) {
                    few.Q = fvi_lobatto_few_nodes(s, betas[t], lengths[l], tolerances[e], NULL, NULL, NULL, 0);
                    ck_assert_uint_eq(few.Q, fvi_lobatto_few_nodes(s, betas[t], lengths[l], tolerances[e], few.q,
                                                                   few.p, few.a, MOST));
                    ck_assert_uint_lt(few.Q, tolerances[e] < 1e-10 ? 2 * all.Q / 3 : all.Q);
                    for (size_t i = 0; i < LEN(at); i++) {
                        const double want = sum_of(&all, at[i], 0, s - 1), got = sum_of(&few, at[i], 0, s - 1);
                        const double bound = (tolerances[e] + 300 * U) * largest(s * s, W0);
                        seen(fabs(got - want) / bound, "of the bound");
                        ck_assert_near(got, want, bound, "s=%zu beta=%g N=%g n=%g tolerance %g", s, betas[t],
                                       lengths[l], at[i], tolerances[e]);
                    }
                }
            }
}
END_TEST

/* ---- errors ---- */

START_TEST(bad_stages_are_refused)
{
    double w[] = { 7 };
    ck_assert_int_eq(fvi_lobatto_weights(3, 0.5, 1, NULL, NULL), FVI_EFAULT);
    ck_assert_int_eq(fvi_lobatto_weights(1, 0.5, 1, w, NULL), FVI_EINVAL);
    ck_assert_int_eq(fvi_lobatto_weights(9, 0.5, 1, w, NULL), FVI_EINVAL);
    ck_assert_int_eq(fvi_lobatto_weights(3, 0.5, 0, w, NULL), FVI_EINVAL);
    ck_assert_int_eq(fvi_lobatto_weights(3, 0.5, SIZE_MAX, w, NULL), FVI_EINVAL);
    ck_assert_int_eq(fvi_lobatto_weights(3, 1.01, 1, w, NULL), FVI_EDOM);
    ck_assert_int_eq(fvi_lobatto_weights(3, -1.01, 1, w, NULL), FVI_EDOM);
    ck_assert_int_eq(fvi_lobatto_weights(3, GSL_NAN, 1, w, NULL), FVI_EDOM);
    ck_assert_double_eq(w[0], 7);
    ck_assert_ptr_null(fvi_lobatto(1));
    ck_assert_ptr_null(fvi_lobatto(9));

    fvi_lobatto_history *m = (fvi_lobatto_history *)w;
    const fvi_history_kind direct = FVI_HISTORY_DIRECT,
                          fast = FVI_HISTORY_MODES;
#define REFUSED(s, beta, d, steps, kind, tolerance, code)                      \
    ck_assert_int_eq(                                                          \
        fvi_lobatto_history_alloc(s, beta, d, steps, kind, 0, tolerance, &m),      \
        code);                                                                 \
    ck_assert_ptr_eq(m, w);
    REFUSED(1, 0.5, 1, 9, direct, 0, FVI_EINVAL)
    REFUSED(3, 0.5, 0, 9, direct, 0, FVI_EINVAL)
    REFUSED(3, 0.5, SIZE_MAX, 9, fast, 0, FVI_EINVAL)
    REFUSED(3, 0.5, 1, SIZE_MAX, direct, 0, FVI_EINVAL)
    REFUSED(3, 0.5, 1, 9, (fvi_history_kind)99, 0, FVI_EINVAL)
    REFUSED(3, 1.5, 1, 9, direct, 0, FVI_EDOM)
    REFUSED(3, GSL_NAN, 1, 9, direct, 0, FVI_EDOM)
    REFUSED(3, 0.5, 1, 9, direct, 1, FVI_EDOM)
    REFUSED(3, 0.5, 1, 9, direct, GSL_NAN, FVI_EDOM)
    REFUSED(3, 0.5, 1, 9, fast, 1e-15, FVI_ETOL)
    REFUSED(3, 0.5, 1, 65, FVI_HISTORY_AUTO, 1e-15, FVI_ETOL)
    REFUSED(3, 0.5, 1, (size_t)1 << 50, direct, 0, FVI_ENOMEM)
#undef REFUSED
    ck_assert_int_eq(fvi_lobatto_history_alloc(3, 0.5, 1, 9, direct, 0, 0, NULL),
                     FVI_EFAULT);
    ck_assert_int_eq(fvi_lobatto_history_alloc(2, 0.5, 1, 2, fast, 0, 0, &m),
                     FVI_SUCCESS);
    double v[] = { 1, 1 }, H[] = { 7, 7 };
    ck_assert_int_eq(fvi_lobatto_history_push(NULL, v, H, NULL), FVI_EFAULT);
    ck_assert_int_eq(fvi_lobatto_history_push(m, NULL, H, NULL), FVI_EFAULT);
    ck_assert_int_eq(fvi_lobatto_history_push(m, v, NULL, NULL), FVI_EFAULT);
    ck_assert_double_eq(H[0], 7);
    ck_assert_int_eq(fvi_lobatto_history_push(m, v, H, NULL), FVI_SUCCESS);
    ck_assert_int_eq(fvi_lobatto_history_push(m, v, v, NULL), FVI_SUCCESS);
    H[0] = 7;
    ck_assert_int_eq(fvi_lobatto_history_push(m, v, H, NULL), FVI_EINVAL);
    ck_assert_double_eq(H[0], 7);
    fvi_lobatto_history_free(m);
    fvi_lobatto_history_free(NULL);
    ck_assert_int_eq(/* summed directly, so nothing is left out */
                     fvi_lobatto_history_alloc(3, 0.5, 1, 64, FVI_HISTORY_AUTO, 0,
                                              1e-15, &m),
                     FVI_SUCCESS);
    fvi_lobatto_history_free(m);
    for (int beta = -1; beta <= 0; beta++) { /* no history, whatever the kind */
        ck_assert_int_eq(
            fvi_lobatto_history_alloc(3, beta, 1, SIZE_MAX, direct, 0, 0, &m),
            FVI_SUCCESS);
        fvi_lobatto_history_free(m);
        ck_assert_int_eq(
            fvi_lobatto_history_alloc(3, beta, 1, 9, fast, 0, 1e-15, &m),
            FVI_SUCCESS);
        fvi_lobatto_history_free(m);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("lobatto");
    ADD_CASE(suite, "values", eq_17_5_weights_match_cauchys_integral);
    ADD_CASE(suite, "identities", eq_17_5_whole_orders_are_local,
             eq_17_5_orders_add, eq_17_6_reversal_transposes_and_sums_by_parts,
             eq_17_11_the_damping_only_takes,
             eq_17_12_modes_equal_the_direct_sum, eq_17_12_few_nodes_are_the_sums_of_all);
    ADD_CASE(suite, "errors", bad_stages_are_refused);
    return run_suite(suite);
}
