/* tests/integration_by_parts/test_integration_by_parts.c -- H 5: identities, and
 * the orders of both operators.
 * Run alone: make test-integration_by_parts */
#include "both.h"
#include "integration_by_parts_ref.h"

#include <stdlib.h>

/* ---- identities ---- */

/* h^-alpha sum_k sum_n |alpha_n| |G_k| . |F_{k-n}|, componentwise. */
static double size_of_sum(double alpha, double h, size_t N, size_t d,
                          const double *F, const double *G)
{
    double *unit = calloc(2 * (N + 1), sizeof *unit), *w = unit + N + 1,
           sum = 0;
    unit[0] = 1;
    both(alpha, h, N, 1, unit, w, NULL); /* h^-alpha alpha_n */
    for (size_t k = 0; k <= N; k++)
        for (size_t n = 0; n <= k; n++)
            for (size_t i = 0; i < d; i++)
                sum += fabs(w[n] * G[k * d + i] * F[(k - n) * d + i]);
    free(unit);
    return sum;
}

/* (5.4) for random vectors. Both sides add up the same numbers alpha_n G.F; a
 * term meets at most N + 6 roundings in (5.1) (above, t <= N + 1), one product
 * and (N + 1) d additions in (5.3). Twice that, for the two sides.
 * Seen: 0.0003 of the bound. */
START_TEST(eq_5_4_the_full_range_needs_no_hypothesis)
{
    enum { N = 200, D = 3, LENGTH = (N + 1) * D };
    double F[LENGTH], G[LENGTH], minus_F[LENGTH], plus_G[LENGTH];
    const double alphas[] = { 0, 0.1, 1.0 / 3, 0.5, 0.9, 1, 1.5, 2 };
    for (size_t j = 0; j < LENGTH; j++) {
        F[j] = next_number();
        G[j] = next_number();
    }
    for (size_t i = 0; i < LEN(alphas); i++) {
        both(alphas[i], 0.1, N, D, F, minus_F, NULL);
        both(alphas[i], 0.1, N, D, G, NULL, plus_G);
        double size = size_of_sum(alphas[i], 0.1, N, D, F, G);
        ck_assert_near(fvi_sum_of_products(0, N, D, plus_G, F),
                       fvi_sum_of_products(0, N, D, G, minus_F),
                       2 * (N + 7 + LENGTH) * U * size, "alpha=%g", alphas[i]);
    }
}
END_TEST

/* (5.5), (5.6), (5.8) for integer vectors and orders whose weights are dyadic:
 * every operation is exact, so 0 ulp against the exact rationals, with each end
 * value switched on in turn; and (5.9), which does not mind. */
START_TEST(eq_5_5_to_5_9_what_each_hypothesis_is_for)
{
    enum { N = REF_N, D = REF_D, LENGTH = (N + 1) * D };
    double dF[LENGTH], dG[LENGTH]; /* Delta_- F and Delta_+ G */
    for (size_t i = 0; i < LEN(ref_sums); i++) {
        const double *F = ref_sums[i].F, *G = ref_sums[i].G;
        both(ref_sums[i].alpha, 1, N, D, F, dF, NULL);
        both(ref_sums[i].alpha, 1, N, D, G, NULL, dG);
        //> sides
        const double sides[6] = {
            fvi_sum_of_products(0, N - 1, D, dG, F), /* (5.5) */
            fvi_sum_of_products(1, N, D, G, dF),
            fvi_sum_of_products(0, N - 1, D, G + D, dF + D), /* (5.6) */
            fvi_sum_of_products(1, N - 1, D, dG, F),
            fvi_sum_of_products(0, N - 1, D, dG, F + D), /* (5.8) */
            fvi_sum_of_products(1, N - 1, D, G, dF + D),
        };
        //< sides
        for (size_t j = 0; j < 6; j++)
            ck_assert_ulp(sides[j], ref_sums[i].sides[j], 0,
                          "nonzero ends: %s; alpha=%g side %zu",
                          ref_sums[i].ends, ref_sums[i].alpha, j);
        for (size_t j = 0; j < 3; j++)
            ck_assert_ulp(sides[2 * j] - sides[2 * j + 1], ref_sums[i].left[j],
                          0, "nonzero ends: %s; alpha=%g identity %zu",
                          ref_sums[i].ends, ref_sums[i].alpha, j);
        ck_assert_ulp(fvi_sum_of_products(0, N - 1, D, dG + D, F), /* (5.9) */
                      fvi_sum_of_products(0, N - 1, D, G + D, dF), 0,
                      "nonzero ends: %s", ref_sums[i].ends);
    }
}
END_TEST

