/* src/stages/lobatto_weights.h -- Convolution quadrature on Lobatto nodes. [H 17]
 *
 *     Delta(z)^beta = sum_n W_n z^n,
 *     Delta(z) = (A + z/(1-z) 1 b^T)^(-1) = A^(-1) - (z/b_1) e_1 e_s^T   (17.5)
 *
 * with the s stages of the Lobatto IIIC method. W_n is an s x s matrix. */
#ifndef FVI_LOBATTO_WEIGHTS_H
#define FVI_LOBATTO_WEIGHTS_H

#include "kernel/kernel_terms.h"

#include <stddef.h>

enum { FVI_STAGES = 8 /* at most */, FVI_LAGS = 3 /* near ones */ };

/* The s Lobatto nodes c of [0, 1], their weights b, and D, which differentiates
 * the polynomial through s values at c, there.                          [(17.1)] */
typedef struct {
    double c[FVI_STAGES], b[FVI_STAGES], D[FVI_STAGES][FVI_STAGES];
} fvi_lobatto_rule;

/* fvi_lobatto -- the rule of s stages, s = 2, ..., 8; NULL for another s. */
const fvi_lobatto_rule *fvi_lobatto(size_t s);

/* fvi_lobatto_polynomial -- l_j(t), of degree s - 1: 1 at node j of the rule, 0 at the others. */
double fvi_lobatto_polynomial(const fvi_lobatto_rule *r, size_t s, size_t j,
                              double t);

/* fvi_lobatto_table -- A of Lobatto IIIC with s stages, the inverse of (17.3). */
void fvi_lobatto_table(const fvi_lobatto_rule *r, size_t s,
                       double A[FVI_STAGES][FVI_STAGES]);

/* fvi_lobatto_weights -- the matrices W_0, ..., W_{n-1}.      [(17.5), (17.10)]
 *
 *   s      stages, 2 to 8
 *   beta   -1 <= beta <= 1
 *   n      how many, n >= 1
 *   W      output, n s s numbers: entry (i, j) of W_k at [(k * s + i) * s + j]
 *
 * Step size is NOT included: multiply by h^(-beta). Cost 20 us, s = 4, and ten times
 * that the first time in a process; then O(n Q), Q about 100. Accuracy, in units of
 * 2^-53 max|W_0|: the first four matrices 1000 (no proof; seen 313), the others 100 (seen
 * 13).
 * Returns FVI_SUCCESS; FVI_EFAULT if W is NULL; FVI_EINVAL if s is not in
 * 2, ..., 8 or n is 0 or too large to be addressed; FVI_EDOM if beta is out of range;
 * FVI_ENOMEM. On error W is untouched. */
int fvi_lobatto_weights(size_t s, double beta, size_t n, double *W);

/* fvi_lobatto_weights_by_order -- W_0, ..., W_{n-1}, and their derivatives by beta.  [(23.14)]
 *
 *   s, beta, n, W  as above
 *   rate           output, as W; NULL: not wanted
 *
 * Cost and errors as above. Accuracy of the rates, in units of 2^-53 of the largest: the
 * first four 2000 (no proof; seen 240), the others 1000 (seen 52). */
int fvi_lobatto_weights_by_order(size_t s, double beta, size_t n, double *W,
                             double *rate);

/* ---- lobatto_nodes.c; for lobatto_history.c: nothing is checked ---- */

/* fvi_lobatto_nodes -- W_n as a sum over nodes, for FVI_LAGS < n <= N.  [(17.10)]
 *
 *     W_n = sum_j q_j r_j^(n-1) a_j a~_j^T,   r_j = 1 - p_j,
 *     a~_j: the entries of a_j backwards, entry i times b_i
 *
 *   N          the longest lag, N >= 1
 *   tolerance  what the nodes leave of it, relative to W_0, 1e-16 to below 1
 *   rated      nonzero: the derivative of W_n by beta is asked for, too: the same sum
 *              with rate_j for q_j                                       [(23.14)]
 *   q, p       outputs, Q numbers each
 *   rate       output, Q numbers; not touched if not rated
 *   a          output, s Q numbers: entry i of a_j at [i * stride + j]
 *   stride     from one entry to the next, >= Q
 *
 * q may be NULL, and then only Q is returned: about (ln N + 20) ln(10/tolerance)
 * / 10; if not rated none for beta = 0, one for beta = -1. Cost 0.1 us a node. */
