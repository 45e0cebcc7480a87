/* src/fvi/paper/discrete_principle.h -- The action of two discrete curves with fractional damping, and
 * its gradient.                                                                               [H 6]
 *
 * The two curves are x_0, ..., x_N and y_0, ..., y_N in R^d, stored vector after vector: component i
 * of x_k is x[k * d + i]. */
#ifndef FVI_DISCRETE_PRINCIPLE_H
#define FVI_DISCRETE_PRINCIPLE_H

#include <fvi/system.h>

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(default)

/* fvi_discrete_action -- Compute the action that the discrete principle makes stationary.   [(6.2)]
 *
 *     S_d = sum_{k=0}^{N-1} L_d(x_k, x_{k+1}) + L_d(y_k, y_{k+1})
 *           - h sum_{k=first}^{last} Delta_-^alpha x_k . rho Delta_+^alpha y_k
 *
 *   system       rho is its damping. Its force is not read, because an action has no place for it
 *   alpha        order of Delta_- and Delta_+, 0 <= alpha <= 1; the damping then has the order 2 alpha
 *   kappa        potential at kappa x_k + (1 - kappa) x_{k+1}, 0 <= kappa <= 1
 *   h            step, finite, > 0
 *   N            number of steps, N >= 1
 *   first, last  range of the fractional sum, first <= last <= N. The paper prints 0 and N - 1; its
 *                Remark 4.5 takes 1 and N. Only 0 and N give the equations of its Theorem 4.1 for all
 *                values at the ends
 *   x, y         (N + 1) d numbers each
 *   S            output, one number
 *
 *     double S;
 *     status = fvi_discrete_action(&system, 0.3, 0.5, h, N, 0, N, x, y, &S);
 *
 * A body with a past has x - zeta and y - zeta' in the fractional sum. To compute its action, add two
 * values of this function: the one for x and y without damping, and the contribution of the damping to
 * the one for x - zeta and y - zeta' without a potential. The gradient is computed in the same way. For
 * such a body the ranges 0 or 1 to N - 1 or N all give the same equations.             [(6.10), (6.11)]
 *
 * Cost O(N^2 d) and 2 N values of U; memory O(N d).
 * Returns FVI_SUCCESS; what fvi_system_check returns; FVI_EFAULT if a pointer is NULL; FVI_EDOM if
 * alpha, kappa or h is out of range; FVI_EINVAL if N == 0, if not first <= last <= N, or if
 * 4 (N + 1) d numbers cannot be addressed; FVI_ENOMEM; what the potential returned. On error S is
 * untouched. */
int fvi_discrete_action(const fvi_system *system, double alpha, double kappa,
                        double h, size_t N, size_t first, size_t last,
                        const double *x, const double *y, double *S);

/* fvi_discrete_action_gradient -- Compute the derivatives of this action by every x_k and y_k. [(6.5)]
 *
 * gx_k = D1 L_d(x_k, x_{k+1}) + D2 L_d(x_{k-1}, x_k)
 *        - h rho h^(-alpha) sum_{i=max(k,first)}^{last} alpha_{i-k} Delta_+ y_i
 * gy_k = D1 L_d(y_k, y_{k+1}) + D2 L_d(y_{k-1}, y_k)
 *        - h rho h^(-alpha) sum_{i=first}^{min(k,last)} alpha_{k-i} Delta_- x_i
 *
 * for k = 0, ..., N. A term that does not exist at an end (D1 at N, D2 at 0) is left out. The sums are
 * those of the proof, without any shortcut. If all variations are allowed, a stationary action has
 * gx_k = gy_k = 0 for 0 < k < N; if the variations are restricted, it has gx_k + gy_k = 0.
 *
 *   gx, gy  outputs, (N + 1) d numbers each; must not overlap x or y
 *
 * All other arguments are those of fvi_discrete_action. Cost O(N^2 d) and 2 N gradients of U. Rounding
 * errors: each number is off by at most (2 N + 16) u times the sum of the absolute values of its terms,
 * u = 2^-53.
 * Returns FVI_SUCCESS, or FVI_EFAULT, FVI_EINVAL, FVI_EDOM, FVI_ENOMEM or a code of the system's, as
 * fvi_discrete_action does. On error gx and gy are untouched. */
int fvi_discrete_action_gradient(const fvi_system *system, double alpha,
                                 double kappa, double h, size_t N, size_t first,
                                 size_t last, const double *x, const double *y,
                                 double *gx, double *gy);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
