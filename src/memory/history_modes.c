/* src/memory/history_modes.c -- Compute the history by a window of recent terms and decaying modes.     [H 12]
 *
 * The sum of term k has three parts:
 *
 *     H_k = x_k  +  sum_{n=1}^{32} w_n x_{k-n}  +  sum_q c_q z_q
 *
 * The middle part is the window. A mode z_q holds all older terms. In each step it loses the part p_q of itself and
 * takes in the term that leaves the window, (12.12).
 *
 * Terms are taken in pairs. After an odd term the modes take two steps at once, and the next two sums are computed but
 * for the terms that are still to come. So an even term k needs no modes, and the processor can work on them while the
 * caller computes the next term. */
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
    size_t Q;                   /* number of modes, rounded up to a multiple of LANES */
    int by_order;               /* nonzero if the engine has push_by_order */
    double weights[PAIR];       /* w_1 and w_2 */
    double weight_slopes[PAIR]; /* if by_order: their derivatives by the order */
    double *p, *c;              /* Q numbers each: z += x - p z, and the mode adds c z to the sum */
    double *window;             /* 32 numbers: 0, 0, w_32, w_31, ..., w_3 */
    double *z;                  /* the modes, Q numbers for each coordinate */
    double *ring;               /* for each coordinate: the last 32 terms, term k at [k % 32] and [k % 32 + 32] */
    double *ahead;              /* for each coordinate: the sums of the next even and of the next odd term, see below */
    double *c_slopes;           /* if by_order: dc/dnu, Q numbers */
    double *window_slopes;      /* if by_order: the derivatives of the window, 32 numbers */
    double *ahead_slopes;       /* if by_order: the derivatives of `ahead` */
    _Alignas(64) double numbers[]; /* all these arrays, in this order */
} modes_engine;

/* ahead[0] and ahead[1] of a coordinate are the parts of an even and of an odd sum that are known by now:
 *
 *     after an odd term k    ahead[0] = H_{k+1} without x_{k+1},   ahead[1] = H_{k+2} without x_{k+2} and w_1 x_{k+1}
 *     after an even term k   ahead[1] = H_{k+1} without x_{k+1} */

/* Return 1 if the tiled engine is used. It cannot give derivatives by the order, because they are read from modes that
 * are up to date after each step. */
static int is_tiled(int by_order, size_t d)
{
    return !by_order && d >= FVI_TILES_FROM;
}

/* Return n, rounded up to a multiple of LANES. */
static size_t padded(size_t n)
{
    return (n + LANES - 1) / LANES * LANES;
}

/* Return the longest lag for which the modes are made: the number of steps, but at least 128. */
static double longest_lag(size_t steps)
{
    return fmax((double)steps, 128);
}

/* Return the size of the array `numbers`, a multiple of LANES. */
static size_t count_numbers(size_t Q, int by_order, size_t d)
{
    return 2 * Q + FVI_WINDOW + d * (Q + 2 * FVI_WINDOW) + padded(PAIR * d)
           + (by_order ? Q + FVI_WINDOW + padded(PAIR * d) : 0);
}

