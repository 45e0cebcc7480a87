/* src/memory/memory_exponentials.c -- A window and decaying modes.     [Chapter 12] */
#include <fvi/coefficients.h>
#include "blocks.h"
#include "memory_kinds.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum { LANES = 8 }; /* doubles in the widest vector, and in a cache line */

struct fvi_exponentials {
    size_t d, Q, k;  /* Q padded to a multiple of LANES */
    double w1;       /* of lag 1; that of lag 0 is 1 */
    double slope1;   /* its rate */
    double *p, *c;   /* Q numbers: z += x - p z, worth c z */
    double *weights; /* 0, w_32, w_31, ..., w_2 */
    double *z;       /* Q modes for each coordinate */
    double *past;    /* the last 32 terms of each, twice over: a ring */
    double *far;     /* d sums over the lags >= 1, one step ahead */
    double *rates;   /* NULL, or dc/d nu: Q numbers, */
    double *slopes;  /* 0, those of w_32, w_31, ..., w_2, */
    double *further; /* and d such sums with them */
    fvi_tiles
        *tiles; /* NULL, or what stands for z, past and far (chapter 28) */
};

/* The rates are read from modes that stand as after each step. */
static int tiled(int rated, size_t d)
{
    return !rated && d >= FVI_TILES_FROM;
}

static size_t padded(size_t Q)
{
    return (Q + LANES - 1) / LANES * LANES;
}

/* The nodes are made for N lags, or for 128 where that is more. */
static double lags(size_t steps)
{
    return fmax((double)steps, 128);
}

static size_t numbers(size_t Q, int rated, size_t d) /* a multiple of 8 */
{
    if (tiled(rated, d))
        d = 0;
    return 2 * Q + FVI_WINDOW + d * (Q + 2 * FVI_WINDOW) + padded(d)
           + (rated ? Q + FVI_WINDOW + padded(d) : 0);
}

size_t fvi_exponentials_bytes(double nu, int rated, size_t d, size_t steps,
                              double delta)
{
    const size_t Q = padded(
        fvi_exponentials_nodes(nu, lags(steps), delta, NULL, NULL, NULL));
    if (d > SIZE_MAX / sizeof(double) / 2 / (Q + 2 * FVI_WINDOW))
        return SIZE_MAX;
    const size_t bytes =
        sizeof(fvi_exponentials) + numbers(Q, rated, d) * sizeof(double);
    return tiled(rated, d) ? bytes + fvi_tiles_bytes(d, Q) : bytes;
}

/* Zeros, or NULL. */
static fvi_exponentials *make(size_t Q, int rated, size_t d)
{
    const size_t n = numbers(Q, rated, d);
    fvi_exponentials *e = malloc(sizeof *e);
    double *block = aligned_alloc(64, n * sizeof *block);
    if (!e || !block) {
        free(e);
        free(block);
        return NULL;
    }
    memset(block, 0, n * sizeof *block);
    *e = (fvi_exponentials){ .d = d, .Q = Q, .p = block, .c = block + Q };
    e->weights = e->c + Q;
    if (tiled(rated, d))
        return e;
    e->z = e->weights + FVI_WINDOW;
    e->past = e->z + d * Q;
    e->far = e->past + d * 2 * FVI_WINDOW;
    if (rated) {
        e->rates = e->far + padded(d);
        e->slopes = e->rates + Q;
        e->further = e->slopes + FVI_WINDOW;
    }
    return e;
}

/* The weights of the lags 1 to 32. */
static void open_window(fvi_exponentials *e, const double *w)
{
    e->w1 = w[1];
    for (size_t n2 = 2; n2 <= FVI_WINDOW; n2++)
        e->weights[FVI_WINDOW + 1 - n2] = w[n2];
}

/* p holds s, and becomes what a mode loses in a step; padding ends as c = 0. */
static void decays(fvi_exponentials *e)
{
    for (size_t q = 0; q < e->Q; q++) {
        const double tail = exp(-FVI_TAIL * e->p[q]);
        e->c[q] *= tail;
        if (e->rates)
            e->rates[q] *= tail;
        e->p[q] = -expm1(-e->p[q]);
    }
}