/* Which identity survives which end value, read off the exact leftovers. At
 * alpha = 1 only two weights are left, and fewer terms to be left over. */
START_TEST(eq_5_5_5_6_5_8_the_table_of_the_chapter)
{
    const struct {
        const char *ends;
        int first, second, shifted;
    } survives[] = {
        { "none", 1, 1, 1 },  { "F0", 1, 0, 0 },
        { "FN", 1, 1, 1 },    { "G0", 1, 1, 0 },
        { "GN", 1, 1, 0 },    { "F0 G0", 0, 0, 0 },
        { "FN GN", 0, 0, 0 }, { "F0 G0 FN GN, F0.G0 = FN.GN", 1, 0, 0 }
    };
    size_t checked = 0;
    for (size_t i = 0; i < LEN(ref_sums); i++)
        for (size_t j = 0; j < LEN(survives); j++)
            if (ref_sums[i].alpha != 1
                && strcmp(ref_sums[i].ends, survives[j].ends) == 0) {
                const double *left = ref_sums[i].left;
                ck_assert((left[0] == 0) == survives[j].first);
                ck_assert((left[1] == 0) == survives[j].second);
                ck_assert((left[2] == 0) == survives[j].shifted);
                checked++;
            }
    ck_assert_uint_eq(checked, 3 * LEN(survives)); /* alpha = 1/4, 1/2, 3/2 */
}
END_TEST

/* (5.7): the same products in the same order, so 0 ulp for any data. */
START_TEST(eq_5_7_advanced_is_retarded_seen_in_a_mirror)
{
    enum { N = 50 };
    double z[N + 1], back[N + 1], plus[N + 1], minus_back[N + 1];
    for (size_t k = 0; k <= N; k++)
        z[k] = next_number();
    for (size_t k = 0; k <= N; k++)
        back[k] = z[N - k];
    for (double alpha = 0; alpha <= 2; alpha += 0.1) {
        both(alpha, 0.3, N, 1, z, NULL, plus);
        both(alpha, 0.3, N, 1, back, minus_back, NULL);
        for (size_t k = 0; k <= N; k++)
            ck_assert_ulp(plus[k], minus_back[N - k], 0, "alpha=%g k=%zu",
                          alpha, k);
    }
}
END_TEST

/* (5.10): alpha = 1, N = 3, one 1 in each sequence, all ends zero. */
//> misprint
START_TEST(eq_5_10_step_2_of_the_printed_proof_needs_delta_plus)
{
    const double F[] = { 0, 1, 0, 0 }, G[] = { 0, 0, 1, 0 };
    double minus_F[4], minus_G[4], plus_G[4];
    both(1, 1, 3, 1, F, minus_F, NULL);
    both(1, 1, 3, 1, G, minus_G, plus_G);
    ck_assert(fvi_sum_of_products(1, 3, 1, G, minus_F) == -1);
    ck_assert(fvi_sum_of_products(0, 2, 1, plus_G, F) == -1);
    ck_assert(fvi_sum_of_products(0, 2, 1, minus_G, F) == 0); /* as printed */
}
END_TEST
//< misprint

/* (5.11): alpha = 1, integers, 0 ulp; F, G do not vanish at the ends. */
START_TEST(eq_5_11_alpha_1_is_summation_by_parts)
{
    enum { N = 12 };
    const double *F = ref_z;
    double G[N + 1], dF[N + 1], dG[N + 1];
    for (size_t k = 0; k <= N; k++)
        G[k] = (double)((7 * k * k + 3) % 11);
    both(1, 1, N, 1, F, dF, NULL);
    both(1, 1, N, 1, G, NULL, dG);
    double lhs = fvi_sum_of_products(0, N - 1, 1, dG, F), products = 0;
    for (size_t k = 0; k < N; k++)
        products += (G[k + 1] - G[k]) * F[k];
    ck_assert_ulp(lhs, -products, 0, "Delta_+ is minus the forward difference");
    ck_assert_ulp(fvi_sum_of_products(1, N, 1, G, dF),
                  lhs + G[N] * F[N] - G[0] * F[0], 0, "the boundary term");
}
END_TEST