fvi_node_range fvi_history_modes_plan(double nu, size_t steps, double delta)
{
    return fvi_node_range_of(nu, 1 + nu, nu, longest_lag(steps), delta, 1);
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
    e->ring = e->z + head->d * e->Q;
    e->ahead = e->ring + head->d * 2 * FVI_WINDOW;
    e->c_slopes = e->ahead + padded(PAIR * head->d);
    e->window_slopes = e->c_slopes + e->Q;
    e->ahead_slopes = e->window_slopes + FVI_WINDOW;
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

/* Split w_1, ..., w_32, or their derivatives, into the weights of the two newest terms and the window of the
 * older terms. */
static void split_weights(const double *w, double *newest, double *window)
{
    memcpy(newest, w + 1, PAIR * sizeof *w);
    for (size_t n = PAIR + 1; n <= FVI_WINDOW; n++)
        window[FVI_WINDOW + PAIR - n] = w[n];
}

/* On entry p holds the rates s of the modes, and c their factors in c exp(-n s). Replace s by p = 1 - exp(-s), the part
 * that a mode loses in a step, and let c begin with lag 33, where the modes begin. The padding has c = 0. */
static void convert_rates(modes_engine *e)
{
    for (size_t q = 0; q < e->Q; q++) {
        const double tail = exp(-FVI_TAIL * e->p[q]);
        e->c[q] *= tail;
        if (e->by_order)
            e->c_slopes[q] *= tail;
        e->p[q] = -expm1(-e->p[q]);
    }
}

/* Complete an engine whose p and c hold rates and factors. If the engine was made for 0 coordinates, its place is taken
 * by a tiled engine for d coordinates. w has 1, w_1, ..., w_32. Return NULL if memory is short. */
static fvi_history_head *complete_engine(modes_engine *e, const double *w, size_t d)
{
    convert_rates(e);
    if (e->head.d == d) {
        split_weights(w, e->weights, e->window);
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
        split_weights(w, e->weight_slopes, e->window_slopes);
    }
    fvi_gl_weights(nu, FVI_WINDOW + 1, w);
    fvi_history_modes_rule(g, nu, longest_lag(steps), e->p, e->c, by_order ? e->c_slopes : NULL);
    return complete_engine(e, w, d);
}

fvi_history_head *fvi_history_modes_of(size_t Q, const double *s, const double *c,
                                       const double *w, size_t d)
{
    modes_engine *e = make_engine(padded(Q), 0, is_tiled(0, d) ? 0 : d);
    if (!e)
        return NULL;
    for (size_t q = 0; q < Q; q++) {
        e->p[q] = s[q];
        e->c[q] = c[q];
    }
    return complete_engine(e, w, d);
}

/* The modes depend on the number of steps, so p and c are archived as constants, which must be equal. z, ring and ahead
 * are the state; they stand one behind another. */
static int archive(fvi_history_head *head, fvi_archive *v)
{
    modes_engine *e = (modes_engine *)head;
    const size_t sums = padded(PAIR * head->d);
    const int status = FVI_SERIALIZE(v, FVI_CONSTANT(e->Q), FVI_CONSTANTS(e->p, 2 * e->Q),
                                     FVI_STATES(e->z, head->d * (e->Q + 2 * FVI_WINDOW) + sums));
    return status || !e->by_order ? status : FVI_SERIALIZE(v, FVI_STATES(e->ahead_slopes, sums));
}

/* ---- the sums ---- */

/* Four doubles; two such vectors are LANES doubles. The compiler makes of them what the processor has. */
typedef double four
    __attribute__((vector_size(4 * sizeof(double)), aligned(8), may_alias));

#define INLINED static inline __attribute__((always_inline))

/* Return the sum of the eight numbers of v[0] and v[1]. */
INLINED double sum_lanes(const four *v)
{
    const four u = v[0] + v[1];
    return (u[0] + u[2]) + (u[1] + u[3]);
}

/* Store a term at its place in the ring, instead of the oldest term. */
INLINED void store_term(double *place, double new)
{
    place[0] = place[FVI_WINDOW] = new;
}

/* Take in an odd term k, `new`: let all modes of a coordinate take two steps, and compute `ahead` for the next
 * two terms.
 *
 *   past  the place of term k - 1 in the ring. So past[1], ..., past[32] are the terms k - 32, ..., k - 1
 *
 * The sum of term k + 1 has the modes after the first step, which takes in the term k - 32. The sum of term k + 2 has
 * the modes after the second step, which takes in the term k - 31. Every eighth product goes into the same partial sum.
 * This order is the same on every machine, so vectors of 2 or 4 doubles change the time and no digit. The two newest
 * terms are not in the vectors, so no vector waits for them. */
INLINED void sweep_modes(const modes_engine *e, double *modes, double *past, double new, int by_order, double *ahead,
                        double *slopes)
{
    const four *p = (four *)e->p, *c = (four *)e->c, *c_slopes = (four *)e->c_slopes;
    const four *w = (four *)e->window, *w_slopes = (four *)e->window_slopes;
    four *z = (four *)modes, sum[PAIR][2] = { 0 }, rate[PAIR][2] = { 0 }; /* for each step; rate: derivatives */
    const four zero = { 0 }, x[] = { zero + past[1], zero + past[2] };
    //> modes
    for (size_t q = 0, fours = e->Q / 4; q < fours; q += 2) {
        four now[] = { z[q], z[q + 1] };
#pragma GCC unroll 2
        for (size_t n = 0; n < PAIR; n++)
#pragma GCC unroll 2
            for (size_t l = 0; l < 2; l++) {
                now[l] += x[n] - p[q + l] * now[l]; /* (12.12) */
                sum[n][l] += c[q + l] * now[l];
                if (by_order)
                    rate[n][l] += c_slopes[q + l] * now[l];
            }
        z[q] = now[0];
        z[q + 1] = now[1];
    }
    //< modes
#pragma GCC unroll 4
    for (size_t j = 0; j < FVI_WINDOW / 4; j += 2)
#pragma GCC unroll 2
        for (size_t n = 0; n < PAIR; n++) /* the window moves by a term; its first two weights are 0 */
#pragma GCC unroll 2
            for (size_t l = 0; l < 2; l++) {
                const four terms = *(const four *)(past + n + 4 * (j + l));
                sum[n][l] += w[j + l] * terms;
                if (by_order)
                    rate[n][l] += w_slopes[j + l] * terms;
            }
    ahead[0] = sum_lanes(sum[0]) + e->weights[1] * past[0] + e->weights[0] * new;
    ahead[1] = sum_lanes(sum[1]) + e->weights[1] * new;
    if (by_order) {
        slopes[0] = sum_lanes(rate[0]) + e->weight_slopes[1] * past[0] + e->weight_slopes[0] * new;
        slopes[1] = sum_lanes(rate[1]) + e->weight_slopes[1] * new;
    }
    store_term(past + 1, new);
}

FVI_VECTORS static void sweep_coordinate(const modes_engine *e, double *modes, double *past, double new,
                                         double *ahead)
{
    sweep_modes(e, modes, past, new, 0, ahead, NULL);
}

FVI_VECTORS static void sweep_coordinate_by_order(const modes_engine *e, double *modes, double *past, double new,
                                                  double *ahead, double *slopes)
{
    sweep_modes(e, modes, past, new, 1, ahead, slopes);
}

//> push
/* Take in term k of coordinate i. */
INLINED void push_coordinate(const modes_engine *e, size_t i, size_t k, double new, double *H)
{
    double *place = e->ring + i * 2 * FVI_WINDOW + k % FVI_WINDOW;
    double *ahead = e->ahead + PAIR * i;
    *H = new + ahead[k % PAIR];
    if (k % PAIR == 0) {
        ahead[1] += e->weights[0] * new;
        store_term(place, new);
    } else
        sweep_coordinate(e, e->z + i * e->Q, place - 1, new, ahead);
}
//< push

/* Take in an odd term k of all coordinates in one call, so that the versions for wide vectors are selected once. */
FVI_VECTORS static void sweep_coordinates(const modes_engine *e, size_t k, const double *term, double *H)
{
    for (size_t i = 0; i < e->head.d; i++) {
        const double new = term[i]; /* term may be H */
        double *place = e->ring + i * 2 * FVI_WINDOW + k % FVI_WINDOW, *ahead = e->ahead + PAIR * i;
        H[i] = new + ahead[1];
        sweep_modes(e, e->z + i * e->Q, place - 1, new, 0, ahead, NULL);
    }
}

/* Take in a term of several coordinates. If this function were inlined, a push of one coordinate would save registers
 * for it. */
__attribute__((noinline)) static void push_coordinates(modes_engine *e, const double *term, double *H)
{
    if (e->head.k % PAIR != 0)
        sweep_coordinates(e, e->head.k, term, H);
    else
        for (size_t i = 0; i < e->head.d; i++)
            push_coordinate(e, i, e->head.k, term[i], H + i);
}

static void push(fvi_history_head *head, const double *term, double *H)
{
    modes_engine *e = (modes_engine *)head;
    if (head->d == 1) /* one coordinate needs no loop */
        push_coordinate(e, 0, head->k, *term, H);
    else
        push_coordinates(e, term, H);
}

//> push-rate
static void push_by_order(fvi_history_head *head, const double *term, double *H, double *rate)
{
    modes_engine *e = (modes_engine *)head;
    const size_t parity = head->k % PAIR;
    for (size_t i = 0; i < head->d; i++) {
        const double new = term[i]; /* term may be H */
        double *place = e->ring + i * 2 * FVI_WINDOW + head->k % FVI_WINDOW;
        double *ahead = e->ahead + PAIR * i, *slopes = e->ahead_slopes + PAIR * i;
        H[i] = new + ahead[parity];
        rate[i] = slopes[parity];
        if (parity == 0) {
            ahead[1] += e->weights[0] * new;
            slopes[1] += e->weight_slopes[0] * new;
            store_term(place, new);
        } else
            sweep_coordinate_by_order(e, e->z + i * e->Q, place - 1, new, ahead, slopes);
    }
}
//< push-rate

static void add_sums_ahead(const fvi_history_head *head, double *sum)
{
    const modes_engine *e = (const modes_engine *)head;
    for (size_t i = 0; i < head->d; i++)
        sum[i] += e->ahead[PAIR * i + head->k % PAIR];
}

static const fvi_history_engine engine = { .place = set_array_pointers,
                                           .push = push,
                                           .push_by_order = push_by_order,
                                           .ahead = add_sums_ahead,
                                           .archive = archive };
