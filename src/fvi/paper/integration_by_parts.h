/* src/fvi/paper/integration_by_parts.h -- The retarded and the advanced discrete
 * fractional derivative, and their scalar product.               [H 5] */
#ifndef FVI_INTEGRATION_BY_PARTS_H
#define FVI_INTEGRATION_BY_PARTS_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(default)

/* A sequence z of N + 1 vectors of R^d is an array of (N + 1) d numbers, vector
 * after vector: component i of z_k is z[k * d + i].
 *
 * fvi_delta_minus -- retarded: it looks back.                       [(5.1)]
 *
 *     out_k = h^(-alpha) sum_{n=0}^{k} alpha_n z_{k-n},      k = 0, ..., N
 *
 * fvi_delta_plus -- advanced: it looks ahead.                       [(5.2)]
 *
 *     out_k = h^(-alpha) sum_{n=0}^{N-k} alpha_n z_{k+n},    k = 0, ..., N
 *
 *   alpha  order, 0 <= alpha <= 2
 *   h      step, finite, > 0
 *   N      last index; the sequences have N + 1 terms
 *   d      dimension, d >= 1
 *   z      input, (N + 1) d numbers
 *   out    output, (N + 1) d numbers, owned by the caller, must not overlap z
 *
 * Plain sums, cost O(N^2 d), memory O(N): to check identities with, not to
 * integrate with (that is memory.h). To first order in u = 2^-53, a component
 * that is a sum of t terms has an error of at most
 * (t + 5) u h^(-alpha) sum_n |alpha_n z_{k-+n}|; where the weights, h^(-alpha)
 * and all sums are short binary fractions it is exact.
 * Returns FVI_SUCCESS; FVI_EFAULT if z or out is NULL; FVI_EINVAL if d == 0 or
 * if (N + 1) d numbers cannot be addressed; FVI_EDOM if alpha or h is out of
 * range; FVI_ENOMEM. On error out is untouched. */
int fvi_delta_minus(double alpha, double h, size_t N, size_t d, const double *z,
                    double *out);
int fvi_delta_plus(double alpha, double h, size_t N, size_t d, const double *z,
                   double *out);

/* fvi_sum_of_products -- sum_{k=first}^{last} a_k . b_k, the discrete stand-in
 * for the integral of f g in an integration by parts.               [(5.3)]
 *
 *   first, last  indices; an empty range (first > last) gives 0. They are
 *                unsigned: for N = 0 there is no N - 1
 *   d            dimension
 *   a, b         sequences with at least last + 1 terms
 *
 * Cost O((last - first) d). Nothing is checked. */
double fvi_sum_of_products(size_t first, size_t last, size_t d, const double *a,
                           const double *b);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
