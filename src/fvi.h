/* src/fvi.h -- Fractional variational integrators.               [Chapter 9] */
#ifndef FVI_H
#define FVI_H

#include "trajectory.h"

/* fvi_fractional -- Algorithm 3, the fractional variational integrator. [(9.4)]
 *
 *     D1 L_d(x_k, x_{k+1}) + D2 L_d(x_{k-1}, x_k)
 *         - h rho Delta_-^alpha Delta_-^alpha x_k + h F(t_k) = 0,
 *     p_0 = -D1 L_d(x_0, x_1),
 *
 * in R^d with diagonal m and rho, any potential, any kappa and alpha in [0, 1].
 * Done in momentum form, which is the same equation with the smallest rounding:
 * p_k = -D1 L_d(x_k, x_k + dx) gives dx, then
 *
 *     x_{k+1} = x_k + dx,
 *     p_{k+1} = p_k - h grad U - h rho Delta_-^alpha Delta_-^alpha x_{k+1}
 *               + h F(t_{k+1}).
 *
 * p_k is the matched momentum of Chapter 8 for every k <= N. Order 1; in p near
 * t = 0 only 2 - 2 alpha for a held body with alpha > 1/2 (19.11);
 * for Riemann-Liouville runs with x0 != 0 only 1 - 2 alpha if alpha < 1/2, and
 * none if alpha > 1/2 (9.5); order 2 for rho = 0, kappa = 1/2, F(0) = 0 (9.8).
 * run->past says on what the memory acts (9.6).
 * Steps must be short enough (fvi_stability_step); at alpha = 1 and rho >= m none is.
 * Cost of a step: as fvi_newton_solve plus as fvi_memory_push for the damped
 * coordinates. rho = 0 has no memory at all. */
extern const fvi_method fvi_fractional;

/* fvi_algorithm_3 -- the same, as the paper prints it, in one dimension: the
 * three-term equation, positions only, the memory as the product of two weight
 * sequences. To read and to compare with.                              [(9.2)]
 *
 *   system        d == 1
 *   kappa, alpha  in [0, 1]
 *   h             finite, > 0
 *   N             steps, N >= 1
 *   x0, p0        start
 *   x             output, N + 1 numbers
 *
 * Riemann-Liouville. Cost O(N^2), memory O(N). Returns GSL_SUCCESS; what
 * fvi_start returns; GSL_EINVAL if d != 1 or if 2 N + 2 numbers cannot be
 * addressed; GSL_EMAXITER, GSL_ESING and GSL_EOVRFLW as fvi_step; GSL_ENOMEM. On
 * error x is untouched. */
int fvi_algorithm_3(const fvi_system *system, double alpha, double kappa,
                    double h, size_t N, double x0, double p0, double *x);

#endif
