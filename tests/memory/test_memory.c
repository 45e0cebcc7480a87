/* tests/memory/test_memory.c -- H 12: the memories.
 * Run alone: make test-memory */
#include <fvi/coefficients.h>
#include <fvi/error.h>
#include <fvi/memory.h>
#include "harness/ulp.h"
#include "memory/history_tiled.h"
#include "memory/history_kinds.h"

#include "memory_ref.h"

#include <gsl/gsl_math.h>
#include <gsl/gsl_rng.h>
#include <stdlib.h>

static const fvi_history_kind kinds[] = { FVI_HISTORY_DIRECT,
                                         FVI_HISTORY_MODES };

static fvi_history *memory_of(double beta, size_t d, size_t steps,
                             fvi_history_kind kind, double tolerance)
{
    fvi_history *m = NULL;
    ck_assert_int_eq(fvi_history_alloc(beta, d, steps, kind, tolerance, &m),
                     FVI_SUCCESS);
    return m;
}

/* H_0 ... H_{count-1} of one sequence; steps may be more than count - 1. */
static void sums(double beta, size_t steps, fvi_history_kind kind,
                 double tolerance, size_t count, const double *x, double *H)
{
    fvi_history *m = memory_of(beta, 1, steps, kind, tolerance);
    for (size_t k = 0; k < count; k++) {
        double dx = k ? x[k] - x[k - 1] : x[0];
        if (fvi_history_push(m, x + k, &dx, H + k))
            ck_abort_msg("term %zu was refused", k);
    }
    fvi_history_free(m);
}

static void fill_random(size_t count, double *x)
{
    gsl_rng *rng = gsl_rng_alloc(gsl_rng_mt19937);
    for (size_t k = 0; k < count; k++)
        x[k] = 2 * gsl_rng_uniform(rng) - 1;
    gsl_rng_free(rng);
}

/* ---- values ---- */

/* (12.1), (12.2). Integers and orders 1/2 and 3/2: every product and every sum
 * is a double, so 0 ulp in whatever order the sum is done. 24 terms are within
 * the window. Seen: 0. */
START_TEST(eq_12_1_small_integers_are_summed_exactly)
{
    double H[LEN(ref_terms)];
    for (size_t i = 0; i < LEN(kinds); i++) {
        sums(0.5, 100, kinds[i], 0, LEN(H), ref_terms, H);
        for (size_t k = 0; k < LEN(H); k++)
            ck_assert_ulp(H[k], ref_sums_half[k], 0, "kind %zu k=%zu", i, k);
        sums(1.5, 100, kinds[i], 0, LEN(H), ref_terms, H);
        for (size_t k = 0; k < LEN(H); k++)
            ck_assert_ulp(H[k], ref_sums_three_halves[k], 0, "kind %zu k=%zu",
                          i, k);
    }
}
END_TEST

/* beta = 0, 1, 2: x_k, x_k - x_{k-1}, and the difference of those; no rounding
 * but that of the differences. No history is kept: 100 bytes do. */
START_TEST(eq_12_1_integer_orders_need_no_memory)
{
    const double x[] = { 3, -1, 4, 1, -5, 9, 2, 6 };
    double H[LEN(x)];
    for (size_t i = 0; i < LEN(kinds); i++)
        for (int beta = 0; beta <= 2; beta++) {
            sums(beta, 1000000, kinds[i], 0, LEN(x), x, H);
            for (size_t k = 0; k < LEN(x); k++) {
                double x1 = k > 0 ? x[k - 1] : 0, x2 = k > 1 ? x[k - 2] : 0;
                double want[] = { x[k], x[k] - x1, x[k] - 2 * x1 + x2 };
                ck_assert_ulp(H[k], want[beta], 0, "beta=%d k=%zu", beta, k);
            }
            const size_t bytes =
                fvi_history_bytes(beta, 1, 1000000, kinds[i], 0);
            ck_assert_uint_le(bytes, 256);
            /* the last term of each coordinate, in pieces of 64 bytes */
            for (size_t d = 1; d < 100; d++)
                ck_assert_uint_eq(fvi_history_bytes(beta, d, 1000000, kinds[i], 0),
                                  bytes + (d - 1) / 8 * 64);
        }
}
END_TEST

