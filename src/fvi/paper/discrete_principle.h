/* src/fvi/paper/discrete_principle.h -- The non-local discrete action and its gradient.
 *                                                                 [H 6]
 * Two discrete curves x_0, ..., x_N and y_0, ..., y_N in R^d, laid out as in
 * integration_by_parts.h: component i of x_k is x[k * d + i]. */
#ifndef FVI_DISCRETE_PRINCIPLE_H
#define FVI_DISCRETE_PRINCIPLE_H

#include <fvi/system.h>

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(default)

/* fvi_discrete_action -- what the discrete principle makes stationary. [(6.2)]
 *
 *     S_d = sum_{k=0}^{N-1} L_d(x_k, x_{k+1}) + L_d(y_k, y_{k+1})
 *           - h sum_{k=first}^{last} Delta_-^alpha x_k . rho Delta_+^alpha y_k
 *
 *   system       rho is its damping; its force takes no part in an action
 *   alpha        order of Delta_-, Delta_+, 0 <= alpha <= 1: damping of 2 alpha
 *   kappa        potential at kappa x_k + (1 - kappa) x_{k+1}, 0 <= kappa <= 1
 *   h            step, finite, > 0
 *   N            steps, N >= 1
 *   first, last  range of the fractional sum, first <= last <= N. The paper
 *                prints 0, N - 1; its Remark 4.5 takes 1, N; only 0, N gives
 *                the equations of its Theorem 4.1 whatever the ends are
 *   x, y         (N + 1) d numbers each
 *   S            output, one number
 *
 * A body with a past has x - zeta and y - zeta' in the fractional sum. Its
 * action is S_d of x, y without damping, and what the damping adds to that of
 * x - zeta, y - zeta' without potential; its gradient likewise. The ranges 0 or
 * 1 to N - 1 or N then all give the same equations.           [(6.10), (6.11)]
 *
 * Cost O(N^2 d) and 2 N values of U; memory O(N d).
 * Returns FVI_SUCCESS; what fvi_system_check returns; FVI_EFAULT if a pointer
 * is NULL; FVI_EDOM if alpha, kappa or h is out of range; FVI_EINVAL if N == 0,
 * if not first <= last <= N, or if 4 (N + 1) d numbers cannot be addressed;
 * FVI_ENOMEM; what the potential returned. On error S is untouched. */
int fvi_discrete_action(const fvi_system *system, double alpha, double kappa,
                        double h, size_t N, size_t first, size_t last,
                        const double *x, const double *y, double *S);

/* fvi_discrete_action_gradient -- its derivatives, by the sums of the proof and
 * nothing more clever.                                              [(6.5)]
 *
 * gx_k = D1 L_d(x_k, x_{k+1}) + D2 L_d(x_{k-1}, x_k)
 *        - h rho h^(-alpha) sum_{i=max(k,first)}^{last} alpha_{i-k} Delta_+ y_i
 * gy_k = D1 L_d(y_k, y_{k+1}) + D2 L_d(y_{k-1}, y_k)
 *        - h rho h^(-alpha) sum_{i=first}^{min(k,last)} alpha_{k-i} Delta_- x_i
 *
 * for k = 0, ..., N; what does not exist at an end (D1 at N, D2 at 0) is left
 * out. Under unrestricted variations both must vanish for 0 < k < N, under
 * restricted ones their sum.
 *
 *   gx, gy  outputs, (N + 1) d numbers each, must not overlap x or y
 *
 * The other arguments, the cost and the errors (FVI_EFAULT, FVI_EINVAL, FVI_EDOM,
 * FVI_ENOMEM, what the potential returned) are those of fvi_discrete_action, with
 * gradients of U for its values. On error gx and gy are untouched. Rounding: each number
 * is off by at most (2 N + 16) u times the sum of the sizes of its terms. */
int fvi_discrete_action_gradient(const fvi_system *system, double alpha,
                                 double kappa, double h, size_t N, size_t first,
                                 size_t last, const double *x, const double *y,
                                 double *gx, double *gy);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
