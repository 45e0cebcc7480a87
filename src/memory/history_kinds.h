/* src/memory/history_kinds.h -- The engines that compute the sum of memory.h.        [H 12]
 *
 * This header is internal. memory.c chooses an engine and checks the arguments; the functions here check nothing. The
 * order nu is in (0, 1), and the weights are w_n = (-1)^n binom(nu, n). */
#ifndef FVI_HISTORY_KINDS_H
#define FVI_HISTORY_KINDS_H

#include <fvi/archive.h>
#include "system/fail.h"
#include "system/vectors.h" /* FVI_VECTORS */

#include <stddef.h>
#include <stdint.h>

/* fvi_check_count -- Test that a count read from an archive is the count of the run. A wrong count could lead to
 * positions outside the arrays. Return FVI_SUCCESS or FVI_EINVAL. */
static inline int fvi_check_count(size_t written, size_t k)
{
    if (written != k)
        FVI_FAIL("the terms of a memory are not as many as its steps",
                 FVI_EINVAL);
    return FVI_SUCCESS;
}

/* ---- an engine ---- */

typedef struct fvi_history_engine fvi_history_engine;

/* fvi_history_head -- The first part of every engine. An engine is one block of memory with constant tables and state.
 * Only its function `place` knows the addresses within the block. So a copy is a copy of the bytes followed by `place`,
 * and free() frees an engine. */
typedef struct {
    const fvi_history_engine *is;
    size_t bytes; /* size of the block, a multiple of 64 */
    size_t d, k;  /* d numbers in each term; k terms so far, counted by the caller of the engine */
} fvi_history_head;

/* fvi_history_engine -- The functions of an engine. k counts the terms from 0.
 *
 *   place          sets the pointers to the arrays of the block, after a copy
 *   push           takes in the d numbers of term k and writes the d sums to H, which may be the array of the term
 *   push_by_order  does the same and writes the derivatives of the sums by the order to rate; only for an engine that
 *                  was made by_order
 *   push_part      does the same as push for `count` coordinates, from coordinate `first` on (history_parts.h). NULL:
 *                  the engine takes in whole terms only
 *   ahead          adds to sum the next sums without their newest term
 *   archive        serialises the constant tables and the state after k terms */
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

/* fvi_history_take -- Push a term and count it. */
static inline void fvi_history_take(fvi_history_head *m, const double *term, double *H)
{
    m->is->push(m, term, H);
    m->k++;
}

/* fvi_history_piece -- Return the size in bytes of a structure of `bytes` bytes with n doubles behind it, rounded up to
 * a multiple of 64. Return SIZE_MAX if the size cannot be addressed.
 * fvi_history_make -- Allocate of.bytes bytes, set them to zero, and copy the head `of` to their start. The caller
 * calls `place`. Return NULL if memory is short. */
size_t fvi_history_piece(size_t bytes, size_t n);
void *fvi_history_make(fvi_history_head of);

/* fvi_multiply_by_bdf2_factor -- Multiply a power series with the coefficients w_0, ..., w_{count-1} by
 * ((3 - z)/2)^beta, 0 <= beta <= 2 (convolution_quadrature.c). [(13.11)] */
void fvi_multiply_by_bdf2_factor(double beta, size_t count, double *w);

/* ---- the direct sum (history_direct.c) ---- */

size_t fvi_history_direct_bytes(size_t d, size_t steps);
/* fvi_history_direct_alloc -- Allocate an engine for the weights of order nu, or return NULL if memory is short.
 * by_order: nonzero for an engine with push_by_order; then 0 <= nu <= 1 is allowed. fvi_history_direct_bytes is its
 * size without push_by_order. */
fvi_history_head *fvi_history_direct_alloc(double nu, int by_order, size_t d, size_t steps);
/* fvi_history_direct_of -- Allocate an engine for the weights 1, w_1, ..., w_steps of the caller. depend_on_steps:
 * nonzero if the last digits of the weights depend on `steps`. Then a longer run can go on from an archived state only
 * if its weights are the same. */
fvi_history_head *fvi_history_direct_of(size_t d, size_t steps, const double *weights,
                                        int depend_on_steps);

/* ---- a window and decaying exponentials (history_modes.c, memory_nodes.c) ---- */

