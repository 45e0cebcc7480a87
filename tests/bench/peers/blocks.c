/* tests/bench/peers/blocks.c -- Discrete convolutions of functions that are still being made: blocks.h. [H 18] */
#include "blocks.h"
#include "memory/history_kinds.h" /* FVI_VECTORS */

#include <gsl/gsl_fft_halfcomplex.h>
#include <gsl/gsl_fft_real.h>
#include <stdlib.h>
#include <string.h>

/* A transform is faster than the direct sum from this length on. */
enum { BLOCK = 256, MOST_BITS = 40 };

struct blocks {
    const double *w;
    double *reversed; /* w_N ... w_0, so that sums run forwards through both arrays */
    size_t N, d;
    double *spectrum[MOST_BITS];
    double *g, *sum,
        *work; /* d rows of N + 1 values, the newest last; d rows of sums */
};

blocks *blocks_alloc(const double *w, size_t N, size_t d)
{
    size_t longest = 2 * BLOCK;
    while (longest < 2 * (N + 1))
        longest *= 2;
    blocks *b = calloc(1, sizeof *b);
    if (!b)
        return NULL;
    *b = (blocks){ .w = w, .N = N, .d = d };
    const size_t far = N < 2 * BLOCK ? 0 : N + 1; /* the sums to which blocks contribute */
    b->g = malloc(((d + 1) * (N + 1) + d * far + (far ? longest : 0)) * sizeof *b->g);
    if (!b->g) {
        free(b);
        return NULL;
    }
    b->reversed = b->g + d * (N + 1);
    for (size_t k = 0; k <= N; k++)
        b->reversed[k] = w[N - k];
    b->sum = b->reversed + N + 1;
    b->work = b->sum + d * far;
    memset(b->sum, 0, d * far * sizeof *b->sum);
    return b;
}

void blocks_free(blocks *b)
{
    for (int i = 0; b && i < MOST_BITS; i++)
        free(b->spectrum[i]);
    if (b)
        free(b->g);
    free(b);
}

/* v = u times v, for the transforms of real sequences of length n. */
static void multiply(const double *u, double *v, size_t n)
{
    v[0] *= u[0];
    v[n / 2] *= u[n / 2];
    for (size_t k = 1; k < n / 2; k++) {
        const double re = u[k] * v[k] - u[n - k] * v[n - k];
        v[n - k] = u[k] * v[n - k] + u[n - k] * v[k];
        v[k] = re;
    }
}

/* Before step n: add the contributions of the terms n - L, ..., n - 1 to the sums n, ..., n + L - 1, where L is
 * the largest power of two that divides n. g_0 is not one of the terms. */
static int add_block(blocks *b, size_t n)
{
    const size_t L = n & -n, size = 2 * L;
    int bits = 0;
    while (((size_t)1 << bits) < size)
        bits++;
    if (!b->spectrum[bits]) {
        double *s = b->spectrum[bits] = calloc(size, sizeof *s);
        if (!s)
            return 1;
        memcpy(s, b->w, (size < b->N + 1 ? size : b->N + 1) * sizeof *s);
        gsl_fft_real_radix2_transform(s, 1, size);
    }
    for (size_t i = 0; i < b->d; i++) {
        double *g = b->g + i * (b->N + 1), *sum = b->sum + i * (b->N + 1);
        memset(b->work, 0, size * sizeof *b->work);
        memcpy(b->work, g + n - L, L * sizeof *b->work);
        if (n == L)
            b->work[0] = 0;
        gsl_fft_real_radix2_transform(b->work, 1, size);
        multiply(b->spectrum[bits], b->work, size);
        gsl_fft_halfcomplex_radix2_inverse(b->work, 1, size);
        for (size_t j = 0; j < L && n + j <= b->N; j++)
            sum[n + j] += b->work[L + j];
    }
    return 0;
}

FVI_VECTORS static double multiply_sums(size_t count, const double *restrict w,
                                const double *restrict g)
{
    double sum = 0;
#pragma omp simd reduction(+ : sum)
    for (size_t j = 0; j < count; j++)
        sum += w[j] * g[j];
    return sum;
}

int blocks_sum(blocks *b, size_t n, double *sum)
{
    const int far = b->N >= 2 * BLOCK;
    const size_t from = !far || n < BLOCK ? 1 : n - n % BLOCK;
    if (far && n % BLOCK == 0 && add_block(b, n))
        return 1;
    for (size_t i = 0; i < b->d; i++)
        sum[i] = (far ? b->sum[i * (b->N + 1) + n] : 0)
                 + multiply_sums(n - from, b->reversed + (b->N - n + from),
                         b->g + i * (b->N + 1) + from);
    return 0;
}

void blocks_push(blocks *b, size_t n, const double *g)
{
    for (size_t i = 0; i < b->d; i++)
        b->g[i * (b->N + 1) + n] = g[i];
}
