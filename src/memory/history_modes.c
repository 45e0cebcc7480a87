/* src/memory/history_modes.c -- A window and decaying modes.     [H 12] */
#include <fvi/coefficients.h>
#include "history_tiled.h"
#include "history_kinds.h"

#include "system/archive_pieces.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum {
    LANES = 8, /* doubles in the widest vector, and in a cache line */
    PAIR = 2   /* steps that are done at once */
};

typedef struct {
    fvi_history_head head;
    size_t Q;            /* padded to a multiple of LANES */
    int by_order;
    double near[PAIR];   /* w_1 and w_2; that of lag 0 is 1 */
    double slopes[PAIR]; /* their rates */
    double *p, *c;       /* Q numbers: z += x - p z, worth c z */
    double *window;      /* 0, 0, w_32, w_31, ..., w_3 */
    double *z;           /* Q modes for each coordinate */
    double *past;        /* the last 32 terms of each, twice over: a ring */
    double *far;         /* of each, two sums to come, over the lags >= 1 */
    double *rates;       /* dc/d nu: Q numbers; the rates of the window; and two sums of each with
                          * them, as far. Of a memory by_order */
    _Alignas(64) double numbers[];
} modes_engine;

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
    return tiled(by_order, d)
               ? fvi_history_tiled_bytes(d, Q)
               : fvi_history_piece(sizeof(modes_engine), numbers(Q, by_order, d));
}

static void place(fvi_history_head *head)
{
    modes_engine *e = (modes_engine *)head;
    e->p = e->numbers;
    e->c = e->p + e->Q;
    e->window = e->c + e->Q;
    e->z = e->window + FVI_WINDOW;
    e->past = e->z + head->d * e->Q;
    e->far = e->past + head->d * 2 * FVI_WINDOW;
    e->rates = e->far + padded(PAIR * head->d);
}

static const fvi_history_engine engine;

/* Zeros, or NULL. */
static modes_engine *make(size_t Q, int by_order, size_t d)
{
    modes_engine *e = fvi_history_make((fvi_history_head){
        .is = &engine,
        .bytes = fvi_history_piece(sizeof *e, numbers(Q, by_order, d)),
        .d = d });
    if (!e)
        return NULL;
    e->Q = Q;
    e->by_order = by_order;
    place(&e->head);
    return e;
}

/* Of a rated memory. */
static double *further(const modes_engine *e)
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
static void decays(modes_engine *e)
{
    for (size_t q = 0; q < e->Q; q++) {
        const double tail = exp(-FVI_TAIL * e->p[q]);
        e->c[q] *= tail;
        if (e->by_order)
            e->rates[q] *= tail;
        e->p[q] = -expm1(-e->p[q]);
    }
}

/* The engine for d coordinates: e, or if it was made for none one that goes by tiles. */
static fvi_history_head *finish(modes_engine *e, const double *w, size_t d)
{
    decays(e);
    if (e->head.d == d) {
        open_window(w, e->near, e->window);
        return &e->head;
    }
    fvi_history_head *tiles = fvi_history_tiled_alloc(d, e->Q, e->p, e->c, w);
    free(e);
    return tiles;
}

fvi_history_head *fvi_history_modes_alloc(const fvi_node_range *g, double nu,
                                          int by_order, size_t d, size_t steps)
{
    modes_engine *e = make(padded(g->Q), by_order, tiled(by_order, d) ? 0 : d);
    if (!e)
        return NULL;
    double w[FVI_WINDOW + 1];
    if (by_order) {
        fvi_gl_weights_by_order(nu, FVI_WINDOW + 1, w);
        open_window(w, e->slopes, e->rates + e->Q);
    }
    fvi_gl_weights(nu, FVI_WINDOW + 1, w);
    fvi_history_modes_rule(g, nu, lags(steps), e->p, e->c, by_order ? e->rates : NULL);
    return finish(e, w, d);
}

fvi_history_head *fvi_history_modes_of(size_t Q, const double *s, const double *c,
                                       const double *w, size_t d)
{
    modes_engine *e = make(padded(Q), 0, tiled(0, d) ? 0 : d);
    if (!e)
        return NULL;
    memcpy(e->p, s, Q * sizeof *s);
    memcpy(e->c, c, Q * sizeof *c);
    return finish(e, w, d);
}

/* The nodes depend on N, and must be the same. The sums by the order end the piece. */
static int archive(fvi_history_head *head, fvi_archive *v)
{
    modes_engine *e = (modes_engine *)head;
    const size_t sums = padded(PAIR * head->d);
    const int status = FVI_SERIALIZE(v, FVI_CONSTANT(e->Q), FVI_CONSTANTS(e->p, 2 * e->Q),
                                     FVI_STATES(e->z, head->d * (e->Q + 2 * FVI_WINDOW) + sums));
    return status || !e->by_order ? status : FVI_SERIALIZE(v, FVI_STATES(further(e), sums));
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
WITHIN void sweep(const modes_engine *e, double *modes, double *past,
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

FVI_VECTORS static void advance(const modes_engine *e, double *modes,
                                double *past, double new, double *far)
{
    sweep(e, modes, past, new, 0, far, NULL);
}

FVI_VECTORS static void advance_rated(const modes_engine *e, double *modes,
                                      double *past, double new, double *far,
                                      double *slope)
{
    sweep(e, modes, past, new, 1, far, slope);
}

//> push
/* Term k of coordinate i comes in. */
WITHIN void push_one(const modes_engine *e, size_t i, size_t k, double new,
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

/* The same of all coordinates, in one call for the vectors. */
FVI_VECTORS static void advance_each(const modes_engine *e, size_t k, const double *term, double *H)
{
    for (size_t i = 0; i < e->head.d; i++) {
        const double new = term[i];
        double *past = e->past + i * 2 * FVI_WINDOW + k % FVI_WINDOW, *far = e->far + PAIR * i;
        H[i] = new + far[1];
        sweep(e, e->z + i * e->Q, past - 1, new, 0, far, NULL);
    }
}

/* Apart: whoever has one coordinate saves no register for it. */
__attribute__((noinline)) static void push_each(modes_engine *e, const double *term, double *H)
{
    if (e->head.k % PAIR != 0)
        advance_each(e, e->head.k, term, H);
    else
        for (size_t i = 0; i < e->head.d; i++)
            push_one(e, i, e->head.k, term[i], H + i);
}

static void push(fvi_history_head *head, const double *term, double *H)
{
    modes_engine *e = (modes_engine *)head;
    if (head->d == 1) /* no loop has to find out that it runs once */
        push_one(e, 0, head->k, *term, H);
    else
        push_each(e, term, H);
}

//> push-rate
static void push_by_order(fvi_history_head *head, const double *term, double *H,
                          double *rate)
{
    modes_engine *e = (modes_engine *)head;
    const size_t at = head->k % FVI_WINDOW, now = head->k % PAIR;
    for (size_t i = 0; i < head->d; i++) {
        double new = term[i], *past = e->past + i * 2 * FVI_WINDOW + at;
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

static void ahead(const fvi_history_head *head, double *sum)
{
    const modes_engine *e = (const modes_engine *)head;
    for (size_t i = 0; i < head->d; i++)
        sum[i] += e->far[PAIR * i + head->k % PAIR];
}

static const fvi_history_engine engine = { .place = place,
                                           .push = push,
                                           .push_by_order = push_by_order,
                                           .ahead = ahead,
                                           .archive = archive };
