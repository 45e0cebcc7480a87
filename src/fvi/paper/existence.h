/* src/fvi/paper/existence.h -- Picard iteration for motion with memory.                    [H 15]
 *
 * The equation of motion
 *
 *     x' = v,   v' = f(x, v) - R D_-^{2 alpha} (x - x0),   R = rho / m,
 *
 * integrated once, says that v is a fixed point, v = T v, of the Picard map                 [(15.4)]
 *
 *     (T v)(t) = v0 + int_0^t f(x, v) ds - R (I_-^gamma v)(t),
 *     x = x0 + I_- v,    gamma = 2 - 2 alpha.
 *
 * The functions below compute one iteration of T on a grid, and bounds on its convergence. */
#ifndef FVI_EXISTENCE_H
#define FVI_EXISTENCE_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(default)

/* fvi_fractional_integral -- Compute I_-^gamma of a piecewise linear function.             [(15.10)]
 *
 *     out_k = 1/Gamma(gamma) int_0^{t_k} (t_k - s)^(gamma-1) v(s) ds,  t_k = k h,
 *
 * for k = 0, ..., N, exactly, where v is linear between the values v(t_j) = v_j. This is the product
 * trapezoidal rule: its weights are positive and integrate 1 and t exactly. For gamma = 1 it is the
 * trapezoidal rule, for gamma = 0 the identity.
 *
 *   gamma  order, 0 <= gamma <= 2
 *   h      step, finite, > 0
 *   N      number of steps, N >= 1
 *   v      N + 1 numbers
 *   out    output, N + 1 numbers, owned by the caller, must not overlap v
 *
 *     status = fvi_fractional_integral(0.5, h, N, v, half_integral);
 *
 * Cost O(N^2), memory O(N). Rounding error of out_k: at most (k + 40) u out_k(|v|), where u = 2^-53 and
 * out_k(|v|) is the result for |v_j|.
 * Returns FVI_SUCCESS; FVI_EFAULT if v or out is NULL; FVI_EINVAL if N == 0 or 4 (N + 1) numbers cannot
 * be addressed; FVI_EDOM if gamma or h is out of range; FVI_ENOMEM. On error out is untouched. */
int fvi_fractional_integral(double gamma, double h, size_t N, const double *v,
                            double *out);

/* fvi_picard_problem -- the acceleration, the damping and the start of a body in one dimension.
 *
 *   f       acceleration without the memory; in mechanics -U'(x)/m
 *   params  handed to f, owned by the caller, may be NULL
 *   alpha   the memory has the order 2 alpha, 0 <= alpha <= 1 (the theorem needs alpha < 1)
 *   R       rho / m, finite, >= 0
 *   x0, v0  initial position and velocity, finite */
typedef struct {
    double (*f)(double x, double v, const void *params);
    const void *params;
    double alpha, R, x0, v0;
} fvi_picard_problem;

/* fvi_picard -- Compute one iteration, next = T_h v, on a grid.                             [(15.4)]
 *
 * T_h is T with its three integrals taken by fvi_fractional_integral: the integrals for x and of f with
 * order 1, the memory with order gamma.
 *
 *   p        the problem
 *   h, N     step, finite, > 0; number of steps, N >= 1
 *   v        N + 1 velocities at t_k = k h: any guess, or an earlier iterate
 *   x        output, N + 1 positions: x0 + I_- v; must not overlap v
 *   next     output, N + 1 velocities; must not overlap v or x
 *
 *     for (int n = 0; n < 20 && !status; n++, memcpy(v, next, (N + 1) * sizeof *v))
 *         status = fvi_picard(&problem, h, N, v, x, next);
 *
 * The iterates converge to the fixed point of T_h. Its distance from the solution at a fixed t is
 * O(h^2), or O(h^(1 + gamma)) if gamma < 1. Cost O(N^2), memory O(N).
 * Returns FVI_SUCCESS; FVI_EFAULT if a pointer or p->f is NULL; FVI_EINVAL if N == 0 or 4 (N + 1) numbers
 * cannot be addressed; FVI_EDOM if h or a number of the problem is out of range; FVI_ENOMEM: then x and
 * next are untouched. FVI_EOVRFLW if a value is not finite: then x and next hold the values as computed. */
int fvi_picard(const fvi_picard_problem *p, double h, size_t N, const double *v,
               double *x, double *next);

/* fvi_picard_constant -- Return a Lipschitz constant of T in the maximum norm on [0, d]: T contracts
 * if the constant is below 1.                                                                [(15.5)]
 *
 *     q(d) = Kx d^2 / 2 + Kv d + R d^gamma / Gamma(1 + gamma),
 *
 * fvi_picard_bound -- Return the Lipschitz constant of n iterations together,                [(15.8)]
 *
 *     e_n(d) = sum_{i+j+k=n} n!/(i! j! k!) Kx^i Kv^j R^k
 *              d^(2i + j + gamma k) / Gamma(1 + 2i + j + gamma k),
 *
 * fvi_picard_weighted -- Return the Lipschitz constant of T in the norm sup e^(-lambda t) |v(t)|.  [(15.7)]
 *
 *     q_lambda = Kx / lambda^2 + Kv / lambda + R / lambda^gamma
 *
 *   alpha   in [0, 1]; gamma = 2 - 2 alpha
 *   R       rho / m
 *   Kx, Kv  Lipschitz constants of f: |f(x,v) - f(x~,v~)| <= Kx |x - x~| + Kv |v - v~|
 *   d       length of the interval
 *   lambda  > 0
 *   n       number of iterations, n >= 0
 *
 * For example, Kx = 1, Kv = R = 0 and d = 1 have q = 1/2 and e_2 = 1/24.
 *
 * All numbers must be finite and >= 0; the functions do not check them. Relative error: below 40 u for q,
 * below 10 (n + 10) ln(n + 10) u for e_n, u = 2^-53. Cost O(1) for q and q_lambda, O(n^2) for e_n. */
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