/* (12.6) against the exact weights, to n = 10^8: relative error delta, plus the
 * rounding. With E = t - exp(-t), |E| < 26 where a node matters, exp(E) is off
 * by 26 u, which moves a node and its coefficient along together: (1 + nu) 26 u
 * on the average over the terms of the sum, which are of one sign, and as much
 * again from n s in the exponential here: 104 u. Pow, expm1, products: 16 u.
 * Seen: 0.08 delta at delta = 0.01, 0.07 at 1e-6; 7e-16 + 0.07 delta below. */
START_TEST(eq_12_6_every_weight_of_the_tail_is_within_delta)
{
    double s[200], c[200];
    const double deltas[] = { 1e-2, 1e-6, 1e-10, 1e-14, 1e-15 };
    const double longest[] = { 128, 1e4, 1e6, 1e8, FVI_LONGEST };
    for (size_t i = 0; i < LEN(ref_tail); i++)
        for (size_t j = 0; j < LEN(deltas) * LEN(longest); j++) {
            double delta = deltas[j % LEN(deltas)];
            double N = longest[j / LEN(deltas)], n = (double)ref_tail[i].n;
            if (n > N)
                continue;
            size_t Q = fvi_history_modes_nodes(ref_tail[i].nu, N, delta, s, c, NULL);
            double sum = 0;
            for (size_t q = 0; q < Q; q++)
                sum += c[q] * exp(-n * s[q]);
            ck_assert_near(sum / ref_tail[i].want, 1, delta + 120 * U,
                           "nu=%.10g n=%g N=%g delta=%g", ref_tail[i].nu, n, N,
                           delta);
        }
}
END_TEST

/* (12.12): the module's answer to a single 1 is its weights. The window has the
 * exact ones. In the tail a mode is z - fl(p z), rounded: a relative error of
 * (1 + p) u a step, and all modes have one sign; n u + 120 u in all, and 20 u
 * for the sum over the modes. So (12.6) with delta + (n + 140) u, and summed
 * over n the bound (12.11). Seen: 0.011 n u for n > 1000; of the sum 1 %.
 * We demand a tenth of n u: that roundings go both ways is no theorem, but with
 * p = 1 - exp(-s) the modes themselves are wrong, by n u / 2 and one way. */
//> impulse
START_TEST(eq_12_11_the_errors_of_all_weights_add_up_to_delta_at_most)
{
    enum { N = 100000 };
    double *x = calloc(3 * (N + 1), sizeof *x);
    ck_assert_ptr_nonnull(x);
    double *H = x + N + 1, *w = H + N + 1;
    x[0] = 1;
    for (size_t i = 0; i < LEN(ref_rest); i++) {
        const double nu = ref_rest[i].nu, delta = 1e-14;
        double lost = 0, rounding = 0;
        fvi_gl_weights(nu, N + 1, w);
        sums(nu, N, FVI_HISTORY_MODES, 10 * delta, N + 1, x, H);
        for (size_t n = 0; n <= N; n++) {
            double bound = n < FVI_TAIL ? 0 : (0.1 * (double)n + 140) * U;
            double error = fabs(H[n] - w[n]);
            if (error > (n < FVI_TAIL ? 0 : delta + bound) * fabs(w[n]))
                ck_abort_msg("nu=%.10g n=%zu: off by %g", nu, n, error);
            lost += error;
            rounding += bound * fabs(w[n]);
        }
        ck_assert_near(lost, 0, delta * ref_rest[i].want + rounding,
                       "nu=%.10g, the sum", nu);
    }
    free(x);
}
END_TEST
//< impulse

/* ---- identities ---- */

/* d coordinates share the nodes and nothing else: bit for bit what d memories
 * of dimension one give, whatever the kind. (Many coordinates of exponentials go
 * another way: the tests of H 28.) */
