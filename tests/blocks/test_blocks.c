/* tests/blocks/test_blocks.c -- H 28: the memory by blocks gives the same sums as the memory without blocks.
 * Run alone: make test-blocks */
#include <fvi/fvi.h>
#include "harness/saved.h"
#include "harness/ulp.h"
#include "memory/history_tiled.h"
#include "memory/history_kinds.h"

#include "blocks_ref.h"

#include <stdlib.h>

static const double betas[] = { 0.02, 0.5, 0.98, 1.5, 1.98 };

static fvi_history *memory_of(double beta, size_t d, size_t steps)
{
    fvi_history *m = NULL;
    ck_assert_int_eq(
        fvi_history_alloc(beta, d, steps, FVI_HISTORY_MODES, 0, &m),
        FVI_SUCCESS);
    return m;
}

/* Between -1 and 1, the same for the same seed. */
static double random_term(void)
{
    return 2. * rand() / RAND_MAX - 1;
}

static void push(fvi_history *m, const double *x, double *H)
{
    if (fvi_history_push(m, x, x, H)) /* of increments, the terms are as good */
        ck_abort_msg("a term was refused");
}

/* ---- against exact sums ---- */

/* The modes of blocks_ref.h, by vectors of a width. */
static fvi_history_head *tiles_of(size_t d, size_t lanes)
{
    enum { Q = FVI_EIGHT };
    double p[Q] = { 0 }, c[Q] = { 0 };
    for (size_t q = 0; q < LEN(ref_modes); q++) {
        p[q] = ref_modes[q].p;
        c[q] = ref_modes[q].c;
    }
    fvi_history_head *t = fvi_history_tiled_alloc(d, Q, p, c, ref_window);
    ck_assert_ptr_nonnull(t);
    if (fvi_history_tiled_width(t, lanes))
        return t;
    free(t);
    return NULL;
}

/* A sum has 8 modes, 32 + 24 + 8 weights and the newest term: 73 products and sums. A
 * power in a table has a logarithm times up to 32 in an exponential: 34 u, and -log1p(-p)
 * is below 7 for those that matter, so 7 * 34 u; a mode has gathered 4 (32 + 2) u by its
 * four blocks. In all below 500 u of the sum of the moduli. Coordinate i has the terms
 * times 2^(i mod 5), which leaves all digits. Seen: 0.003 of that. */
START_TEST(eq_28_1_sums_are_the_exact_ones)
{
    enum { D = 21 };
    for (size_t lanes = 2; lanes <= 8; lanes *= 2) {
        fvi_history_head *t = tiles_of(D, lanes);
        for (size_t k = 0; t && k < LEN(ref_terms); k++) {
            double x[D], H[D];
            for (size_t i = 0; i < D; i++)
                x[i] = ldexp(ref_terms[k], (int)(i % 5));
            fvi_history_take(t, x, H);
            for (size_t i = 0; i < D; i++)
                ck_assert_near(ldexp(H[i], -(int)(i % 5)), ref_sums[k].want,
                               500 * U * ref_sums[k].size,
                               "by %zu, k = %zu, i = %zu", lanes, k, i);
        }
        free(t);
    }
}
END_TEST

/* ---- against the push one by one ---- */

/* An impulse at step i in coordinate i, so that every row of a block has one: the weights
 * of the plain push, each relative to itself. Both are off by n u / 10 + 140 u at most, by
 * the test of (12.11), and a power in a table by 32 u more. Seen: 0.024 of that. */
START_TEST(eq_28_1_every_weight_is_that_of_the_plain_push)
{
    enum { D = 70, N = 3000 };
    double x[D], H[D], one[N + 1], zero = 0, worst = 0;
    for (size_t b = 0; b < LEN(betas); b++) {
        fvi_history *plain = memory_of(betas[b], 1, N);
        fvi_history *m = memory_of(betas[b], D, N);
        for (size_t k = 0; k <= N; k++) {
            const double first = 1;
            push(plain, k == 0 ? &first : &zero, one + k);
        }
        for (size_t k = 0; k <= N; k++) {
            for (size_t i = 0; i < D; i++)
                x[i] = k == i;
            push(m, x, H);
            for (size_t i = 0; i < D; i++) {
                const double n = (double)k - (double)i;
                const double want = n < 0 ? 0 : one[k - i];
                const double bound = (0.2 * n + 312) * U;
                if (fabs(H[i] - want) > bound * fabs(want))
                    ck_abort_msg("beta=%g, lag %g at step %zu: %g, not %g",
                                 betas[b], n, k, H[i], want);
                if (want != 0)
                    worst = larger(worst, fabs(H[i] / want - 1) / bound);
            }
        }
        fvi_history_free(plain);
        fvi_history_free(m);
    }
    seen(worst, "of the bound");
}
END_TEST