/* ---- order ---- */

/* The boundary term of h sum is h^(1 - alpha) (F_0 G_0 - F_N G_N): halving h
 * divides it by 2^(1 - alpha), at alpha = 1 by nothing. F = 1 + t, G = 2 - t^2 on
 * [0, 1]: F_0 G_0 - F_N G_N = 2 - 2 = 0 would hide it, so G = 3 - t^2: 3 - 4.
 * The two sums agree up to that to (4 N + 16) u relative to the sum of absolute
 * values (as (5.4)), which is below h^(1-alpha) 3 * 2 * 2 * (N + 1).
 * Seen: 0.0044 of the bound. */
START_TEST(eq_5_12_the_boundary_term_fades_unless_alpha_is_1)
{
    enum { MOST = 256 };
    double F[MOST + 1], G[MOST + 1], dF[MOST + 1], dG[MOST + 1];
    const double alphas[] = { 0.25, 0.5, 0.75, 1 };
    for (size_t i = 0; i < LEN(alphas); i++)
        for (size_t N = 16; N <= MOST; N *= 2) {
            double h = 1 / (double)N, fade = pow(h, 1 - alphas[i]);
            for (size_t k = 0; k <= N; k++) {
                double t = (double)k * h;
                F[k] = 1 + t;
                G[k] = 3 - t * t;
            }
            both(alphas[i], h, N, 1, F, dF, NULL);
            both(alphas[i], h, N, 1, G, NULL, dG);
            double left = h
                          * (fvi_sum_of_products(0, N - 1, 1, dG, F)
                             - fvi_sum_of_products(1, N, 1, G, dF));
            double size = fade * 12 * (double)(N + 1);
            ck_assert_near(left, -fade, (4 * (double)N + 16) * U * size,
                           "alpha=%g N=%zu", alphas[i], N);
        }
}
END_TEST

/* (5.14): both are of order 1 in h. With ((1 - e^-s)/s)^a = 1 - a s/2
 * + a (3 a + 1) s^2/24 - ... the error for t^2 at t = 1 is C h (1 + c h + ...),
 * c = -(3 a + 1)(1 - a)/12, |c| <= 0.23 for these orders; so the slope between 2 h
 * and h is 1 to within |c| h / ln 2 = 0.33 h. The advanced one of (1-t)^2 at t = 0
 * is its mirror. Allowed 0.5 h. Seen: 0.33 h. */
START_TEST(eq_5_14_both_operators_are_of_order_1)
{
    enum { MOST = 1024 };
    static double z[MOST + 1], back[MOST + 1], minus[MOST + 1], plus[MOST + 1];
    const double alphas[] = { 0.25, 0.5, 0.75, 1.5 };
    for (size_t i = 0; i < LEN(alphas); i++) {
        double want = 2 / tgamma(3 - alphas[i]), last = 0;
        for (size_t N = 64; N <= MOST; N *= 2) {
            for (size_t k = 0; k <= N; k++)
                z[k] = back[N - k] = pow((double)k / (double)N, 2);
            both(alphas[i], 1 / (double)N, N, 1, z, minus, NULL);
            both(alphas[i], 1 / (double)N, N, 1, back, NULL, plus);
            double error = fabs(minus[N] - want);
            ck_assert(plus[0] == minus[N]);
            ck_assert(N == 64 || error < last);
            if (N > 64)
                ck_assert_near(log2(last / error), 1, 0.5 / (double)N,
                               "alpha=%g N=%zu", alphas[i], N);
            last = error;
        }
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("05 integration by parts");
    ADD_CASE(suite, "identities", eq_5_4_the_full_range_needs_no_hypothesis,
             eq_5_5_to_5_9_what_each_hypothesis_is_for,
             eq_5_5_5_6_5_8_the_table_of_the_chapter,
             eq_5_7_advanced_is_retarded_seen_in_a_mirror,
             eq_5_10_step_2_of_the_printed_proof_needs_delta_plus,
             eq_5_11_alpha_1_is_summation_by_parts);
    ADD_CASE(suite, "order", eq_5_12_the_boundary_term_fades_unless_alpha_is_1,
             eq_5_14_both_operators_are_of_order_1);
    return run_suite(suite);
}
