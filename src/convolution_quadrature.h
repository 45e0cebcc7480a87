/* src/convolution_quadrature.h -- Other weights than Grunwald and Letnikov's, and
 * the integrators of order 2 that they give.                     [Chapter 13] */
#ifndef FVI_CONVOLUTION_QUADRATURE_H
#define FVI_CONVOLUTION_QUADRATURE_H

#include "trajectory.h"

/* Which weights: the generating function delta(z) of a multistep method, or,
 * for L1, integration of a piecewise linear path.               [(13.2), (13.5)]
 *
 *   EULER      delta = 1 - z: the weights of Chapter 4
 *   BDF2       delta = (1 - z) + (1 - z)^2 / 2
 *   TRAPEZOID  delta = 2 (1 - z) / (1 + z)
 *   L1         no power of any delta */
typedef enum {
    FVI_QUADRATURE_EULER,
    FVI_QUADRATURE_BDF2,
    FVI_QUADRATURE_TRAPEZOID,
    FVI_QUADRATURE_L1
} fvi_quadrature;

/* fvi_quadrature_weights -- w_n of sum_n w_n z^n = delta(z)^beta.      [(13.1)]
 * The step size is NOT included: the derivative is h^(-beta) sum_n w_n x_{k-n}.
 *
 *   kind   as above
 *   beta   order, 0 <= beta <= 2; L1: 0 <= beta < 1
 *   count  number of weights, count >= 1
 *   w      output, length count, owned by the caller
 *
 * Accuracy, relative to the largest weight, u = 2^-53: EULER as
 * fvi_coefficients; BDF2 40 u; TRAPEZOID 3 count u; L1 40 u max(1, count^(1 - beta)).
 * Integer orders of BDF2 and TRAPEZOID are exact. Cost O(count).
 * Returns GSL_SUCCESS; GSL_EFAULT if w is NULL; GSL_EINVAL if count == 0 or kind
 * is unknown; GSL_EDOM if beta is out of range. On error w is untouched. */
int fvi_quadrature_weights(fvi_quadrature kind, double beta, size_t count,
                           double *w);

/* fvi_bdf2_factor -- the coefficients g_n of ((3 - z)/2)^beta, by which BDF2
 * differs from EULER.                                               [(13.11)]
 *
 *   beta  0 <= beta <= 2
 *   g     output, FVI_BDF2_TAPS numbers: what follows them is below
 *         u sum |g_n| / 10
 *
 * Returns how many of them there are up to the last that is not zero: 1, 2, 3
 * for beta = 0, 1, 2. Nothing is checked. */
enum { FVI_BDF2_TAPS = 36 };
size_t fvi_bdf2_factor(double beta, double g[FVI_BDF2_TAPS]);

/* fvi_quadrature_oscillator -- the linear recurrence with any weights. [(13.13)]
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
 * Returns GSL_SUCCESS; GSL_EFAULT if a pointer is NULL; GSL_EINVAL if N == 0;
 * GSL_EDOM if a number is out of range. On error x is untouched. Values may
 * overflow. */
int fvi_quadrature_oscillator(const double *w, double theta, double kappa,
                              double W, double R, size_t N, double *x);

/* fvi_quadrature_growth -- the factor 1/|z| by which a solution of that
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
 * By GSL's Brent solver, to 8 ulp of z. Returns GSL_SUCCESS; GSL_EFAULT if growth
 * is NULL; GSL_EINVAL for another kind; GSL_EDOM if a number is out of range;
 * GSL_ENOMEM. On error growth is untouched. */
int fvi_quadrature_growth(fvi_quadrature kind, double theta, double alpha,
                          double kappa, double W, double R, double *growth);

/* Two integrators of order 2 in x and in p, for kappa = 1/2 (else of order 1):
 *
 *     D1 L_d(x_k, x_{k+1}) + D2 L_d(x_{k-1}, x_k)
 *         - h rho ((1 - theta) D_k + theta D_{k+1}) + h F_k = 0,     [(13.7)]
 *
 * D_k = h^(-2 alpha) sum_n w_n z_{k-n}. p_k is the momentum (13.9), from p_0 on.
 *
 *   fvi_shifted  theta = alpha, EULER: implicit, stable for every step if
 *                alpha >= 1/2 and kappa = 1/2; no artificial loss at alpha = 1
 *   fvi_bdf2     theta = 0, BDF2: explicit memory, stable for shorter steps than
 *                Algorithm 3
 *
 * D_k is Caputo's: z = x - x0 or, if 2 alpha > 1, x - x0 - t v0. What another past
 * adds to it is a force that is known beforehand (19.3) and acts by its exact
 * impulses (19.5). F_k is the mean of both limits of F at
 * t_k, taken 4 ulp away, and each step begins and ends with the
 * limit on its own side: F may jump at nodes (13.12). In the first few steps after
 * the start, or after a jump of F, the error of p is larger and falls more slowly
 * with h; that does not spread. Cost of a step: as Algorithm 3, and two values of
 * F; DIRECT and FFT memories of fvi_shifted sum twice; BDF2 takes 36 products a
 * damped coordinate more. Errors as fvi_start and fvi_step; fvi_start also returns
 * GSL_EDOM if m/h + theta rho h^(1 - 2 alpha) overflows. */
extern const fvi_method fvi_shifted;
extern const fvi_method fvi_bdf2;

#endif