/* |x| <= 1, and the weights after the first add up to less than 1 in modulus: at worst,
 * Q + 64 = 136 roundings of partial sums below 1 on either side would be 3e-14. We demand
 * 1e-14 after ten thousand steps, for any number in the last tile, and of ahead too, which
 * has the rounding of one subtraction more. */
static double ck_assert_agreement(double beta, size_t d, size_t N)
{
    double *x = calloc(4 * d, sizeof *x);
    ck_assert_ptr_nonnull(x);
    double *H = x + d, *ahead = H + d, *one = ahead + d, worst = 0;
    fvi_history *m = memory_of(beta, d, N), **plain = calloc(d, sizeof *plain);
    for (size_t i = 0; i < d; i++)
        plain[i] = memory_of(beta, 1, N);
    for (size_t k = 0; k <= N; k++) {
        ck_assert_int_eq(fvi_history_ahead(m, x, ahead), FVI_SUCCESS);
        for (size_t i = 0; i < d; i++) {
            ahead[i] -= beta < 1 ? x[i] : 0;
            x[i] = random_term();
            ahead[i] += x[i];
            push(plain[i], x + i, one + i);
        }
        push(m, x, H);
        for (size_t i = 0; i < d; i++) {
            worst = larger(worst, fabs(H[i] - one[i]));
            ck_assert_near(H[i], one[i], 1e-14, "beta=%g d=%zu k=%zu i=%zu",
                           beta, d, k, i);
            ck_assert_near(ahead[i], H[i], 8 * U, "ahead, k=%zu", k);
        }
    }
    for (size_t i = 0; i < d; i++)
        fvi_history_free(plain[i]);
    fvi_history_free(m);
    free(plain);
    free(x);
    return worst;
}

START_TEST(eq_28_1_many_coordinates_agree_with_one_by_one)
{
    double worst = 0;
    srand(1);
    for (size_t d = 16; d <= 40; d++)
        worst =
            larger(worst, ck_assert_agreement(betas[d % LEN(betas)], d, 200));
    for (size_t b = 0; b < LEN(betas); b++)
        worst = larger(worst, ck_assert_agreement(betas[b], 17, 10000));
    seen(worst, "apart");
}
END_TEST

/* Small integers and orders 1/2 and 3/2: in the window no product and no sum rounds. */
START_TEST(eq_28_1_small_integers_are_summed_exactly)
{
    enum { D = 33 };
    double x[D], H[D], one;
    for (double beta = 0.5; beta < 2; beta++) {
        fvi_history *m = memory_of(beta, D, 100),
                   *plain = memory_of(beta, 1, 100);
        for (size_t k = 0; k < 24; k++) {
            for (size_t i = 0; i < D; i++)
                x[i] = ref_terms[k];
            push(m, x, H);
            push(plain, x, &one);
            for (size_t i = 0; i < D; i++)
                ck_assert_ulp(H[i], one, 0, "k=%zu i=%zu", k, i);
        }
        fvi_history_free(m);
        fvi_history_free(plain);
    }
}
END_TEST

/* ---- the same digits ---- */

/* Not its place, nor how many others there are, nor the width of the vectors, nor, where
 * the library is compiled with -fopenmp, the threads among which so many are shared. */
START_TEST(eq_28_4_no_digit_depends_on_the_others_nor_on_the_vectors)
{
    enum { N = 100, FEW = 16, MANY = 10013 };
    static double x[MANY], H[MANY];
    double few[FEW];
    for (size_t lanes = 2; lanes <= 8; lanes *= 2) {
        fvi_history_head *s = tiles_of(FEW, 2), *t = tiles_of(MANY, lanes);
        srand(2);
        for (size_t k = 0; t && k < N; k++) {
            for (size_t i = 0; i < MANY; i++)
                x[i] = random_term();
            fvi_history_take(s, x + MANY - FEW, few);
            fvi_history_take(t, x, H);
            for (size_t i = 0; i < FEW; i++)
                ck_assert_ulp(H[MANY - FEW + i], few[i], 0,
                              "by %zu, k = %zu, i = %zu", lanes, k, i);
        }
        free(s);
        free(t);
    }
    fvi_history_head *t = tiles_of(FEW, 2);
    ck_assert_int_eq(fvi_history_tiled_width(t, 16), 0);
    free(t);
}
END_TEST

