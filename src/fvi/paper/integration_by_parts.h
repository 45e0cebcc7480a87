/* src/fvi/paper/integration_by_parts.h -- The retarded and the advanced discrete fractional derivative, and
 * the scalar product in which each is the transpose of the other.                                [H 5] */
#ifndef FVI_INTEGRATION_BY_PARTS_H
#define FVI_INTEGRATION_BY_PARTS_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(default)

/* A sequence z of N + 1 vectors of R^d is an array of (N + 1) d numbers, vector after vector: component i of
 * z_k is z[k * d + i].
 *
 * fvi_delta_minus -- Compute the retarded derivative, which depends on z_0, ..., z_k.             [(5.1)]
 *
 *     out_k = h^(-alpha) sum_{n=0}^{k} alpha_n z_{k-n},      k = 0, ..., N
 *
 * fvi_delta_plus -- Compute the advanced derivative, which depends on z_k, ..., z_N.              [(5.2)]
 *
 *     out_k = h^(-alpha) sum_{n=0}^{N-k} alpha_n z_{k+n},    k = 0, ..., N
 *
 *   alpha  order, 0 <= alpha <= 2; alpha_n are its weights
 *   h      step, finite, > 0
 *   N      last index; the sequences have N + 1 terms
 *   d      dimension, d >= 1
 *   z      input, (N + 1) d numbers
 *   out    output, (N + 1) d numbers, owned by the caller, must not overlap z
 *
 *     const double z[] = { 0, 1, 4 };
 *     double out[3];
 *     status = fvi_delta_minus(1, 1, 2, 1, z, out);     // 0, 1, 3
 *
 * Plain sums, for checks of identities; memory.h has the fast sums for integration. Cost O(N^2 d), memory
 * O(N). Accuracy: a component that is a sum of t terms has an error of at most
 * (t + 5) u h^(-alpha) sum_n |alpha_n z_{k-+n}|, to first order in u = 2^-53. It is exact where the weights,
 * h^(-alpha) and all sums are short binary fractions.
 * Returns FVI_SUCCESS; FVI_EFAULT if z or out is NULL; FVI_EINVAL if d == 0 or if (N + 1) d numbers cannot
 * be addressed; FVI_EDOM if alpha or h is out of range; FVI_ENOMEM. On error out is untouched. */
int fvi_delta_minus(double alpha, double h, size_t N, size_t d, const double *z,
                    double *out);
int fvi_delta_plus(double alpha, double h, size_t N, size_t d, const double *z,
                   double *out);

/* fvi_sum_of_products -- Return sum_{k=first}^{last} a_k . b_k, the discrete counterpart of the integral of
 * f g in an integration by parts.                                                                 [(5.3)]
 *
 *   first, last  indices; an empty range (first > last) gives 0. They are unsigned, so for N = 0 there is
 *                no index N - 1
 *   d            dimension
 *   a, b         sequences with at least last + 1 terms
 *
 *     double left = fvi_sum_of_products(0, N, d, delta_minus_f, g);
 *     double right = fvi_sum_of_products(0, N, d, f, delta_plus_g);     // the same, but for rounding
 *
 * Nothing is checked. Cost O((last - first + 1) d). */
double fvi_sum_of_products(size_t first, size_t last, size_t d, const double *a,
                           const double *b);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
