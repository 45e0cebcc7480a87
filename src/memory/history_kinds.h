/* src/memory/history_kinds.h -- The ways to sum behind memory.h.        [H 12]
 *
 * Internal: memory.c chooses one and checks the arguments; nothing is checked
 * here. The order nu is in (0, 1), the weights are w_n = (-1)^n binom(nu, n). Each
 * way is an engine. */
#ifndef FVI_HISTORY_KINDS_H
#define FVI_HISTORY_KINDS_H

#include <fvi/archive.h>
#include "system/fail.h"
#include "system/vectors.h" /* FVI_VECTORS */

#include <stddef.h>
#include <stdint.h>

/* A count that was read must be the one that the run has: of the places that it decides, those of
 * another count may be out of the arrays. */
static inline int fvi_check_count(size_t written, size_t k)
{
    if (written != k)
        FVI_FAIL("the terms of a memory are not as many as its steps",
                 FVI_EINVAL);
    return FVI_SUCCESS;
}

/* ---- an engine ---- */

typedef struct fvi_history_engine fvi_history_engine;

/* With what every engine begins. It is one piece of memory, constant tables and state, and only
 * `place` knows the addresses in it: a copy is a copy of the bytes, then placed; free frees it. */
typedef struct {
    const fvi_history_engine *is;
    size_t bytes; /* of the piece, a multiple of 64 */
    size_t d, k;  /* d numbers come in with a term; so many terms have. memory.c counts them */
} fvi_history_head;

/* What an engine does with term k, from 0.
 *
 *   place          finds its arrays again, after a copy
 *   push           takes the d numbers of the term, and writes d sums, which may be in their place
 *   push_by_order  the same, and their derivatives by the order to rate, if it was made so
 *   push_part      the same of `count` coordinates from `first` on (history_parts.h); NULL: it
 *                  takes them together
 *   ahead          adds to sum the sums to come next, their first terms left out
 *   archive        shows what is constant and the state after k terms */
struct fvi_history_engine {
    void (*place)(fvi_history_head *m);
    void (*push)(fvi_history_head *m, const double *term, double *H);
    void (*push_by_order)(fvi_history_head *m, const double *term, double *H,
                          double *rate);
    void (*push_part)(fvi_history_head *m, size_t first, size_t count,
                      const double *term, double *H);
    void (*ahead)(const fvi_history_head *m, double *sum);
    int (*archive)(fvi_history_head *m, fvi_archive *v);
};

/* fvi_history_take -- a term comes in. */
static inline void fvi_history_take(fvi_history_head *m, const double *term, double *H)
{
    m->is->push(m, term, H);
    m->k++;
}

/* fvi_history_piece -- how many bytes an engine of so many has, with n numbers behind them; SIZE_MAX
 * if they cannot be addressed.
 * fvi_history_make -- zeros of the size of `of`, with its head; not yet placed. NULL if there is no
 * memory. */
size_t fvi_history_piece(size_t bytes, size_t n);
void *fvi_history_make(fvi_history_head of);

/* ---- the sum as it stands (history_direct.c) ---- */

size_t fvi_history_direct_bytes(size_t d, size_t steps);
/* `by_order`: nonzero for an engine whose push_by_order can be called; 0 <= nu <= 1 then. */
fvi_history_head *fvi_history_direct_alloc(double nu, int by_order, size_t d, size_t steps);
/* Of the weights 1, w_1, ..., w_steps of another's making, whose last digits depend on `steps` or not: a longer run
 * can go on from a state only if they are the same. */
fvi_history_head *fvi_history_direct_of(size_t d, size_t steps, const double *weights,
                                        int depend_on_steps);

/* ---- a window and decaying exponentials (history_modes.c, memory_nodes.c) ---- */

enum {
    FVI_WINDOW = 32, /* lags 1 ... 32 are summed with their own weights */
    FVI_TAIL = 33    /* from here on the weights are sums of exponentials */
};

/* Beyond this many steps, or below this tolerance, rounding and not the nodes
 * would decide. */
#define FVI_LONGEST 1000000000
#define FVI_LEAST_TOLERANCE 1e-14

/* fvi_history_modes_nodes -- the sum of exponentials.           [(12.6), (12.7)]
 *
 *     |w_n - sum_q c_q exp(-n s_q)| <= delta |w_n|,   FVI_TAIL <= n <= N
 *
 *   nu     0 < nu < 1
 *   N      the longest lag, 128 <= N <= FVI_LONGEST
 *   delta  relative error of a weight, 1e-15 <= delta <= 1/50
 *   s, c   outputs, both NULL or Q numbers each: 0 < s_0 < s_1 < ..., c_q <= 0
 *   rate   NULL, or output: dc_q/d nu, the s_q being held, so that the sum of
 *          rate_q exp(-n s_q) is d w_n/d nu; 0 <= nu <= 1 then           [(23.11)]
 *
 * Returns Q, about (ln(N/33) + ln(1/delta) ...)/h: see (12.7). */
size_t fvi_history_modes_nodes(double nu, double N, double delta, double *s,
                              double *c, double *rate);

/* Where those nodes are: at s = exp(t - exp(-t)) / N, t = left + q step, q = 0, ..., Q - 1.
 *                                                             [(12.9), (12.10)] */
typedef struct {
    double left, step;
    size_t Q;
} fvi_node_range;

/* fvi_node_range_of -- for sums of powers s^nu to s^most, -1 < nu <= most < 1, or what is analytic in a
 * strip narrower than theirs by the factor `strip` (26.6). The lowest order decides where the nodes
 * begin, the highest where they end. order: 1 + nu, which next to nu = -1 has digits that nu has
 * lost. */
fvi_node_range fvi_node_range_of(double nu, double order, double most, double N, double delta,
                                 double strip);

/* fvi_history_modes_rule -- the sum at the nodes of a grid: s, c and rate as above, of
 * which rate alone may be NULL. */
void fvi_history_modes_rule(const fvi_node_range *g, double nu, double N, double *s,
                           double *c, double *rate);

/* delta of (12.6) for a run: see (12.11). */
double fvi_history_modes_delta(size_t steps, double tolerance);

/* The nodes of a run, which the next two want. */
fvi_node_range fvi_history_modes_plan(double nu, size_t steps, double delta);

/* `by_order` as above. From 16 coordinates on, and not by_order, it is an engine that goes by
 * tiles (history_tiled.h). */
size_t fvi_history_modes_bytes(const fvi_node_range *g, int by_order, size_t d);
fvi_history_head *fvi_history_modes_alloc(const fvi_node_range *g, double nu,
                                          int by_order, size_t d, size_t steps);
/* Modes and the weights 1, w_1, ..., w_32 of another's making. */
fvi_history_head *fvi_history_modes_of(size_t Q, const double *s, const double *c,
                                       const double *w, size_t d);

/* ---- a memory with weights of another's making (memory.c) ---- */

struct fvi_history;

/* fvi_history_of_engine -- takes over the engine, which may be NULL, where there was no memory for
 * it; it is freed if this fails.
 *
 *   increments  nonzero if push shall sum dx, not x
 *
 * Returns FVI_SUCCESS or FVI_ENOMEM. */
int fvi_history_of_engine(int increments, size_t steps, fvi_history_head *engine,
                          struct fvi_history **memory);

#endif