static void ck_assert_many_memories(size_t D, size_t N)
{
    const double betas[] = { 0.3, 1, 1.7 };
    static double x[7000], all[7000], one[700], H1[700], H[100], dx[100];
    fill_random(N * D, x);
    for (size_t b = 0; b < LEN(betas) * LEN(kinds); b++) {
        double beta = betas[b % 3];
        if (kinds[b / 3] == FVI_HISTORY_MODES && D >= FVI_TILES_FROM)
            continue;
        fvi_history *m = memory_of(beta, D, N, kinds[b / 3], 0);
        for (size_t k = 0; k < N; k++) {
            for (size_t i = 0; i < D; i++)
                dx[i] = x[k * D + i] - (k ? x[(k - 1) * D + i] : 0);
            fvi_history_push(m, x + k * D, dx, H);
            memcpy(all + k * D, H, D * sizeof *H);
        }
        fvi_history_free(m);
        for (size_t i = 0; i < D; i++) {
            for (size_t k = 0; k < N; k++)
                one[k] = x[k * D + i];
            sums(beta, N, kinds[b / 3], 0, N, one, H1);
            for (size_t k = 0; k < N; k++)
                ck_assert_ulp(all[k * D + i], H1[k], 0, "beta=%g i=%zu k=%zu",
                              beta, i, k);
        }
    }
}

START_TEST(eq_12_1_many_coordinates_are_many_memories)
{
    ck_assert_many_memories(5, 700);
    ck_assert_many_memories(FVI_TILES_FROM - 1, 300);
    ck_assert_many_memories(100, 70); /* more of them than terms */
}
END_TEST

/* The result may be written over the input. */
START_TEST(eq_12_1_the_sum_may_replace_the_term)
{
    double x[300], H[300];
    fill_random(LEN(x), x);
    for (size_t i = 0; i < LEN(kinds); i++) {
        sums(0.6, 299, kinds[i], 0, 300, x, H);
        fvi_history *m = memory_of(0.6, 1, 299, kinds[i], 0);
        for (size_t k = 0; k < 300; k++) {
            double z = x[k];
            ck_assert_int_eq(fvi_history_push(m, &z, &z, &z), FVI_SUCCESS);
            ck_assert_ulp(z, H[k], 0, "kind %zu k=%zu", i, k);
        }
        fvi_history_free(m);
    }
}
END_TEST

/* (12.1) as it stands, in long double: sum |w_n| <= 2, each weight and each product is
 * rounded once, and each of eight lanes adds N/8 terms. Seen: 0.08 of that. */
START_TEST(eq_12_1_the_direct_sum_is_the_definition)
{
    const size_t lengths[] = { 1, 7, 8, 9, 63, 640, 1000 };
    const double betas[] = { 0.02, 0.5, 0.98, 1.02, 1.5, 1.98 };
    double x[1001], H[1001], w[1001];
    fill_random(LEN(x), x);
    for (size_t i = 0; i < LEN(lengths) * LEN(betas); i++) {
        const size_t N = lengths[i / LEN(betas)];
        const double beta = betas[i % LEN(betas)];
        const int increments = beta >= 1;
        const double bound = 2 * ((double)N / 8 + 12) * (increments ? 2 : 1);
        fvi_gl_weights(beta - increments, N + 1, w);
        sums(beta, N, FVI_HISTORY_DIRECT, 0, N + 1, x, H);
        for (size_t k = 0; k <= N; k++) {
            long double want = 0;
            for (size_t j = 0; j <= k; j++) {
                const double before = increments && j > 0 ? x[j - 1] : 0;
                want += (long double)w[k - j] * (x[j] - before);
            }
            ck_assert_near(H[k], (double)want, bound * U, "beta=%g N=%zu k=%zu",
                           beta, N, k);
        }
    }
}
END_TEST

/* What the proof of (12.13) asks of the weights in use: those after the first are
 * negative, and their moduli a_n fall and are convex, across the joint at 33 too;
 * the line through the last two, continued to zero, ends before they have used up
 * W_N. For any tolerance. a_n are the answers to an impulse, W_N is that to x = 1,
 * 1, 1, ...; a second difference of a_n is off by 4 roundings of a sum of Q + 32
 * terms of one sign, about 8 u a_n. Seen: never below 0; the line ends at 0.25 W_N. */