enum {
    FVI_WINDOW = 32, /* the terms of lags 1, ..., 32 are multiplied by their own weights */
    FVI_TAIL = 33    /* from this lag on, the weights are sums of exponentials */
};

/* Limits of the compressed memory. With more steps or with a smaller tolerance, rounding errors would be larger than
 * the error of the nodes. */
#define FVI_LONGEST 1000000000
#define FVI_LEAST_TOLERANCE 1e-14

/* fvi_history_modes_nodes -- Approximate the weights by a sum of exponentials. [(12.6), (12.7)]
 *
 *     |w_n - sum_q c_q exp(-n s_q)| <= delta |w_n|,   FVI_TAIL <= n <= N
 *
 *   nu     0 < nu < 1
 *   N      longest lag, 128 <= N <= FVI_LONGEST
 *   delta  relative error of a weight, 1e-15 <= delta <= 1/50
 *   s, c   outputs, Q numbers each, with 0 < s_0 < s_1 < ... and c_q <= 0; or both NULL
 *   rate   NULL, or output: dc_q/dnu with the s_q held fixed, so that the sum of rate_q exp(-n s_q) is dw_n/dnu; then
 *          0 <= nu <= 1 is allowed [(23.11)]
 *
 * Return Q, about (ln(N/33) + ln(1/delta) ...)/h: see (12.7). */
size_t fvi_history_modes_nodes(double nu, double N, double delta, double *s,
                              double *c, double *rate);

/* fvi_node_range -- The positions of the nodes: s = exp(t - exp(-t)) / N with t = left + q step, q = 0, ...,
 * Q - 1. [(12.9), (12.10)] */
typedef struct {
    double left, step;
    size_t Q;
} fvi_node_range;

/* fvi_node_range_of -- Return the nodes for sums of the powers s^nu to s^most, -1 < nu <= most < 1. The lowest order
 * determines the first node, the highest order the last node.
 *
 *   order  1 + nu. It is a parameter of its own, because near nu = -1 the number nu has lost its last digits
 *   strip  1 for powers. A function that is analytic in a narrower strip than a power has finer nodes: strip is the
 *          width of its strip divided by the width of the strip of a power (26.6) */
fvi_node_range fvi_node_range_of(double nu, double order, double most, double N, double delta,
                                 double strip);

/* fvi_history_modes_rule -- Compute the sum of exponentials at the nodes g. The outputs s, c and rate are those of
 * fvi_history_modes_nodes; only rate may be NULL. */
void fvi_history_modes_rule(const fvi_node_range *g, double nu, double N, double *s,
                           double *c, double *rate);

/* fvi_history_modes_delta -- Return delta of (12.6) for a run: see (12.11). */
double fvi_history_modes_delta(size_t steps, double tolerance);

/* fvi_history_modes_plan -- Return the nodes of a run, for the two functions below. */
fvi_node_range fvi_history_modes_plan(double nu, size_t steps, double delta);

/* fvi_history_modes_alloc, fvi_history_modes_bytes -- Allocate an engine, and return its size in bytes. by_order:
 * nonzero for an engine with push_by_order. From 16 coordinates on, and if by_order is 0, the engine is a tiled engine
 * (history_tiled.h). */
size_t fvi_history_modes_bytes(const fvi_node_range *g, int by_order, size_t d);
fvi_history_head *fvi_history_modes_alloc(const fvi_node_range *g, double nu,
                                          int by_order, size_t d, size_t steps);
/* fvi_history_modes_of -- Allocate an engine for Q modes and the weights 1, w_1, ..., w_32 of the caller. */
fvi_history_head *fvi_history_modes_of(size_t Q, const double *s, const double *c,
                                       const double *w, size_t d);

/* ---- a history with the weights of the caller (memory.c) ---- */

struct fvi_history;

/* fvi_history_of_engine -- Make a history of an engine, and take over its ownership. The engine is freed if the
 * function fails. engine = NULL, from an allocation that failed, gives FVI_ENOMEM.
 *
 *   increments  nonzero if fvi_history_push must sum dx instead of x
 *
 * Return FVI_SUCCESS or FVI_ENOMEM. */
int fvi_history_of_engine(int increments, size_t steps, fvi_history_head *engine,
                          struct fvi_history **memory);

#endif
