/* src/memory/history_modes.c -- A window and decaying modes.     [H 12] */
#include <fvi/coefficients.h>
#include "history_tiled.h"
#include "history_kinds.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum {
    LANES = 8, /* doubles in the widest vector, and in a cache line */
    PAIR = 2   /* steps that are done at once */
};

struct fvi_history_modes {
    size_t d, Q, k;      /* Q padded to a multiple of LANES */
    double near[PAIR];   /* w_1 and w_2; that of lag 0 is 1 */
    double slopes[PAIR]; /* their rates */
    double *p, *c;       /* Q numbers: z += x - p z, worth c z */
    double *window;      /* 0, 0, w_32, w_31, ..., w_3 */
    double *z;           /* Q modes for each coordinate */
    double *past;        /* the last 32 terms of each, twice over: a ring */
    double *far;         /* of each, two sums to come, over the lags >= 1 */
    double *rates; /* NULL, or dc/d nu: Q numbers; the rates of the window;
                                  and two sums of each with them, as far */
    fvi_history_tiled
        *tiles; /* NULL, or what stands for z, past and far (H 28) */
};

/* The rates are read from modes that stand as after each step. */
static int tiled(int by_order, size_t d)
{
    return !by_order && d >= FVI_TILES_FROM;
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

static size_t numbers(size_t Q, int by_order, size_t d) /* a multiple of 8 */
{
    if (tiled(by_order, d))
        d = 0;
    return 2 * Q + FVI_WINDOW + d * (Q + 2 * FVI_WINDOW) + padded(PAIR * d)
           + (by_order ? Q + FVI_WINDOW + padded(PAIR * d) : 0);
}

fvi_node_range fvi_history_modes_plan(double nu, size_t steps, double delta)
{
    return fvi_node_range_of(nu, 1 + nu, nu, lags(steps), delta, 1);
}

size_t fvi_history_modes_bytes(const fvi_node_range *g, int by_order, size_t d)
{
    const size_t Q = padded(g->Q);
    if (d > SIZE_MAX / sizeof(double) / 2 / (Q + 2 * FVI_WINDOW))
        return SIZE_MAX;
    const size_t bytes =
        sizeof(fvi_history_modes) + numbers(Q, by_order, d) * sizeof(double);
    return tiled(by_order, d) ? bytes + fvi_history_tiled_bytes(d, Q) : bytes;
}

/* Zeros, or NULL. */
static fvi_history_modes *make(size_t Q, int by_order, size_t d)
{
    const size_t n = numbers(Q, by_order, d);
    fvi_history_modes *e = malloc(sizeof *e);
    double *block = aligned_alloc(64, n * sizeof *block);
    if (!e || !block) {
        free(e);
        free(block);
        return NULL;
    }
    memset(block, 0, n * sizeof *block);
    *e = (fvi_history_modes){ .d = d, .Q = Q, .p = block, .c = block + Q };
    e->window = e->c + Q;
    if (tiled(by_order, d))
        return e;
    e->z = e->window + FVI_WINDOW;
    e->past = e->z + d * Q;
    e->far = e->past + d * 2 * FVI_WINDOW;
    if (by_order)
        e->rates = e->far + padded(PAIR * d);
    return e;
}

/* Of a rated memory. */
static double *further(const fvi_history_modes *e)
{
    return e->rates + e->Q + FVI_WINDOW;
}

/* w_1 to w_32, or their rates: those of the nearest, and the window of the others. */
static void open_window(const double *w, double *near, double *window)
{
    memcpy(near, w + 1, PAIR * sizeof *w);
    for (size_t n = PAIR + 1; n <= FVI_WINDOW; n++)
        window[FVI_WINDOW + PAIR - n] = w[n];
}

/* p holds s, and becomes what a mode loses in a step; padding ends as c = 0. */
static void decays(fvi_history_modes *e)
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
static fvi_history_modes *finish(fvi_history_modes *e, const double *w)
{
    open_window(w, e->near, e->window);
    decays(e);
    if (!tiled(e->rates != NULL, e->d))
        return e;
    e->tiles = fvi_history_tiled_alloc(e->d, e->Q, e->p, e->c, w);
    if (e->tiles)
        return e;
    fvi_history_modes_free(e);
    return NULL;
}

fvi_history_modes *fvi_history_modes_alloc(const fvi_node_range *g, double nu,
                                         int by_order, size_t d, size_t steps)
{
    fvi_history_modes *e = make(padded(g->Q), by_order, d);
    if (!e)
        return NULL;
    double w[FVI_WINDOW + 1];
    if (by_order) {
        fvi_gl_weights_by_order(nu, FVI_WINDOW + 1, w);
        open_window(w, e->slopes, e->rates + e->Q);
    }
    fvi_gl_weights(nu, FVI_WINDOW + 1, w);
    fvi_history_modes_rule(g, nu, lags(steps), e->p, e->c, e->rates);
    return finish(e, w);
}

fvi_history_modes *fvi_history_modes_of(size_t Q, const double *s,
                                      const double *c, const double *w,
                                      size_t d)
{
    fvi_history_modes *e = make(padded(Q), 0, d);
    if (!e)
        return NULL;
    memcpy(e->p, s, Q * sizeof *s);
    memcpy(e->c, c, Q * sizeof *c);
    return finish(e, w);
}

fvi_history_modes *fvi_history_modes_copy(const fvi_history_modes *from)
{
    fvi_history_modes *e = make(from->Q, from->rates != NULL, from->d);
    if (!e)
        return NULL;
    memcpy(e->p, from->p, numbers(e->Q, e->rates != NULL, e->d) * sizeof *e->p);
    memcpy(e->near, from->near, sizeof e->near);
    memcpy(e->slopes, from->slopes, sizeof e->slopes);
    e->k = from->k;
    e->tiles = from->tiles ? fvi_history_tiled_copy(from->tiles) : NULL;
    if (!e->tiles == !from->tiles)
        return e;
    fvi_history_modes_free(e);
    return NULL;
}

/* The nodes depend on N, and must be the same. */
int fvi_history_modes_archive(fvi_history_modes *e, size_t k, fvi_archive *v)
{
    const size_t number = sizeof(double);
    int status = v->serialize(v, &e->Q, sizeof e->Q, 1);
    if (!status)
        status = v->serialize(v, e->p, 2 * e->Q * number, 1);
    if (!status && e->tiles)
        return fvi_history_tiled_archive(e->tiles, k, v);
    if (!status)
        status = v->serialize(v, &e->k, sizeof e->k, 0);
    if (!status)
        status = fvi_check_count(e->k, k);
    if (!status)
        status = v->serialize(
            v, e->z,
            (e->d * (e->Q + 2 * FVI_WINDOW) + padded(PAIR * e->d)) * number, 0);
    return status || !e->rates
               ? status
               : v->serialize(v, further(e), padded(PAIR * e->d) * number, 0);
}

void fvi_history_modes_free(fvi_history_modes *e)
{
    if (!e)
        return;
    fvi_history_tiled_free(e->tiles);
    free(e->p);
    free(e);
}

typedef double four
    __attribute__((vector_size(4 * sizeof(double)), aligned(8), may_alias));

#define WITHIN static inline __attribute__((always_inline))

/* The sum of the eight lanes of v[0] and v[1]. */
WITHIN double across(const four *v)
{
    const four u = v[0] + v[1];
    return (u[0] + u[2]) + (u[1] + u[3]);
}

/* `new` into the ring, in the place of the oldest term. */
WITHIN void keep(double *past, double new)
{
    past[0] = past[FVI_WINDOW] = new;
}

/* All modes two steps on, the terms at past + 1 coming in, and the next two sums of what
 * is known: of the modes after each step, of the window, and of `new` and of the term
 * before it, which stands at past. Partial sum l takes every eighth term, from the l-th
 * on, on every machine: vectors of 2 or 4 doubles change the time and not one digit. No
 * vector waits for the two terms that came in last. */
WITHIN void sweep(const fvi_history_modes *e, double *modes, double *past,
                  double new, int by_order, double *far, double *slope)
{
    const four *p = (four *)e->p, *c = (four *)e->c, *by = (four *)e->rates;
    const four *w = (four *)e->window, *wdot = by_order ? by + e->Q / 4 : NULL;
    four *z = (four *)modes, sum[PAIR][2] = { 0 }, rate[PAIR][2] = { 0 };
    const four none = { 0 }, x[] = { none + past[1], none + past[2] };
    //> modes
    for (size_t q = 0, Q = e->Q / 4; q < Q; q += 2) {
        four now[] = { z[q], z[q + 1] };
#pragma GCC unroll 2
        for (size_t n = 0; n < PAIR; n++)
#pragma GCC unroll 2
            for (size_t l = 0; l < 2; l++) {
                now[l] += x[n] - p[q + l] * now[l]; /* (12.12) */
                sum[n][l] += c[q + l] * now[l];
                if (by_order)
                    rate[n][l] += by[q + l] * now[l];
            }
        z[q] = now[0];
        z[q + 1] = now[1];
    }
    //< modes
#pragma GCC unroll 4
    for (size_t j = 0; j < FVI_WINDOW / 4; j += 2)
#pragma GCC unroll 2
        for (size_t n = 0; n < PAIR; n++)
#pragma GCC unroll 2
            for (size_t l = 0; l < 2; l++) {
                const four then = *(const four *)(past + n + 4 * (j + l));
                sum[n][l] += w[j + l] * then;
                if (by_order)
                    rate[n][l] += wdot[j + l] * then;
            }
    far[0] = across(sum[0]) + e->near[1] * past[0] + e->near[0] * new;
    far[1] = across(sum[1]) + e->near[1] * new;
    if (by_order) {
        slope[0] =
            across(rate[0]) + e->slopes[1] * past[0] + e->slopes[0] * new;
        slope[1] = across(rate[1]) + e->slopes[1] * new;
    }
    keep(past + 1, new);
}

FVI_VECTORS static void advance(const fvi_history_modes *e, double *modes,
                                double *past, double new, double *far)
{
    sweep(e, modes, past, new, 0, far, NULL);
}

FVI_VECTORS static void advance_rated(const fvi_history_modes *e, double *modes,
                                      double *past, double new, double *far,
                                      double *slope)
{
    sweep(e, modes, past, new, 1, far, slope);
}

//> push
/* Term k of coordinate i comes in. */
WITHIN void push_one(const fvi_history_modes *e, size_t i, size_t k, double new,
                     double *H)
{
    double *past = e->past + i * 2 * FVI_WINDOW + k % FVI_WINDOW;
    double *far = e->far + PAIR * i;
    *H = new + far[k % PAIR];
    if (k % PAIR == 0) {
        far[1] += e->near[0] * new;
        keep(past, new);
    } else
        advance(e, e->z + i * e->Q, past - 1, new, far);
}
//< push

/* Apart: whoever has one coordinate saves no register for it. */
__attribute__((noinline)) static void push_each(fvi_history_modes *e,
                                                const double *term, double *H)
{
    for (size_t i = 0; i < e->d; i++)
        push_one(e, i, e->k, term[i], H + i);
    e->k++;
}

/* No loop has to find out that it runs once. */
static void push_alone(fvi_history_modes *e, double new, double *H)
{
    push_one(e, 0, e->k++, new, H);
}

void fvi_history_modes_push(fvi_history_modes *e, const double *term, double *H)
{
    if (e->tiles)
        fvi_history_tiled_push(e->tiles, term, H);
    else if (e->d == 1)
        push_alone(e, *term, H);
    else
        push_each(e, term, H);
}

fvi_history_tiled *fvi_history_modes_tiles(const fvi_history_modes *e)
{
    return e->tiles;
}

//> push-rate
void fvi_history_modes_push_by_order(fvi_history_modes *e, const double *term,
                                double *H, double *rate)
{
    const size_t place = e->k % FVI_WINDOW, now = e->k++ % PAIR;
    for (size_t i = 0; i < e->d; i++) {
        double new = term[i], *past = e->past + i * 2 * FVI_WINDOW + place;
        double *far = e->far + PAIR * i, *slope = further(e) + PAIR * i;
        H[i] = new + far[now];
        rate[i] = slope[now];
        if (now == 0) {
            far[1] += e->near[0] * new;
            slope[1] += e->slopes[0] * new;
            keep(past, new);
        } else
            advance_rated(e, e->z + i * e->Q, past - 1, new, far, slope);
    }
}
//< push-rate

void fvi_history_modes_ahead(const fvi_history_modes *e, double *sum)
{
    if (e->tiles) {
        fvi_history_tiled_ahead(e->tiles, sum);
        return;
    }
    for (size_t i = 0; i < e->d; i++)
        sum[i] += e->far[PAIR * i + e->k % PAIR];
}
