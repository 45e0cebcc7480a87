/* tests/bench/fft_blocks.c -- Sum the history by convolutions in blocks whose lengths double. [H 12] */
#include "fft_blocks.h"

#include <fvi/coefficients.h>
#include <gsl/gsl_fft_halfcomplex.h>
#include <gsl/gsl_fft_real.h>
#include <stdlib.h>
#include <string.h>

enum { BASE = 64, MOST_LEVELS = 58 }; /* BASE 2^58 is beyond size_t */

/* A block of BASE 2^j terms is convolved with the weights up to a lag of twice its length. */
typedef struct {
    size_t length;
    double *spectrum; /* the transform of these weights */
    gsl_fft_real_wavetable *real;
    gsl_fft_halfcomplex_wavetable *halfcomplex;
} level;

struct fft_blocks {
    size_t steps, k, levels;
    double *near;      /* w_0 ... w_{BASE-1}; the arrays below follow it */
    double *terms;     /* term k at [k] */
    double *sums;      /* contributions of complete blocks, one sum for each place */
    double *transform; /* as long as the longest transform */
    double *scratch;
    level level[MOST_LEVELS];
};

static size_t count_levels(size_t steps)
{
    size_t levels = 0;
    while (levels < MOST_LEVELS && steps / BASE >> levels)
        levels++;
    return levels;
}

/* The longest transform has the length of two longest blocks. All spectra together have less than twice this
 * length. */
static size_t count_numbers(size_t steps)
{
    const size_t levels = count_levels(steps);
    return BASE + 2 * (steps + 1) + (levels ? (size_t)BASE << (levels + 2) : 0);
}

size_t fft_blocks_bytes(size_t steps)
{
    size_t bytes = sizeof(fft_blocks) + count_numbers(steps) * sizeof(double);
    for (size_t j = 0; j < count_levels(steps); j++) /* GSL's cosines: */
        bytes += sizeof(gsl_fft_real_wavetable)
                 + sizeof(gsl_fft_halfcomplex_wavetable)
                 + 3 * ((size_t)BASE << (j + 1)) * sizeof(double);
    return bytes;
}

/* Transform the weights. They are written to the place of the longest spectrum, and each shorter spectrum
 * begins as a copy of its first part. Weights beyond the lag `steps` are never used. */
static void transform_weights(fft_blocks *b, double nu)
{
    double *w = b->level[b->levels - 1].spectrum;
    const size_t longest = 2 * b->level[b->levels - 1].length;
    fvi_gl_weights(nu, b->steps + 1 < longest ? b->steps + 1 : longest, w);
    for (size_t j = 0; j < b->levels; j++) {
        level *l = b->level + j;
        const size_t n = 2 * l->length;
        if (l->spectrum != w)
            memcpy(l->spectrum, w, n * sizeof *w);
        gsl_fft_real_workspace work = { n, b->scratch };
        gsl_fft_real_transform(l->spectrum, 1, n, l->real, &work);
    }
}

/* Make GSL's cosines for all levels. Return whether there was memory for all. */
static int make_tables(fft_blocks *b)
{
    for (level *l = b->level; l < b->level + b->levels; l++) {
        l->real = gsl_fft_real_wavetable_alloc(2 * l->length);
        l->halfcomplex = gsl_fft_halfcomplex_wavetable_alloc(2 * l->length);
        if (!l->real || !l->halfcomplex)
            return 0;
    }
    return 1;
}

fft_blocks *fft_blocks_alloc(double nu, size_t steps)
{
    fft_blocks *b = calloc(1, sizeof *b);
    double *block = calloc(count_numbers(steps), sizeof *block);
    if (!b || !block) {
        free(b);
        free(block);
        return NULL;
    }
    b->steps = steps;
    b->levels = count_levels(steps);
    const size_t longest = (size_t)BASE << b->levels;
    b->near = block;
    b->terms = b->near + BASE;
    b->sums = b->terms + steps + 1;
    b->transform = b->sums + steps + 1;
    b->scratch = b->transform + longest;
    double *spectrum = b->scratch + longest;
    for (size_t j = 0; j < b->levels; j++) {
        b->level[j].length = (size_t)BASE << j;
        b->level[j].spectrum = spectrum;
        spectrum += 2 * b->level[j].length;
    }
    if (!make_tables(b)) {
        fft_blocks_free(b);
        return NULL;
    }
    fvi_gl_weights(nu, BASE, b->near);
    if (b->levels)
        transform_weights(b, nu);
    return b;
}

void fft_blocks_free(fft_blocks *b)
{
    for (size_t j = 0; b && j < b->levels; j++) {
        if (b->level[j].real)
            gsl_fft_real_wavetable_free(b->level[j].real);
        if (b->level[j].halfcomplex)
            gsl_fft_halfcomplex_wavetable_free(b->level[j].halfcomplex);
    }
    if (b)
        free(b->near);
    free(b);
}

/* a *= b for two spectra in GSL's format: r_0, r_1, i_1, ..., r_{n/2}. */
static void multiply(size_t n, double *a, const double *b)
{
    a[0] *= b[0];
    for (size_t j = 1; j + 1 < n; j += 2) {
        double re = a[j] * b[j] - a[j + 1] * b[j + 1];
        a[j + 1] = a[j] * b[j + 1] + a[j + 1] * b[j];
        a[j] = re;
    }
    a[n - 1] *= b[n - 1];
}

/* Add the contributions of the last `length` terms to the next `length` sums. (12.4) */
static void convolve(fft_blocks *b, const level *l, const double *terms,
                     double *sums, size_t room)
{
    const size_t n = 2 * l->length;
    double *y = b->transform;
    memcpy(y, terms, l->length * sizeof *y);
    memset(y + l->length, 0, l->length * sizeof *y);
    gsl_fft_real_workspace forth = { n, b->scratch };
    gsl_fft_real_transform(y, 1, n, l->real, &forth);
    multiply(n, y, l->spectrum);
    gsl_fft_real_workspace back = { n, b->scratch };
    gsl_fft_halfcomplex_inverse(y, 1, n, l->halfcomplex, &back);
    for (size_t j = 0; j < l->length && j < room; j++)
        sums[j] += y[l->length + j];
}

double fft_blocks_push(fft_blocks *b, double x)
{
    const size_t k = b->k, row = b->steps + 1;
    double sum = b->sums[k];
    b->terms[k] = x;
    for (size_t j = k / BASE * BASE; j <= k; j++) /* the block that is not full yet */
        sum += b->near[k - j] * b->terms[j];
    const size_t next = ++b->k;
    if (next % BASE != 0 || next >= row)
        return sum;
    size_t j = 0;
    while (((next / BASE) >> j) % 2 == 0) /* BASE 2^j divides `next` */
        j++;
    const level *l = b->level + j;
    convolve(b, l, b->terms + next - l->length, b->sums + next, row - next);
    return sum;
}
