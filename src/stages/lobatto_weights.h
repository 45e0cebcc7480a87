/* src/stages/lobatto_weights.h -- Convolution quadrature on Lobatto nodes. [H 17]
 *
 *     Delta(z)^beta = sum_n W_n z^n,
 *     Delta(z) = (A + z/(1-z) 1 b^T)^(-1) = A^(-1) - (z/b_1) e_1 e_s^T   (17.5)
 *
 * A and b belong to the Lobatto IIIC method of s stages. W_n is an s x s matrix. */
#ifndef FVI_LOBATTO_WEIGHTS_H
#define FVI_LOBATTO_WEIGHTS_H

#include "kernel/kernel_terms.h"

#include <stddef.h>

enum { FVI_STAGES = 8 /* largest number of stages */, FVI_LAGS = 3 /* number of near lags, whose W_n are stored */ };

/* The s Lobatto nodes c in [0, 1], their weights b, and the differentiation matrix D: D maps s values at the nodes to
 * the derivative of their polynomial at the nodes. [(17.1)] */
typedef struct {
    double c[FVI_STAGES], b[FVI_STAGES], D[FVI_STAGES][FVI_STAGES];
} fvi_lobatto_rule;

/* fvi_lobatto -- Return the rule of s stages, s = 2, ..., 8, or NULL for another s. */
const fvi_lobatto_rule *fvi_lobatto(size_t s);

/* fvi_lobatto_table -- Compute A of Lobatto IIIC with s stages, the inverse of (17.3). */
void fvi_lobatto_table(const fvi_lobatto_rule *r, size_t s,
                       double A[FVI_STAGES][FVI_STAGES]);

/* fvi_lobatto_weights -- Compute the matrices W_0, ..., W_{n-1}, and their derivatives by beta. [(17.5), (17.10),
 * (23.14)]
 *
 *   s     number of stages, 2 to 8
 *   beta  -1 <= beta <= 1
 *   n     number of matrices, n >= 1
 *   W     output, n s s numbers: entry (i, j) of W_k at [(k * s + i) * s + j]
 *   rate  NULL, or output: the derivatives, ordered as W
 *
 * The step size is not included: multiply by h^(-beta). Cost: 20 us for s = 4, ten times as much for the first call in
 * a process, and O(n Q) with Q about 100. Accuracy in units of 2^-53 max|W_0|: 1000 for the first four matrices (no
 * proof; seen 313), 100 for the other matrices (seen 13). Accuracy of the derivatives in units of 2^-53 of the largest
 * one: 2000 for the first four matrices (no proof; seen 240), 1000 for the other matrices (seen 52).
 *
 * Return FVI_SUCCESS; FVI_EFAULT if W is NULL; FVI_EINVAL if s is not in 2, ..., 8 or n is 0 or too large to be
 * addressed; FVI_EDOM if beta is out of range; FVI_ENOMEM. On error W is unchanged. */
int fvi_lobatto_weights(size_t s, double beta, size_t n, double *W, double *rate);

/* ---- lobatto_nodes.c: internal, nothing is checked ---- */

/* fvi_lobatto_nodes -- Approximate W_n by a sum over nodes, for FVI_LAGS < n <= N. [(17.10)]
 *
 *     W_n = sum_j q_j r_j^(n-1) a_j a~_j^T,   r_j = 1 - p_j,
 *     a~_j: the entries of a_j backwards, entry i times b_i
 *
 *   N          longest lag, N >= 1
 *   tolerance  error of the sum relative to W_0, 1e-16 <= tolerance < 1
 *   by_order   nonzero: compute rate_j, too. The same sum with rate_j in place of q_j is the derivative
 *              of W_n by beta [(23.14)]
 *   q, p       outputs, Q numbers each
 *   rate       output, Q numbers; not touched if by_order is 0
 *   a          output, s Q numbers: entry i of a_j at [i * stride + j]
 *   stride     distance between the entries of one a_j, >= Q
 *
 * With q = NULL only Q is computed. Return Q, about (ln N + 20) ln(10/tolerance) / 10. If by_order is 0, Q is 0 for
 * beta = 0 and 1 for beta = -1. Cost: 0.1 us for each node. */