size_t fvi_lobatto_nodes(size_t s, double beta, double N, double tolerance,
                         int by_order, double *q, double *rate, double *p,
                         double *a, size_t stride);

/* fvi_lobatto_few_nodes -- the same, without rates, by fewer nodes: of N >= 64 those that hardly decay within N steps are
 * replaced by about ln(1/tolerance) / 3 of Gauss's rule, (17.29). About (ln N + 7) ln(10/tolerance) / 10 are left. Cost
 * as there, and 3 us. */
size_t fvi_lobatto_few_nodes(size_t s, double beta, double N, double tolerance, double *q, double *p, double *a,
                             size_t stride);

/* fvi_lobatto_gauss -- of nodes of any weights, mu up to the last that is slow in order: those that hardly decay within N
 * steps become fewer, in place, if there are many and their weights have one sign. Returns how many nodes are left. Cost
 * 3 us. */
size_t fvi_lobatto_gauss(size_t count, double N, double tolerance, double *q, double *mu);

/* ---- lobatto_modes.c; for lobatto_history.c: nothing is checked ---- */

enum { FVI_MODE_LANES = 8 }; /* Q below is a multiple of it */

/* fvi_lobatto_add_near -- sum += sum_n W_n v_{k-n} over the near lags 1 <= n <= min(lags, k), one after
 * the other.                                                                  [(17.9)]
 *
 *   W     entry (i, j) of W_n at [(n * s + j) * s + i]
 *   past  the last v, s numbers each, a ring: v_k at [k % lags * s]
 *   sum   s numbers */
void fvi_lobatto_add_near(size_t s, size_t lags, size_t k, const double *W, const double *past,
                          double *sum);

/* fvi_lobatto_advance -- one coordinate's modes a step on, and what they say.  [(17.12)]
 *
 *     z_j += u.a_j - p_j z_j,   H += sum_j q_j a_j z_j
 *
 *   q, p, a    as fvi_lobatto_nodes made them with stride Q
 *   u          FVI_STAGES numbers, the velocities of the stages backwards, each times
 *              its b_i, and zeros
 *   z          Q numbers, changed;   H  s numbers, added to */
void fvi_lobatto_advance(size_t s, size_t Q, const double *q, const double *p,
                         const double *a, const double *u, double *z, double *H);

/* fvi_lobatto_read_modes -- H += sum_j q_j a_j z_j, of modes that stay as they are: with their rates for
 * q the derivative by beta. Arguments as above. */
void fvi_lobatto_read_modes(size_t s, size_t Q, const double *q, const double *a, const double *z,
                            double *H);

/* ---- for lobatto_kernel.c: nothing is checked ---- */

/* fvi_lobatto_near -- adds to W_0, ..., W_FVI_LAGS those of the term over s, at s =
 * Delta(z)/h. The step size IS included. */
void fvi_lobatto_near(size_t s, const fvi_kernel_simple *term, double h,
                      double *W);

/* ln mu of the nodes: the first, the last, and from one to the next. */
typedef struct {
    double first, last, step;
} fvi_lobatto_span;

/* fvi_lobatto_span_of -- of nodes for powers beta from `least` to `most`; s, N and tolerance as
 * for fvi_lobatto_nodes. Steps are `width` <= 1 times those of a power.     [(17.10)] */
fvi_lobatto_span fvi_lobatto_span_of(size_t s, double least, double most,
                                     double N, double tolerance, double width);

/* fvi_lobatto_solve_nodes -- p and a of nodes mu >= 0, which stand in p: that of (mu + Delta)^(-1) has q = 1.
 * Cost 20 ns a node, eight at once. Accuracy 40 u of the largest entry of a (seen 14 u). */
void fvi_lobatto_solve_nodes(size_t s, size_t count, double *p, double *a, size_t stride);

/* fvi_lobatto_sum -- sum_j q_j a_j a~_j^T into W, of nodes with a stride of Q. */
void fvi_lobatto_sum(size_t s, size_t Q, const double *q, const double *a,
                     double *W);

#endif