/* e, or NULL if there is no memory for many coordinates. */
static fvi_exponentials *finish(fvi_exponentials *e)
{
    decays(e);
    if (!tiled(e->rates != NULL, e->d))
        return e;
    e->tiles = fvi_tiles_alloc(e->d, e->Q, e->p, e->c, e->weights, e->w1);
    if (e->tiles)
        return e;
    fvi_exponentials_free(e);
    return NULL;
}

fvi_exponentials *fvi_exponentials_alloc(double nu, int rated, size_t d,
                                         size_t steps, double delta)
{
    const double N = lags(steps);
    const size_t Q = fvi_exponentials_nodes(nu, N, delta, NULL, NULL, NULL);
    fvi_exponentials *e = make(padded(Q), rated, d);
    if (!e)
        return NULL;
    double w[FVI_WINDOW + 1];
    fvi_coefficients(nu, FVI_WINDOW + 1, w);
    open_window(e, w);
    fvi_exponentials_nodes(nu, N, delta, e->p, e->c, e->rates);
    if (rated) {
        fvi_coefficients_rate(nu, FVI_WINDOW + 1, w);
        e->slope1 = w[1];
        for (size_t n = 2; n <= FVI_WINDOW; n++)
            e->slopes[FVI_WINDOW + 1 - n] = w[n];
    }
    return finish(e);
}

fvi_exponentials *fvi_exponentials_of(size_t Q, const double *s,
                                      const double *c, const double *w,
                                      size_t d)
{
    fvi_exponentials *e = make(padded(Q), 0, d);
    if (!e)
        return NULL;
    open_window(e, w);
    memcpy(e->p, s, Q * sizeof *s);
    memcpy(e->c, c, Q * sizeof *c);
    return finish(e);
}

fvi_exponentials *fvi_exponentials_copy(const fvi_exponentials *from)
{
    fvi_exponentials *e = make(from->Q, from->rates != NULL, from->d);
    if (!e)
        return NULL;
    memcpy(e->p, from->p, numbers(e->Q, e->rates != NULL, e->d) * sizeof *e->p);
    e->w1 = from->w1;
    e->slope1 = from->slope1;
    e->k = from->k;
    e->tiles = from->tiles ? fvi_tiles_copy(from->tiles) : NULL;
    if (!e->tiles == !from->tiles)
        return e;
    fvi_exponentials_free(e);
    return NULL;
}

/* The nodes depend on N, and must be the same. */
int fvi_exponentials_visit(fvi_exponentials *e, fvi_visitor *v)
{
    const size_t number = sizeof(double);
    int status = v->visit(v, &e->Q, sizeof e->Q, 1);
    if (!status)
        status = v->visit(v, e->p, 2 * e->Q * number, 1);
    if (!status && e->tiles)
        return fvi_tiles_visit(e->tiles, v);
    if (!status)
        status = v->visit(v, &e->k, sizeof e->k, 0);
    if (!status)
        status = v->visit(
            v, e->z, (e->d * (e->Q + 2 * FVI_WINDOW) + padded(e->d)) * number,
            0);
    return status || !e->further
               ? status
               : v->visit(v, e->further, padded(e->d) * number, 0);
}

void fvi_exponentials_free(fvi_exponentials *e)
{
    if (!e)
        return;
    fvi_tiles_free(e->tiles);
    free(e->p);
    free(e);
}

/* All modes one step on, and their sum; then the window. Partial sum l takes
 * every eighth term, from the l-th on, on every machine: vectors of 2, 4 or 8
 * doubles change the time and not one digit. Nothing here waits for the term
 * that has just come in. */