size_t fvi_lobatto_nodes(size_t s, double beta, double N, double tolerance,
                         int by_order, double *q, double *rate, double *p,
                         double *a, size_t stride);

/* fvi_lobatto_few_nodes -- Compute fewer nodes, without derivatives. For N >= 64 the nodes that hardly decay within N
 * steps are replaced by about ln(1/tolerance) / 3 nodes of a Gauss rule (17.29). Return their number, about (ln N + 7)
 * ln(10/tolerance) / 10. Cost: as for fvi_lobatto_nodes, and 3 us. */
size_t fvi_lobatto_few_nodes(size_t s, double beta, double N, double tolerance, double *q, double *p, double *a,
                             size_t stride);

/* fvi_lobatto_gauss -- Replace nodes that hardly decay within N steps by fewer nodes, in place. The slow nodes must
 * come first, and their mu must ascend. Nothing changes if there are few slow nodes or if their weights q have both
 * signs. Return the number of nodes that remain. Cost: 3 us. */
size_t fvi_lobatto_gauss(size_t count, double N, double tolerance, double *q, double *mu);

/* ---- lobatto_modes.c: internal, nothing is checked ---- */

enum { FVI_MODE_LANES = 8 }; /* Q is a multiple of this number in the functions below */

/* fvi_lobatto_add_near -- Compute sum += sum_n W_n v_{k-n} over the near lags 1 <= n <= min(lags, k), in this order.
 *                                                               [(17.9)]
 *
 *   W     entry (i, j) of W_n at [(n * s + j) * s + i]
 *   past  a ring of the last v, s numbers each: v_k at [k % lags * s]
 *   sum   s numbers */
void fvi_lobatto_add_near(size_t s, size_t lags, size_t k, const double *W, const double *past,
                          double *sum);

/* fvi_lobatto_advance -- Advance the modes of one coordinate by a step, and add their sum to H. [(17.12)]
 *
 *     z_j += u.a_j - p_j z_j,   H += sum_j q_j a_j z_j
 *
 *   q, p, a  as fvi_lobatto_nodes computes them with stride = Q
 *   u        FVI_STAGES numbers: the velocities of the stages backwards, each times its b_i, then zeros
 *   z        Q numbers, changed
 *   H        s numbers, added to */
void fvi_lobatto_advance(size_t s, size_t Q, const double *q, const double *p,
                         const double *a, const double *u, double *z, double *H);

/* fvi_lobatto_read_modes -- Compute H += sum_j q_j a_j z_j without changing the modes. With rate in place of q this
 * adds the derivative by beta. The arguments are those of fvi_lobatto_advance. */
void fvi_lobatto_read_modes(size_t s, size_t Q, const double *q, const double *a, const double *z,
                            double *H);

/* ---- for lobatto_kernel.c: internal, nothing is checked ---- */

/* fvi_lobatto_near -- Add to W_0, ..., W_FVI_LAGS the matrices of the term divided by s, with Delta(z)/h in place of s.
 * They include the step size. */
void fvi_lobatto_near(size_t s, const fvi_kernel_simple *term, double h,
                      double *W);

/* The range of ln mu of the nodes: first, last, and the distance between two nodes. */
typedef struct {
    double first, last, step;
} fvi_lobatto_span;

/* fvi_lobatto_span_of -- Return the range of the nodes for powers from `least` to `most`; s, N and tolerance are those
 * of fvi_lobatto_nodes. The distance is `width` <= 1 times the distance for a power. [(17.10)] */
fvi_lobatto_span fvi_lobatto_span_of(size_t s, double least, double most,
                                     double N, double tolerance, double width);

/* fvi_lobatto_solve_nodes -- Compute p and a of nodes mu >= 0. On entry p holds mu. (mu + Delta)^(-1) has the weight
 * q = 1. Cost: 20 ns for each node, because eight nodes are computed at once. Accuracy: 40 u of the largest entry of a
 * (seen 14 u). */
void fvi_lobatto_solve_nodes(size_t s, size_t count, double *p, double *a, size_t stride);

/* fvi_lobatto_sum -- Write sum_j q_j a_j a~_j^T to W. The nodes have the stride Q. */
void fvi_lobatto_sum(size_t s, size_t Q, const double *q, const double *a,
                     double *W);

#endif
