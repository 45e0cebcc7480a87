/* src/fvi/convolution_quadrature_stability.h -- Which step sizes are stable with which weights.
 *                                                                [H 13]
 *
 * One damped oscillator with the weights of any rule is a linear recurrence. The functions here run this recurrence,
 * and compute the factor by which it grows. */
#ifndef FVI_CONVOLUTION_QUADRATURE_STABILITY_H
#define FVI_CONVOLUTION_QUADRATURE_STABILITY_H

#include "convolution_quadrature.h"

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(default)

/* fvi_cq_oscillator -- run the recurrence of a damped oscillator with any weights.      [(13.13)]
 *
 *     (1 + kappa (1 - kappa) W) (x_{k+1} - 2 x_k + x_{k-1}) + W x_k
 *         + R sum_n w_n ((1 - theta) x_{k-n} + theta x_{k+1-n}) = 0,
 *     x_0 = 0, x_1 = 1,     k = 1, ..., N - 1
 *
 *   w             N + 1 weights
 *   theta, kappa  in [0, 1]
 *   W, R          finite, >= 0: h^2 c/m and rho h^(2 - 2 alpha)/m of the oscillator
 *   N             last index, N >= 1
 *   x             output, N + 1 numbers, owned by the caller, must not overlap w
 *
 *     fvi_cq_weights(FVI_DELTA_BDF2, 2 * alpha, N + 1, w);
 *     fvi_cq_oscillator(w, 0, 0.5, W, R, N, x);
 *     printf("%s\n", fabs(x[N]) > 1e6 ? "unstable" : "stable");
 *
 * This shows how a step size behaves; it is not made to integrate with. Plain sums, cost O(N^2).
 * Returns FVI_SUCCESS; FVI_EFAULT if a pointer is NULL; FVI_EINVAL if N == 0; FVI_EDOM if theta, kappa, W or R is out
 * of range. On error x is untouched. Values may overflow, which is no error. */
int fvi_cq_oscillator(const double *w, double theta, double kappa,
                              double W, double R, size_t N, double *x);

/* fvi_cq_amplification -- compute the factor by which a solution of that recurrence grows in each step while its sign
 * alternates; 1 if no such solution grows.
 *
 * The factor is 1/|z|, where z is the root in (-1, 0) of                                            [(13.15)]
 *
 *     Q(z) = (1 + kappa (1 - kappa) W) (1 - z)^2 + z W
 *            + R delta(z)^{2 alpha} ((1 - theta) z + theta).
 *
 *   kind    EULER, BDF2 or TRAPEZOID
 *   theta, alpha, kappa  in [0, 1]
 *   W, R    finite, > 0
 *   growth  output, one number
 *
 *     double growth;
 *     status = fvi_cq_amplification(FVI_DELTA_BDF2, 0, alpha, 0.5, W, R, &growth);
 *     is_stable = growth == 1;
 *
 * Method: GSL's Brent solver. Accuracy: 8 ulp of z. Returns FVI_SUCCESS; FVI_EFAULT if growth is NULL; FVI_EINVAL for
 * another kind; FVI_EDOM if a number is out of range; FVI_ENOMEM. On error growth is untouched. */
int fvi_cq_amplification(fvi_delta kind, double theta, double alpha,
                          double kappa, double W, double R, double *growth);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