//> dissipation
START_TEST(eq_12_13_the_weights_fall_and_are_convex)
{
    enum { MOST = 100000 };
    static double x[MOST + 1], a[MOST + 1], s[200], c[200];
    const double tolerances[] = { 0.99, 1e-2, 1e-6, 1e-13 };
    const size_t ends[] = { 64, 1000, MOST };
    for (size_t i = 0; i < LEN(ref_rest) * LEN(tolerances) * LEN(ends); i++) {
        const double nu = ref_rest[i / 12].nu,
                     tolerance = tolerances[i / 3 % 4];
        const size_t N = ends[i % 3];
        const double delta = fvi_history_modes_delta(N, tolerance);
        ck_assert(delta > 0 && delta * (double)N <= 16); /* (12.11) */
        ck_assert(delta <= tolerance / 10 && delta <= 1. / 2000);
        size_t Q = fvi_history_modes_nodes(nu, (double)N, delta, s, c, NULL);
        for (size_t q = 0; q < Q; q++)
            ck_assert(c[q] < 0 && s[q] > 0 && (q == 0 || s[q] > s[q - 1]));
        for (size_t k = 0; k <= N; k++)
            x[k] = 1;
        sums(nu, N, FVI_HISTORY_MODES, tolerance, N + 1, x, a);
        const double W = a[N];
        for (size_t k = 1; k <= N; k++)
            x[k] = 0;
        sums(nu, N, FVI_HISTORY_MODES, tolerance, N + 1, x, a);
        double bend = 1, slope = 1;
        for (size_t n = 1; n < N; n++) {
            slope = smaller(slope, (a[n + 1] - a[n]) / -a[n]);
            if (n > 1)
                bend = smaller(bend, (2 * a[n] - a[n - 1] - a[n + 1]) / -a[n]);
        }
        const double line = a[N] * a[N] / (a[N] - a[N - 1]) / 2 / W;
        seen(line, "of W_N");
        ck_assert_msg(a[N] < 0 && slope > 0 && bend > -8 * U && line < 1,
                      "nu=%.10g tolerance=%g N=%zu: %g, %g u, %g", nu,
                      tolerance, N, slope, bend / U, line);
    }
}
END_TEST
//< dissipation

/* ---- errors ---- */

//> errors
START_TEST(bad_memories_are_refused_and_nothing_is_touched)
{
    const struct {
        double beta;
        size_t d, steps;
        fvi_history_kind kind;
        double tolerance;
        int code;
    } bad[] = {
        { 0.5, 0, 9, FVI_HISTORY_AUTO, 0, FVI_EINVAL },
        { 0.5, SIZE_MAX / 8, 9, FVI_HISTORY_AUTO, 0, FVI_EINVAL },
        { 0.5, SIZE_MAX / 999, 9, FVI_HISTORY_MODES, 0, FVI_EINVAL },
        { 0.5, 1, 9, (fvi_history_kind)3, 0, FVI_EINVAL },
        { 0.5, 1, SIZE_MAX, FVI_HISTORY_DIRECT, 0, FVI_EINVAL },
        { 0.5, 8, SIZE_MAX / 64, FVI_HISTORY_DIRECT, 0, FVI_EINVAL },
        { 0.5, 1, 1000000001, FVI_HISTORY_MODES, 0, FVI_EINVAL },
        { 0.5, 1, 1000000001, FVI_HISTORY_AUTO, 0, FVI_EINVAL },
        { -0x1p-1074, 1, 9, FVI_HISTORY_AUTO, 0, FVI_EDOM },
        { 2 + 0x1p-51, 1, 9, FVI_HISTORY_AUTO, 0, FVI_EDOM },
        { GSL_NAN, 1, 9, FVI_HISTORY_AUTO, 0, FVI_EDOM },
        { 0.5, 1, 9, FVI_HISTORY_DIRECT, 1, FVI_EDOM },
        { 0.5, 1, 9, FVI_HISTORY_DIRECT, -1e-13, FVI_EDOM },
        { 0.5, 1, 9, FVI_HISTORY_DIRECT, GSL_NAN, FVI_EDOM },
        { 0.5, 1, 9, FVI_HISTORY_MODES, 0.99e-14, FVI_ETOL },
        { 0.5, 1, 1000, FVI_HISTORY_AUTO, 0.99e-14, FVI_ETOL },
        { 0.5, 1, (size_t)1 << 50, FVI_HISTORY_DIRECT, 0, FVI_ENOMEM },
        { 0.5, (size_t)1 << 45, 9, FVI_HISTORY_DIRECT, 0, FVI_ENOMEM },
        { 0.5, (size_t)1 << 45, 9, FVI_HISTORY_MODES, 0, FVI_ENOMEM },
        { 1, (size_t)1 << 50, 9, FVI_HISTORY_AUTO, 0, FVI_ENOMEM },
    };
    fvi_history *const sentinel = (fvi_history *)&kinds, *m = sentinel;
    for (size_t i = 0; i < LEN(bad); i++) {
        size_t bytes = fvi_history_bytes(bad[i].beta, bad[i].d, bad[i].steps,
                                        bad[i].kind, bad[i].tolerance);
        ck_assert_msg((bytes == 0) == (bad[i].code != FVI_ENOMEM), "row %zu",
                      i);
        int code = fvi_history_alloc(bad[i].beta, bad[i].d, bad[i].steps,
                                    bad[i].kind, bad[i].tolerance, &m);
        ck_assert_msg(code == bad[i].code && m == sentinel, "row %zu: %d", i,
                      code);
    }
    ck_assert_int_eq(fvi_history_alloc(0.5, 1, 9, FVI_HISTORY_AUTO, 0, NULL),
                     FVI_EFAULT);
    fvi_history_free(NULL);
}
END_TEST
//< errors

