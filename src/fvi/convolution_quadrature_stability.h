/* src/fvi/convolution_quadrature_stability.h -- Which steps the weights allow.
 *                                                                [H 13] */
#ifndef FVI_CONVOLUTION_QUADRATURE_STABILITY_H
#define FVI_CONVOLUTION_QUADRATURE_STABILITY_H

#include "convolution_quadrature.h"

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(default)

/* fvi_cq_oscillator -- the linear recurrence with any weights. [(13.13)]
 *
 *     (1 + kappa (1 - kappa) W) (x_{k+1} - 2 x_k + x_{k-1}) + W x_k
 *         + R sum_n w_n ((1 - theta) x_{k-n} + theta x_{k+1-n}) = 0,
 *     x_0 = 0, x_1 = 1,     k = 1, ..., N - 1
 *
 *   w             N + 1 weights
 *   theta, kappa  in [0, 1]
 *   W, R          finite, >= 0
 *   N             last index, N >= 1
 *   x             output, N + 1 numbers, must not overlap w
 *
 * To see how a step behaves, not to integrate with: plain sums, O(N^2).
 * Returns FVI_SUCCESS; FVI_EFAULT if a pointer is NULL; FVI_EINVAL if N == 0;
 * FVI_EDOM if a number is out of range. On error x is untouched. Values may
 * overflow. */
int fvi_cq_oscillator(const double *w, double theta, double kappa,
                              double W, double R, size_t N, double *x);

/* fvi_cq_amplification -- the factor 1/|z| by which a solution of that
 * recurrence grows in a step while it alternates in sign, 1 if none does: z is
 * the root in (-1, 0) of                                            [(13.15)]
 *
 *     Q(z) = (1 + kappa (1 - kappa) W) (1 - z)^2 + z W
 *            + R delta(z)^{2 alpha} ((1 - theta) z + theta).
 *
 *   kind    EULER, BDF2 or TRAPEZOID
 *   theta, alpha, kappa  in [0, 1]
 *   W, R    finite, > 0
 *   growth  output
 *
 * By GSL's Brent solver, to 8 ulp of z. Returns FVI_SUCCESS; FVI_EFAULT if growth
 * is NULL; FVI_EINVAL for another kind; FVI_EDOM if a number is out of range;
 * FVI_ENOMEM. On error growth is untouched. */
int fvi_cq_amplification(fvi_delta kind, double theta, double alpha,
                          double kappa, double W, double R, double *growth);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
