/* src/fvi/coefficients.h -- The weights of Grünwald and Letnikov.               [H 4]
 *
 * A derivative of the order alpha is a weighted sum over the past, D^alpha x(t_k) = h^(-alpha) sum_n w[n] x_{k-n} in
 * the limit of small steps h. The functions here compute the weights w[n], once accurately and once by the textbook,
 * and their derivatives by alpha. For example, alpha = 1/2 has w = 1, -1/2, -1/8, -1/16, ... */
#ifndef FVI_COEFFICIENTS_H
#define FVI_COEFFICIENTS_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(default)

/* fvi_gl_weights -- compute the weights of the order alpha.                  [(4.1)]
 *
 *     w[n] = (-1)^n binom(alpha, n),     n = 0, ..., count - 1,
 *
 * These are the coefficients of (1 - z)^alpha. The step size is NOT included: the derivative is
 * h^(-alpha) sum_n w[n] x_{k-n}.
 *
 *   alpha  the order, 0 <= alpha <= 2 (an integrator asks for 2 alpha)
 *   count  number of weights, count >= 1
 *   w      output, `count` numbers, owned by the caller
 *
 *     double w[4];
 *     fvi_gl_weights(0.5, 4, w);   // 1, -0.5, -0.125, -0.0625
 *
 * The recurrence (4.2) runs on w[n] / alpha in double-double arithmetic. Accuracy: for every n < 10^8 each weight is
 * the nearest double or one of its two neighbours (bound and proof in H 4). Weights that are short binary fractions are
 * exact, and weights that vanish (alpha = 0, 1, 2) are exactly +0.
 * Cost O(count), two divisions a weight; no memory.
 * Returns FVI_SUCCESS; FVI_EFAULT if w is NULL; FVI_EINVAL if count == 0; FVI_EDOM if alpha is not in [0, 2]. On error
 * w is untouched. */
int fvi_gl_weights(double alpha, size_t count, double *w);

/* fvi_gl_weights_simple -- compute the same weights by the recurrence of the textbooks in plain doubles.      [(4.2)]
 *
 *     w[0] = 1,     w[n] = w[n-1] (n - 1 - alpha) / n
 *
 * For reading and for comparison. Accuracy: w[n] has lost about 0.2 n units of roundoff, unless alpha is a short binary
 * fraction. Arguments, errors and example are those of fvi_gl_weights; cost O(count), one division a weight. */
int fvi_gl_weights_simple(double alpha, size_t count, double *w);

/* fvi_gl_weights_by_order -- compute the derivatives of the weights by the order.     [(23.9)]
 *
 *     rate[n] = d w[n] / d alpha,     n = 0, ..., count - 1,
 *
 * These are the coefficients of ln(1 - z) (1 - z)^alpha. At a whole order only the first weights differ from 0, but all
 * derivatives do: for alpha = 0 they are 0, -1, -1/2, -1/3, ...
 *
 *   alpha, count  as for fvi_gl_weights
 *   rate          output, `count` numbers, owned by the caller
 *
 *     double rate[4];
 *     fvi_gl_weights_by_order(0, 4, rate);   // 0, -1, -0.5, -0.333...
 *
 * Method: the derivative of the recurrence (4.2) in double-double arithmetic. Accuracy: the nearest double or one of
 * its two neighbours where |rate[n]| is not below 1e-12 |w[n]|; no proof. Cost O(count), four divisions a weight; no
 * memory. Returns FVI_SUCCESS; FVI_EFAULT if rate is NULL; FVI_EINVAL and FVI_EDOM as fvi_gl_weights. On error rate is
 * untouched. */
int fvi_gl_weights_by_order(double alpha, size_t count, double *rate);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