/* The result may be written over the input. */
START_TEST(eq_28_1_the_sums_may_replace_the_terms)
{
    enum { D = 19 };
    double x[D], H[D];
    fvi_history *m = memory_of(0.6, D, 99), *same = memory_of(0.6, D, 99);
    for (size_t k = 0; k < 100; k++) {
        for (size_t i = 0; i < D; i++)
            x[i] = random_term();
        push(m, x, H);
        push(same, x, x);
        for (size_t i = 0; i < D; i++)
            ck_assert_ulp(x[i], H[i], 0, "k=%zu", k);
    }
    fvi_history_free(m);
    fvi_history_free(same);
}
END_TEST

/* ---- the memory that has it ---- */

/* A copy, and another memory that is given what an archive saw, go on with the same
 * digits, from any row of a block. */
START_TEST(copies_and_visits_take_the_tiles_along)
{
    enum { D = 40, N = 130 };
    static char bytes[1 << 20];
    double x[D], H[3][D];
    for (size_t stop = 0; stop < 100; stop += 9) {
        fvi_history *m = memory_of(0.7, D, N), *copy, *other;
        for (size_t k = 0; k <= N; k++) {
            if (k == stop) {
                saved_state s = { { pass_saved_piece }, bytes, 0, sizeof bytes, 0 };
                ck_assert_int_eq(fvi_history_copy(m, &copy), FVI_SUCCESS);
                other = memory_of(0.7, D, N);
                ck_assert_int_eq(fvi_history_archive(m, &s.archive), 0);
                s.at = 0;
                s.is_saved = 1;
                ck_assert_int_eq(fvi_history_archive(other, &s.archive), 0);
            }
            for (size_t i = 0; i < D; i++)
                x[i] = random_term();
            push(m, x, H[0]);
            if (k >= stop) {
                push(copy, x, H[1]);
                push(other, x, H[2]);
                ck_assert_mem_eq(H[0], H[1], sizeof H[0]);
                ck_assert_mem_eq(H[0], H[2], sizeof H[0]);
            }
        }
        fvi_history_free(m);
        fvi_history_free(copy);
        fvi_history_free(other);
    }
}
END_TEST

/* A law's modes, of which one may be a spring's, with s = 0; and a rated memory has none
 * of this: its sums are the plain ones to the last digit. */
START_TEST(laws_and_rates_have_their_memories)
{
    enum { D = 20, N = 400 };
    fvi_kernel_term term[] = { { .kind = FVI_KERNEL_POWER, .rho = 1, .alpha = 0.6 },
                            { .kind = FVI_KERNEL_POWER, .rho = 2, .alpha = 0 } };
    const fvi_kernel law = { 2, term };
    fvi_history *many, *one, *rated, *plain = memory_of(0.7, 1, N);
    double x[D], H[D], rate[D], want, first;
    ck_assert_int_eq(fvi_kernel_history(&law, FVI_DELTA_EULER, 0.1, D, N,
                                    FVI_HISTORY_MODES, 0, &first, &many),
                     FVI_SUCCESS);
    ck_assert_int_eq(fvi_kernel_history(&law, FVI_DELTA_EULER, 0.1, 1, N,
                                    FVI_HISTORY_MODES, 0, &first, &one),
                     FVI_SUCCESS);
    ck_assert_int_eq(
        fvi_history_alloc_by_order(0.7, D, N, FVI_HISTORY_MODES, 0, &rated),
        FVI_SUCCESS);
    for (size_t k = 0; k <= N; k++) {
        for (size_t i = 0; i < D; i++)
            x[i] = sin((double)k);
        push(many, x, H);
        push(one, x, &want);
        for (size_t i = 0; i < D; i++)
            ck_assert_near(H[i], want, 1e-14, "a law, k=%zu", k);
        ck_assert_int_eq(fvi_history_push_by_order(rated, x, x, H, rate),
                         FVI_SUCCESS);
        push(plain, x, &want);
        for (size_t i = 0; i < D; i++)
            ck_assert_ulp(H[i], want, 0, "rated, k=%zu", k);
    }
    fvi_history_free(many);
    fvi_history_free(one);
    fvi_history_free(rated);
    fvi_history_free(plain);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("28 blocks");
    ADD_CASE(suite, "sums", eq_28_1_sums_are_the_exact_ones,
             eq_28_1_every_weight_is_that_of_the_plain_push,
             eq_28_1_many_coordinates_agree_with_one_by_one,
             eq_28_1_small_integers_are_summed_exactly);
    ADD_CASE(suite, "digits",
             eq_28_4_no_digit_depends_on_the_others_nor_on_the_vectors,
             eq_28_1_the_sums_may_replace_the_terms);
    ADD_CASE(suite, "memories", copies_and_visits_take_the_tiles_along,
             laws_and_rates_have_their_memories);
    return run_suite(suite);
}
