/* src/memory/history_modes.c -- Compute the history by a window of recent terms and decaying modes.     [H 12] */
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
    PAIR = 2   /* number of steps that are computed together */
};

typedef struct {
    fvi_history_head head;
    size_t Q;            /* number of modes, rounded up to a multiple of LANES */
    int by_order;
    double near[PAIR];   /* w_1 and w_2; w_0 is 1 */
    double slopes[PAIR]; /* derivatives of w_1 and w_2 by the order */
    double *p, *c;       /* Q numbers each: z += x - p z, and the mode adds c z to the sum */
    double *window;      /* 0, 0, w_32, w_31, ..., w_3 */
    double *z;           /* Q modes for each coordinate */
    double *past;        /* a ring of the last 32 terms of each coordinate, stored twice */
    double *far;         /* for each coordinate, the parts of the next two sums with lags >= 1 */
    /* only if by_order: dc/dnu, Q numbers; the derivatives of the window; and for each coordinate the derivatives of
     * the next two sums, as in far */
    double *rates;
    _Alignas(64) double numbers[];
} modes_engine;

/* Return 1 if the tiled engine is used. It cannot give derivatives by the order, because they are read from modes that
 * are up to date after each step. */
static int is_tiled(int by_order, size_t d)
{
    return !by_order && d >= FVI_TILES_FROM;
}

static size_t padded(size_t Q)
{
    return (Q + LANES - 1) / LANES * LANES;
}

/* The nodes are made for the number of steps, but for at least 128 lags. */
static double count_lags(size_t steps)
{
    return fmax((double)steps, 128);
}

static size_t count_numbers(size_t Q, int by_order, size_t d) /* The result is a multiple of 8. */
{
    return 2 * Q + FVI_WINDOW + d * (Q + 2 * FVI_WINDOW) + padded(PAIR * d)
           + (by_order ? Q + FVI_WINDOW + padded(PAIR * d) : 0);
}

fvi_node_range fvi_history_modes_plan(double nu, size_t steps, double delta)
{
    return fvi_node_range_of(nu, 1 + nu, nu, count_lags(steps), delta, 1);
}

size_t fvi_history_modes_bytes(const fvi_node_range *g, int by_order, size_t d)
{
    const size_t Q = padded(g->Q);
    if (d > SIZE_MAX / sizeof(double) / 2 / (Q + 2 * FVI_WINDOW))
        return SIZE_MAX;
    return is_tiled(by_order, d)
               ? fvi_history_tiled_bytes(d, Q)
               : fvi_history_piece(sizeof(modes_engine), count_numbers(Q, by_order, d));
}

static void set_array_pointers(fvi_history_head *head)
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

/* Allocate an engine at rest. Return NULL if memory is short. */
static modes_engine *make_engine(size_t Q, int by_order, size_t d)
{
    modes_engine *e = fvi_history_make((fvi_history_head){
        .is = &engine,
        .bytes = fvi_history_piece(sizeof *e, count_numbers(Q, by_order, d)),
        .d = d });
    if (!e)
        return NULL;
    e->Q = Q;
    e->by_order = by_order;
    set_array_pointers(&e->head);
    return e;
}

/* Return the derivatives of the next two sums. The engine was made by_order. */
static double *next_sum_derivatives(const modes_engine *e)
{
    return e->rates + e->Q + FVI_WINDOW;
}

/* Split w_1, ..., w_32, or their derivatives, into the weights of the two newest terms and the
 * window of the older terms. */
static void open_window(const double *w, double *near, double *window)
{
    memcpy(near, w + 1, PAIR * sizeof *w);
    for (size_t n = PAIR + 1; n <= FVI_WINDOW; n++)
        window[FVI_WINDOW + PAIR - n] = w[n];
}

/* Replace s in p by 1 - exp(-s), the part that a mode loses in a step, and scale c to lag 33. The padding has c = 0. */
static void set_decays(modes_engine *e)
{
    for (size_t q = 0; q < e->Q; q++) {
        const double tail = exp(-FVI_TAIL * e->p[q]);
        e->c[q] *= tail;
        if (e->by_order)
            e->rates[q] *= tail;
        e->p[q] = -expm1(-e->p[q]);
    }
}

/* Return the engine for d coordinates. This is e, or a tiled engine if e was made for 0 coordinates. */
static fvi_history_head *finish_sums(modes_engine *e, const double *w, size_t d)
{
    set_decays(e);
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
    modes_engine *e = make_engine(padded(g->Q), by_order, is_tiled(by_order, d) ? 0 : d);
    if (!e)
        return NULL;
    double w[FVI_WINDOW + 1];
    if (by_order) {
        fvi_gl_weights_by_order(nu, FVI_WINDOW + 1, w);
        open_window(w, e->slopes, e->rates + e->Q);
    }
    fvi_gl_weights(nu, FVI_WINDOW + 1, w);
    fvi_history_modes_rule(g, nu, count_lags(steps), e->p, e->c, by_order ? e->rates : NULL);
    return finish_sums(e, w, d);
}