/* steps + 1 terms and no more; tolerances and steps at the edge are taken. */
START_TEST(more_terms_than_announced_are_refused)
{
    double x = 1, H;
    for (size_t i = 0; i < LEN(kinds); i++)
        for (double beta = 0.5; beta <= 1; beta += 0.5) {
            fvi_history *m = memory_of(beta, 1, 2, kinds[i], 1e-14);
            ck_assert_int_eq(fvi_history_push(NULL, &x, &x, &H), FVI_EFAULT);
            ck_assert_int_eq(fvi_history_push(m, NULL, &x, &H), FVI_EFAULT);
            ck_assert_int_eq(fvi_history_push(m, &x, NULL, &H), FVI_EFAULT);
            ck_assert_int_eq(fvi_history_push(m, &x, &x, NULL), FVI_EFAULT);
            for (int k = 0; k < 3; k++)
                ck_assert_int_eq(fvi_history_push(m, &x, &x, &H), FVI_SUCCESS);
            H = 77;
            ck_assert_int_eq(fvi_history_push(m, &x, &x, &H), FVI_EINVAL);
            ck_assert(H == 77);
            fvi_history_free(m);
        }
    fvi_history_free(memory_of(1.5, 1, FVI_LONGEST, FVI_HISTORY_MODES, 0));
    fvi_history_free(memory_of(0x1p-1070, 1, 9, FVI_HISTORY_MODES, 0));
}
END_TEST

/* Under AddressSanitizer too, malloc is to return NULL for what is too much. */
const char *__asan_default_options(void);
const char *__asan_default_options(void)
{
    return "allocator_may_return_null=1";
}

int main(void)
{
    Suite *suite = suite_create("12 memory");
    ADD_CASE(suite, "values", eq_12_1_small_integers_are_summed_exactly,
             eq_12_1_integer_orders_need_no_memory,
             eq_12_6_every_weight_of_the_tail_is_within_delta,
             eq_12_11_the_errors_of_all_weights_add_up_to_delta_at_most);
    ADD_CASE(suite, "identities", eq_12_1_many_coordinates_are_many_memories,
             eq_12_1_the_sum_may_replace_the_term,
             eq_12_1_the_direct_sum_is_the_definition,
             eq_12_13_the_weights_fall_and_are_convex);
    ADD_CASE(suite, "errors", bad_memories_are_refused_and_nothing_is_touched,
             more_terms_than_announced_are_refused);
    return run_suite(suite);
}
