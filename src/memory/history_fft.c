/* src/memory/history_fft.c -- Convolutions in blocks that double.       [H 12] */
#include <fvi/coefficients.h>
#include "history_kinds.h"
#include "system/fail.h"

#include <gsl/gsl_fft_halfcomplex.h>
#include <gsl/gsl_fft_real.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum { BASE = 64, MOST_LEVELS = 58 }; /* BASE 2^58 is beyond size_t */

/* A block of BASE 2^j terms meets the weights up to lag twice its length. */
typedef struct {
    size_t length;
    double *spectrum; /* of those weights */
    gsl_fft_real_wavetable *real;
    gsl_fft_halfcomplex_wavetable *halfcomplex;
} level;

struct fvi_history_fft {
    size_t d, steps, k, levels;
    double *near;      /* w_0 ... w_{BASE-1}; the arrays below follow it */
    double *terms;     /* component i of term k at [i * (steps + 1) + k] */
    double *sums;      /* of the blocks that are done, in the same places */
    double *transform; /* as long as the longest, and so is scratch */
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

/* The longest transform takes two of the longest blocks; all spectra together
 * take less than twice as much. */
static size_t numbers(size_t d, size_t steps)
{
    const size_t levels = count_levels(steps);
    return BASE + 2 * d * (steps + 1)
           + (levels ? (size_t)BASE << (levels + 2) : 0);
}

size_t fvi_history_fft_bytes(size_t d, size_t steps)
{
    const size_t most = SIZE_MAX / sizeof(double) / 64;
    if (steps >= most || d >= most / (steps + 1))
        return SIZE_MAX;
    size_t bytes = sizeof(fvi_history_fft) + numbers(d, steps) * sizeof(double);
    for (size_t j = 0; j < count_levels(steps); j++) /* GSL's cosines: */
        bytes += sizeof(gsl_fft_real_wavetable)
                 + sizeof(gsl_fft_halfcomplex_wavetable)
                 + 3 * ((size_t)BASE << (j + 1)) * sizeof(double);
    return bytes;
}

/* fvi_gl_weights, or their rates. */
typedef int weights_of(double nu, size_t count, double *w);

/* The weights are written where the longest spectrum belongs; each shorter one
 * begins as a copy of its head. Weights beyond lag `steps` are never used. */
static void transform_weights(fvi_history_fft *b, double nu, weights_of *weights)
{
    double *w = b->level[b->levels - 1].spectrum;
    const size_t longest = 2 * b->level[b->levels - 1].length;
    weights(nu, b->steps + 1 < longest ? b->steps + 1 : longest, w);
    for (size_t j = 0; j < b->levels; j++) {
        level *l = b->level + j;
        const size_t n = 2 * l->length;
        if (l->spectrum != w)
            memcpy(l->spectrum, w, n * sizeof *w);
        gsl_fft_real_workspace work = { n, b->scratch };
        gsl_fft_real_transform(l->spectrum, 1, n, l->real, &work);
    }
}

/* GSL's cosines for all levels: are they there? */
static int make_tables(fvi_history_fft *b)
{
    int all = 1;
    fvi_quiet();
    for (level *l = b->level; all && l < b->level + b->levels; l++) {
        l->real = gsl_fft_real_wavetable_alloc(2 * l->length);
        l->halfcomplex = gsl_fft_halfcomplex_wavetable_alloc(2 * l->length);
        all = l->real && l->halfcomplex;
    }
    fvi_loud();
    return all;
}

/* Room and tables for so many terms, the weights yet to come; or NULL. */
static fvi_history_fft *make(size_t d, size_t steps)
{
    fvi_history_fft *b = calloc(1, sizeof *b);
    double *block = calloc(numbers(d, steps), sizeof *block);
    if (!b || !block) {
        free(b);
        free(block);
        return NULL;
    }
    b->d = d;
    b->steps = steps;
    b->levels = count_levels(steps);
    const size_t longest = (size_t)BASE << b->levels;
    b->near = block;
    b->terms = b->near + BASE;
    b->sums = b->terms + d * (steps + 1);
    b->transform = b->sums + d * (steps + 1);
    b->scratch = b->transform + longest;
    double *spectrum = b->scratch + longest;
    for (size_t j = 0; j < b->levels; j++) {
        level *l = b->level + j;
        l->length = (size_t)BASE << j;
        l->spectrum = spectrum;
        spectrum += 2 * l->length;
    }
    if (!make_tables(b)) {
        fvi_history_fft_free(b);
        return NULL;
    }
    return b;
}

fvi_history_fft *fvi_history_fft_alloc(double nu, int rate, size_t d, size_t steps)
{
    weights_of *weights = rate ? fvi_gl_weights_by_order : fvi_gl_weights;
    fvi_history_fft *b = make(d, steps);
    if (!b)
        return NULL;
    weights(nu, BASE, b->near);
    if (b->levels)
        transform_weights(b, nu, weights);
    return b;
}

fvi_history_fft *fvi_history_fft_copy(const fvi_history_fft *from)
{
    fvi_history_fft *b = make(from->d, from->steps);
    if (!b)
        return NULL;
    memcpy(b->near, from->near, numbers(b->d, b->steps) * sizeof *b->near);
    b->k = from->k;
    return b;
}

/* Where the blocks begin depends on N. */
int fvi_history_fft_archive(fvi_history_fft *b, size_t k, fvi_archive *v)
{
    int status = v->serialize(v, &b->steps, sizeof b->steps, 1);
    if (!status)
        status = v->serialize(v, &b->k, sizeof b->k, 0);
    if (!status)
        status = fvi_check_count(b->k, k);
    return status ? status
                  : v->serialize(v, b->terms,
                             2 * b->d * (b->steps + 1) * sizeof *b->terms, 0);
}

void fvi_history_fft_free(fvi_history_fft *b)
{
    if (!b)
        return;
    for (size_t j = 0; j < b->levels; j++) {
        if (b->level[j].real)
            gsl_fft_real_wavetable_free(b->level[j].real);
        if (b->level[j].halfcomplex)
            gsl_fft_halfcomplex_wavetable_free(b->level[j].halfcomplex);
    }
    free(b->near);
    free(b);
}

//> multiply
/* a *= b for two spectra as GSL packs them: r_0, r_1, i_1, ..., r_{n/2}. */
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
//< multiply

//> convolve
/* The last `length` terms meet the next `length` sums.              (12.4) */
static void convolve(fvi_history_fft *b, const level *l, const double *terms,
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
//< convolve

//> blocks
void fvi_history_fft_push(fvi_history_fft *b, const double *term, double *H)
{
    const size_t k = b->k, start = k / BASE * BASE, row = b->steps + 1;
    for (size_t i = 0; i < b->d; i++) {
        double *terms = b->terms + i * row;
        terms[k] = term[i];
        double sum = b->sums[i * row + k];
        for (size_t j = start; j <= k; j++) /* the block that is not full yet */
            sum += b->near[k - j] * terms[j];
        H[i] = sum;
    }
    const size_t next = ++b->k;
    if (next % BASE != 0 || next >= row)
        return;
    size_t j = 0;
    while (((next / BASE) >> j) % 2 == 0) /* BASE 2^j is what divides `next` */
        j++;
    const level *l = b->level + j;
    for (size_t i = 0; i < b->d; i++)
        convolve(b, l, b->terms + i * row + next - l->length,
                 b->sums + i * row + next, row - next);
}
//< blocks

void fvi_history_fft_ahead(const fvi_history_fft *b, double *sum)
{
    const size_t k = b->k, start = k / BASE * BASE, row = b->steps + 1;
    for (size_t i = 0; i < b->d; i++) {
        sum[i] += b->sums[i * row + k];
        for (size_t j = start; j < k; j++)
            sum[i] += b->near[k - j] * b->terms[i * row + j];
    }
}
