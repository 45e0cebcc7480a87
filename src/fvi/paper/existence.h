/* src/fvi/paper/existence.h -- Picard iteration for motion with memory.    [H 15]
 *
 *     x' = v,   v' = f(x, v) - R D_-^{2 alpha} (x - x0),   R = rho / m,
 *
 * integrated once: v = T v, with the Picard map                        [(15.4)]
 *
 *     (T v)(t) = v0 + int_0^t f(x, v) ds - R (I_-^gamma v)(t),
 *     x = x0 + I_- v,    gamma = 2 - 2 alpha. */
#ifndef FVI_EXISTENCE_H
#define FVI_EXISTENCE_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(default)

/* fvi_fractional_integral -- I_-^gamma of a piecewise linear function. [(15.10)]
 *
 *     out_k = 1/Gamma(gamma) int_0^{t_k} (t_k - s)^(gamma-1) v(s) ds,  t_k = k h,
 *
 * for k = 0, ..., N, exactly, v being linear between v(t_j) = v_j. The product
 * trapezoidal rule: its weights are positive and integrate 1 and t exactly;
 * gamma = 1 is the trapezoidal rule, gamma = 0 the identity.
 *
 *   gamma  order, 0 <= gamma <= 2
 *   h      step, finite, > 0
 *   N      number of steps, N >= 1
 *   v      N + 1 numbers
 *   out    output, N + 1 numbers, owned by the caller, must not overlap v
 *
 * Cost O(N^2), memory O(N). Rounding error of out_k at most
 * (k + 40) u out_k(|v|), u = 2^-53, out_k(|v|) being the result for |v_j|.
 * Returns FVI_SUCCESS; FVI_EFAULT if v or out is NULL; FVI_EINVAL if N == 0 or
 * N + 1 numbers cannot be addressed; FVI_EDOM if gamma or h is out of range;
 * FVI_ENOMEM. On error out is untouched. */
int fvi_fractional_integral(double gamma, double h, size_t N, const double *v,
                            double *out);

/* fvi_picard_problem -- f, the damping and the start, d = 1.
 *
 *   f       acceleration without the memory, -U'(x)/m in mechanics
 *   params  handed to f, owned by the caller, may be NULL
 *   alpha   0 <= alpha <= 1 (the theorem needs alpha < 1)
 *   R       rho / m, finite, >= 0
 *   x0, v0  start, finite */
typedef struct {
    double (*f)(double x, double v, const void *params);
    const void *params;
    double alpha, R, x0, v0;
} fvi_picard_problem;

/* fvi_picard -- one iteration: next = T_h v, on a grid.              [(15.4)]
 *
 * Integrals by fvi_fractional_integral (of order 1 for x and for f).
 *
 *   p, h, N  as above
 *   v        N + 1 velocities at t_k = k h: any guess, or an earlier iterate
 *   x        output, N + 1 positions that belong to v
 *   next     output, N + 1 velocities, must not overlap v
 *
 * Iterating converges to the fixed point of T_h, whose distance from the
 * solution at a fixed t is O(h^2), O(h^(1 + gamma)) if gamma < 1. Cost O(N^2),
 * memory O(N).
 * Returns FVI_SUCCESS; FVI_EFAULT if a pointer or p->f is NULL; FVI_EINVAL,
 * FVI_EDOM, FVI_ENOMEM as fvi_fractional_integral, and for a number of the
 * problem that is out of range. On these errors x and next are untouched.
 * FVI_EOVRFLW if a value is not finite: x and next then hold what came out. */
int fvi_picard(const fvi_picard_problem *p, double h, size_t N, const double *v,
               double *x, double *next);

/* fvi_picard_constant -- by what factor T contracts on [0, d].       [(15.5)]
 *
 *     q(d) = Kx d^2 / 2 + Kv d + R d^gamma / Gamma(1 + gamma),
 *
 * fvi_picard_bound -- the same for n iterations at once,             [(15.8)]
 *
 *     e_n(d) = sum_{i+j+k=n} n!/(i! j! k!) Kx^i Kv^j R^k
 *              d^(2i + j + gamma k) / Gamma(1 + 2i + j + gamma k),
 *
 * and fvi_picard_weighted -- in the norm sup e^(-lambda t) |v(t)|.    [(15.7)]
 *
 *     q_lambda = Kx / lambda^2 + Kv / lambda + R / lambda^gamma
 *
 *   alpha   as above;  R  rho / m
 *   Kx, Kv  |f(x,v) - f(x~,v~)| <= Kx |x - x~| + Kv |v - v~|
 *   d       length of the interval;  lambda > 0;  n >= 0
 *
 * All numbers finite and >= 0; nothing is checked. Relative error below 40 u for
 * q; for e_n below 10 (n + 10) ln(n + 10) u. Cost O(1), and O(n^2) for e_n. */
double fvi_picard_constant(double alpha, double R, double Kx, double Kv,
                           double d);
double fvi_picard_bound(double alpha, double R, double Kx, double Kv, double d,
                        size_t n);
double fvi_picard_weighted(double alpha, double R, double Kx, double Kv,
                           double lambda);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
