/* src/fvi/coefficients.h -- Grünwald-Letnikov weights.               [H 4] */
#ifndef FVI_COEFFICIENTS_H
#define FVI_COEFFICIENTS_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(default)

/* fvi_gl_weights -- the weights of order alpha.                  [(4.1)]
 *
 *     w[n] = (-1)^n binom(alpha, n),     n = 0, ..., count - 1,
 *
 * the coefficients of (1 - z)^alpha. The step size is NOT included: the
 * derivative is h^(-alpha) sum_n w[n] x_{k-n}.
 *
 *   alpha  order, 0 <= alpha <= 2 (an integrator asks for 2 alpha)
 *   count  number of weights, count >= 1
 *   w      output, length count, owned by the caller
 *
 * The recurrence runs in double-double arithmetic on w[n] / alpha. Accuracy:
 * the nearest double or one of its two neighbours for every n < 10^8 (bound and
 * proof in H 4); exact where the weights are short binary fractions, and
 * exact zeros +0 where they vanish (alpha = 0, 1, 2).
 * Cost O(count), two divisions a weight; no memory.
 * Returns FVI_SUCCESS; FVI_EFAULT if w is NULL; FVI_EINVAL if count == 0;
 * FVI_EDOM if alpha is not in [0, 2]. On error w is untouched. */
int fvi_gl_weights(double alpha, size_t count, double *w);

/* fvi_gl_weights_simple -- the same weights by the textbook recurrence
 * w[n] = w[n-1] (n - 1 - alpha) / n in plain doubles.               [(4.2)]
 *
 * For reading and for comparison: of the order of 0.2 n units of roundoff are
 * lost after n steps, unless alpha is a short binary fraction.
 * Arguments, cost, and errors FVI_EFAULT, FVI_EINVAL, FVI_EDOM: as fvi_gl_weights. */
int fvi_gl_weights_simple(double alpha, size_t count, double *w);

/* fvi_gl_weights_by_order -- the derivatives of the weights by the order.     [(23.9)]
 *
 *     rate[n] = d w[n] / d alpha,     n = 0, ..., count - 1,
 *
 * the coefficients of ln(1 - z) (1 - z)^alpha. They are not local where the weights
 * are: for alpha = 0 they are 0, -1, -1/2, -1/3, ...
 *
 *   alpha, count  as fvi_gl_weights
 *   rate          output, length count, owned by the caller
 *
 * The derivative of the recurrence of fvi_gl_weights, in double-double arithmetic.
 * Accuracy: the nearest double or one of its two neighbours where |rate[n]| is not
 * below 1e-12 |w[n]|; no proof. Cost O(count), three divisions a weight; no memory.
 * Errors FVI_EFAULT, FVI_EINVAL, FVI_EDOM: as fvi_gl_weights. */
int fvi_gl_weights_by_order(double alpha, size_t count, double *rate);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