fvi_history_head *fvi_history_modes_of(size_t Q, const double *s, const double *c,
                                       const double *w, size_t d)
{
    modes_engine *e = make_engine(padded(Q), 0, is_tiled(0, d) ? 0 : d);
    if (!e)
        return NULL;
    memcpy(e->p, s, Q * sizeof *s);
    memcpy(e->c, c, Q * sizeof *c);
    return finish_sums(e, w, d);
}

/* The nodes depend on the number of steps, so they are archived as constants that must be equal. The sums of the
 * derivatives stand at the end of the block. */
static int archive(fvi_history_head *head, fvi_archive *v)
{
    modes_engine *e = (modes_engine *)head;
    const size_t sums = padded(PAIR * head->d);
    const int status = FVI_SERIALIZE(v, FVI_CONSTANT(e->Q), FVI_CONSTANTS(e->p, 2 * e->Q),
                                     FVI_STATES(e->z, head->d * (e->Q + 2 * FVI_WINDOW) + sums));
    return status || !e->by_order ? status : FVI_SERIALIZE(v, FVI_STATES(next_sum_derivatives(e), sums));
}

typedef double four
    __attribute__((vector_size(4 * sizeof(double)), aligned(8), may_alias));

#define WITHIN static inline __attribute__((always_inline))

/* Return the sum of the eight numbers of v[0] and v[1]. */
WITHIN double sum_lanes(const four *v)
{
    const four u = v[0] + v[1];
    return (u[0] + u[2]) + (u[1] + u[3]);
}

/* Store a term in the ring, in place of the oldest term. */
WITHIN void store_term(double *past, double new)
{
    past[0] = past[FVI_WINDOW] = new;
}

/* Advance all modes of a coordinate by two steps, with the terms at past[1] and past[2], which leave the window, and
 * compute the next two sums. These sums are over the modes after each step, the window, and the two newest terms,
 * past[0] and `new`. Partial sum l takes every eighth product, from the l-th one on. This order is the same on every
 * machine, so vectors of 2 or 4 doubles change the time and no digit. The two newest terms are not in the vectors, so
 * no vector waits for them. */
WITHIN void sweep_modes(const modes_engine *e, double *modes, double *past,
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
    far[0] = sum_lanes(sum[0]) + e->near[1] * past[0] + e->near[0] * new;
    far[1] = sum_lanes(sum[1]) + e->near[1] * new;
    if (by_order) {
        slope[0] =
            sum_lanes(rate[0]) + e->slopes[1] * past[0] + e->slopes[0] * new;
        slope[1] = sum_lanes(rate[1]) + e->slopes[1] * new;
    }
    store_term(past + 1, new);
}

FVI_VECTORS static void advance(const modes_engine *e, double *modes,
                                double *past, double new, double *far)
{
    sweep_modes(e, modes, past, new, 0, far, NULL);
}

FVI_VECTORS static void advance_rated(const modes_engine *e, double *modes,
                                      double *past, double new, double *far,
                                      double *slope)
{
    sweep_modes(e, modes, past, new, 1, far, slope);
}

//> push
/* Take in term k of coordinate i. */
WITHIN void push_one(const modes_engine *e, size_t i, size_t k, double new,
                     double *H)
{
    double *past = e->past + i * 2 * FVI_WINDOW + k % FVI_WINDOW;
    double *far = e->far + PAIR * i;
    *H = new + far[k % PAIR];
    if (k % PAIR == 0) {
        far[1] += e->near[0] * new;
        store_term(past, new);
    } else
        advance(e, e->z + i * e->Q, past - 1, new, far);
}
//< push

/* Take in a term of all coordinates in one call, so that the versions for wide vectors are selected once. */
FVI_VECTORS static void advance_each(const modes_engine *e, size_t k, const double *term, double *H)
{
    for (size_t i = 0; i < e->head.d; i++) {
        const double new = term[i];
        double *past = e->past + i * 2 * FVI_WINDOW + k % FVI_WINDOW, *far = e->far + PAIR * i;
        H[i] = new + far[1];
        sweep_modes(e, e->z + i * e->Q, past - 1, new, 0, far, NULL);
    }
}

/* The function is not inlined, so that the path of one coordinate need not save registers for it. */
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
    if (head->d == 1) /* one coordinate needs no loop */
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
        double *far = e->far + PAIR * i, *slope = next_sum_derivatives(e) + PAIR * i;
        H[i] = new + far[now];
        rate[i] = slope[now];
        if (now == 0) {
            far[1] += e->near[0] * new;
            slope[1] += e->slopes[0] * new;
            store_term(past, new);
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

static const fvi_history_engine engine = { .place = set_array_pointers,
                                           .push = push,
                                           .push_by_order = push_by_order,
                                           .ahead = ahead,
                                           .archive = archive };
