/* src/fvi/convolution_quadrature.h -- Weights of other rules than Grünwald and Letnikov's.
 *                                                                [H 13]
 *
 * A convolution quadrature replaces the derivative of the order beta by a weighted sum over the past. Its weights are
 * the coefficients of the power series of delta(z)^beta, where delta belongs to a multistep method. */
#ifndef FVI_CONVOLUTION_QUADRATURE_H
#define FVI_CONVOLUTION_QUADRATURE_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(default)

/* fvi_delta -- the rule: the generating function delta(z) of a multistep method.    [(13.2), (13.5)]
 *
 *   EULER      delta = 1 - z: the weights of Grünwald and Letnikov (coefficients.h)
 *   BDF2       delta = (1 - z) + (1 - z)^2 / 2
 *   TRAPEZOID  delta = 2 (1 - z) / (1 + z)
 *   L1         no power of a delta: the integral over the slopes of a piecewise linear path */
typedef enum {
    FVI_DELTA_EULER,
    FVI_DELTA_BDF2,
    FVI_DELTA_TRAPEZOID,
    FVI_DELTA_L1
} fvi_delta;

/* fvi_cq_weights -- compute the weights w_n of                                           [(13.1)]
 *
 *     sum_n w_n z^n = delta(z)^beta,     n = 0, ..., count - 1.
 *
 * The step size is NOT included: the derivative is h^(-beta) sum_n w_n x_{k-n}.
 *
 *   kind   the rule, see above
 *   beta   the order, 0 <= beta <= 2; for L1 0 <= beta < 1
 *   count  number of weights, count >= 1
 *   w      output, `count` numbers, owned by the caller
 *
 *     double w[3];
 *     fvi_cq_weights(FVI_DELTA_BDF2, 1, 3, w);   // 1.5, -2, 0.5
 *
 * Accuracy, relative to the largest weight, with u = 2^-53: EULER as fvi_gl_weights; BDF2 40 u; TRAPEZOID 3 count u; L1
 * 40 u max(1, count^(1 - beta)). BDF2 and TRAPEZOID are exact for whole orders. Cost O(count).
 * Returns FVI_SUCCESS; FVI_EFAULT if w is NULL; FVI_EINVAL if count == 0 or kind is unknown; FVI_EDOM if beta is out of
 * range. On error w is untouched. */
int fvi_cq_weights(fvi_delta kind, double beta, size_t count,
                           double *w);

/* fvi_cq_bdf2_factor -- compute the coefficients g_n of ((3 - z)/2)^beta, the factor by which the weights of BDF2
 * differ from those of EULER.                                               [(13.11)]
 *
 *   beta  0 <= beta <= 2
 *   g     output, FVI_BDF2_TAPS numbers. All coefficients after them are below u sum |g_n| / 10, u = 2^-53
 *
 *     double g[FVI_BDF2_TAPS];
 *     const size_t count = fvi_cq_bdf2_factor(1, g);   // count = 2, g = 1.5, -0.5
 *
 * Returns the number of coefficients up to the last one that is not zero: 1, 2, 3 for beta = 0, 1, 2. Nothing is
 * checked. */
enum { FVI_BDF2_TAPS = 36 };
size_t fvi_cq_bdf2_factor(double beta, double g[FVI_BDF2_TAPS]);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
