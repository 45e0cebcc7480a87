/* src/fvi/convolution_quadrature.h -- Other weights than Grünwald and Letnikov's.
 *                                                                [H 13] */
#ifndef FVI_CONVOLUTION_QUADRATURE_H
#define FVI_CONVOLUTION_QUADRATURE_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(default)

/* Which weights: the generating function delta(z) of a multistep method, or,
 * for L1, integration of a piecewise linear path.               [(13.2), (13.5)]
 *
 *   EULER      delta = 1 - z: the weights of H 4
 *   BDF2       delta = (1 - z) + (1 - z)^2 / 2
 *   TRAPEZOID  delta = 2 (1 - z) / (1 + z)
 *   L1         no power of any delta */
typedef enum {
    FVI_DELTA_EULER,
    FVI_DELTA_BDF2,
    FVI_DELTA_TRAPEZOID,
    FVI_DELTA_L1
} fvi_delta;

/* fvi_cq_weights -- w_n of sum_n w_n z^n = delta(z)^beta.      [(13.1)]
 * The step size is NOT included: the derivative is h^(-beta) sum_n w_n x_{k-n}.
 *
 *   kind   as above
 *   beta   order, 0 <= beta <= 2; L1: 0 <= beta < 1
 *   count  number of weights, count >= 1
 *   w      output, length count, owned by the caller
 *
 * Accuracy, relative to the largest weight, u = 2^-53: EULER as
 * fvi_gl_weights; BDF2 40 u; TRAPEZOID 3 count u; L1 40 u max(1, count^(1 - beta)).
 * Integer orders of BDF2 and TRAPEZOID are exact. Cost O(count).
 * Returns FVI_SUCCESS; FVI_EFAULT if w is NULL; FVI_EINVAL if count == 0 or kind
 * is unknown; FVI_EDOM if beta is out of range. On error w is untouched. */
int fvi_cq_weights(fvi_delta kind, double beta, size_t count,
                           double *w);

/* fvi_cq_bdf2_factor -- the coefficients g_n of ((3 - z)/2)^beta, by which BDF2
 * differs from EULER.                                               [(13.11)]
 *
 *   beta  0 <= beta <= 2
 *   g     output, FVI_BDF2_TAPS numbers: what follows them is below
 *         u sum |g_n| / 10
 *
 * Returns how many of them there are up to the last that is not zero: 1, 2, 3
 * for beta = 0, 1, 2. Nothing is checked. */
enum { FVI_BDF2_TAPS = 36 };
size_t fvi_cq_bdf2_factor(double beta, double g[FVI_BDF2_TAPS]);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