FVI_VECTORS static double advance(size_t Q, const double *restrict p,
                                  const double *restrict c, double *restrict z,
                                  const double *restrict weights,
                                  const double *restrict past)
{
    double sum[LANES] = { 0 }, x = past[0];
    //> modes
    for (size_t q = 0; q < Q; q += LANES) {
#pragma GCC unroll 8
        for (size_t l = 0; l < LANES; l++) {
            z[q + l] += x - p[q + l] * z[q + l]; /* (12.12) */
            sum[l] += c[q + l] * z[q + l];
        }
    }
    //< modes
    for (size_t j = 0; j < FVI_WINDOW; j += LANES) {
#pragma GCC unroll 8
        for (size_t l = 0; l < LANES; l++)
            sum[l] += weights[j + l] * past[j + l];
    }
    return ((sum[0] + sum[4]) + (sum[2] + sum[6]))
           + ((sum[1] + sum[5]) + (sum[3] + sum[7]));
}

//> push
static void push_each(fvi_exponentials *e, const double *term, double *H)
{
    const size_t place = e->k++ % FVI_WINDOW;
    for (size_t i = 0; i < e->d; i++) {
        double new = term[i], *past = e->past + i * 2 * FVI_WINDOW + place;
        H[i] = new + e->far[i];
        e->far[i] = advance(e->Q, e->p, e->c, e->z + i * e->Q, e->weights, past)
                    + e->w1 * new;
        past[0] = past[FVI_WINDOW] = new;
    }
}
//< push

void fvi_exponentials_push(fvi_exponentials *e, const double *term, double *H)
{
    if (e->tiles)
        fvi_tiles_push(e->tiles, term, H);
    else
        push_each(e, term, H);
}

fvi_tiles *fvi_exponentials_tiles(const fvi_exponentials *e)
{
    return e->tiles;
}

/* As advance, and the rates in the same pass. Of two sums gcc makes no vectors by itself. */
FVI_VECTORS static void advance_rated(const fvi_exponentials *e, double *z,
                                      const double *past, double *out)
{
    typedef double half
        __attribute__((vector_size(4 * sizeof(double)), aligned(8), may_alias));
    const half *p = (half *)e->p, *c = (half *)e->c, *by = (half *)e->rates;
    const half *w = (half *)e->weights, *wdot = (half *)e->slopes;
    half sum[2] = { { 0 } }, rate[2] = { { 0 } };
    const double x = past[0];
    for (size_t q = 0, Q = e->Q / 4; q < Q; q += 2) {
#pragma GCC unroll 2
        for (size_t l = 0; l < 2; l++) {
            half now = ((half *)z)[q + l];
            now += x - p[q + l] * now;
            ((half *)z)[q + l] = now;
            sum[l] += c[q + l] * now;
            rate[l] += by[q + l] * now;
        }
    }
    for (size_t j = 0; j < FVI_WINDOW / 4; j += 2) {
#pragma GCC unroll 2
        for (size_t l = 0; l < 2; l++) {
            const half then = ((const half *)past)[j + l];
            sum[l] += w[j + l] * then;
            rate[l] += wdot[j + l] * then;
        }
    }
    sum[0] += sum[1];
    rate[0] += rate[1];
    out[0] = (sum[0][0] + sum[0][2]) + (sum[0][1] + sum[0][3]);
    out[1] = (rate[0][0] + rate[0][2]) + (rate[0][1] + rate[0][3]);
}

//> push-rate
void fvi_exponentials_push_rate(fvi_exponentials *e, const double *term,
                                double *H, double *rate)
{
    const size_t place = e->k++ % FVI_WINDOW;
    for (size_t i = 0; i < e->d; i++) {
        double new = term[i], *past = e->past + i * 2 * FVI_WINDOW + place;
        double next[2];
        H[i] = new + e->far[i];
        rate[i] = e->further[i];
        advance_rated(e, e->z + i * e->Q, past, next);
        e->far[i] = next[0] + e->w1 * new;
        e->further[i] = next[1] + e->slope1 * new;
        past[FVI_WINDOW] = past[0] = new;
    }
}
//< push-rate

void fvi_exponentials_ahead(const fvi_exponentials *e, double *sum)
{
    if (e->tiles) {
        fvi_tiles_ahead(e->tiles, sum);
        return;
    }
    for (size_t i = 0; i < e->d; i++)
        sum[i] += e->far[i];
}
