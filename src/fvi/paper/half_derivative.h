/* src/fvi/paper/half_derivative.h -- Two fractional derivatives in a row; two half derivatives are a first
 * derivative.                                                                                     [H 7] */
#ifndef FVI_HALF_DERIVATIVE_H
#define FVI_HALF_DERIVATIVE_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(default)

/* fvi_gl_weights_product -- Compute the weights of two derivatives in a row.                    [(7.2)]
 *
 *     c[k] = sum_{n=0}^{k} alpha_n beta_{k-n},     k = 0, ..., count - 1,
 *
 * where alpha_n and beta_n are the weights of order alpha and of order beta. The function adds the products
 * as printed. By (1-z)^alpha (1-z)^beta = (1-z)^(alpha+beta) the sums are the weights of order alpha + beta.
 * For example, alpha = beta = 1/2 gives 1, -1, 0, 0, ...
 *
 *   alpha, beta  orders, each in [0, 2]
 *   count        number of weights, count >= 1
 *   c            output, count numbers, owned by the caller
 *
 *     double c[4];
 *     status = fvi_gl_weights_product(0.5, 0.5, 4, c);
 *
 * Cost O(count^2), memory O(count). Absolute error of c[k]: at most (k + 5) u sum_n |alpha_n beta_{k-n}|,
 * u = 2^-53. That is small compared with 1, but not compared with c[k]. So an integrator takes
 * fvi_gl_weights(alpha + beta) instead.
 * Returns FVI_SUCCESS; FVI_EFAULT if c is NULL; FVI_EINVAL if count == 0 or 2 count numbers cannot be
 * addressed; FVI_EDOM if an order is out of range; FVI_ENOMEM. On error c is untouched. */
int fvi_gl_weights_product(double alpha, double beta, size_t count,
                             double *c);

/* fvi_delta_twice -- Compute Delta_-^alpha Delta_-^alpha z by two sums, as the paper prints it.  [(7.1)]
 *
 * Arguments, layout and errors (FVI_EFAULT, FVI_EINVAL, FVI_EDOM, FVI_ENOMEM) are those of fvi_delta_minus
 * (integration_by_parts.h). Cost O(N^2 d), memory O(N d). */
int fvi_delta_twice(double alpha, double h, size_t N, size_t d, const double *z,
                    double *out);

/* fvi_backward_difference -- Compute the sequence to which (7.1) reduces for alpha = 1/2.       [(7.3)]
 *
 *     out_k = (z_k - z_{k-1}) / h,  k = 1, ..., N;      out_0 = z_0 / h
 *
 * The value at k = 0 is the value of the two sums: for them the sequence is 0 before k = 0.
 *
 *     const double z[] = { 0, 1, 4 };
 *     double out[3];
 *     status = fvi_backward_difference(1, 2, 1, z, out);     // 0, 1, 3
 *
 * Arguments and errors (FVI_EFAULT, FVI_EINVAL, FVI_EDOM) are those of fvi_delta_minus, without alpha.
 * Cost O(N d). */
int fvi_backward_difference(double h, size_t N, size_t d, const double *z,
                            double *out);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
