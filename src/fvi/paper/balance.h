/* src/fvi/paper/balance.h -- What a scheme with memory conserves, and which energy it loses.  [H 21]
 *
 * A motion is a sequence x_0, ..., x_N in R^d, stored vector after vector: component i of x_k is
 * x[k * d + i]. */
#ifndef FVI_BALANCE_H
#define FVI_BALANCE_H

#include <fvi/convolution_quadrature.h>
#include <fvi/system.h>

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(default)

/* fvi_balance_scheme -- one of the schemes of (21.1), as data.
 *
 *   system  its masses, dampings and potential are read; its force is not
 *   alpha   the damping has the order 2 alpha, 0 <= alpha <= 1
 *   kappa   potential at kappa x_k + (1 - kappa) x_{k+1}, 0 <= kappa <= 1
 *   h       step, finite, > 0
 *   weights FVI_DELTA_EULER or FVI_DELTA_BDF2: sum_n w_n z^n = delta(z)^(2 alpha)
 *   theta   the damping force at node k is rho ((1 - theta) D_k + theta D_{k+1}), where D_k is the
 *           derivative of order 2 alpha at node k; 0 <= theta <= 1
 *
 * Three methods of the library have this form: fvi_fractional with EULER and theta = 0, fvi_cq2_shifted with
 * EULER and theta = alpha, fvi_cq_bdf2 with BDF2 and theta = 0. */
typedef struct {
    const fvi_system *system;
    double alpha, kappa, h;
    fvi_delta weights;
    double theta;
} fvi_balance_scheme;

/* fvi_green_form -- Pair a solution of the linearised scheme with a solution of the transposed one.  [(21.4)]
 *
 *     C_n = v_n . K_{n,n+1} u_{n+1} - u_n . K_{n,n+1} v_{n+1}
 *           + sum_{k <= n < j} (v_j . T_{jk} u_k - v_k . T_{kj} u_j)
 *
 * for n = 0, ..., N - 1. If u solves the scheme linearised about x, and v the transpose of that
 * linear scheme, all C_n are equal: the form is conserved.
 *
 *   N     steps, N >= 1
 *   x     the trajectory, (N + 1) d numbers; NULL if U is quadratic
 *   u, v  (N + 1) d numbers each
 *   C     output, N numbers; must not overlap u or v
 *
 *     const fvi_balance_scheme scheme = { &system, 0.3, 0.5, h, FVI_DELTA_EULER, 0 };
 *     status = fvi_green_form(&scheme, N, x, u, v, C);
 *
 * Plain sums. Cost O(N^2 d + N d^2) and N Hessians; memory O(N d + d^2).
 * Accuracy: to first order in 2^-53, C_n is off by at most (N + d + 16) 2^-53 times the sum of the
 * absolute values of its terms, with (1 - theta) |w_n| + theta |w_{n+1}| for the weights in T. The
 * result is exact where all terms are short binary fractions. The weights of BDF2 have an error of
 * their own, 40 2^-53 max |w|, which comes on top.
 * Returns FVI_SUCCESS; what fvi_system_check returns; FVI_EFAULT if scheme, u, v or C is NULL;
 * FVI_EDOM if alpha, kappa, h or theta is out of range; FVI_EINVAL if N == 0, if weights is neither
 * EULER nor BDF2, or if 2 (N + 2) d numbers cannot be addressed; FVI_ENOMEM; or what the potential
 * returned. After an error of the potential C holds no result; after every other error C is
 * untouched. */
int fvi_green_form(const fvi_balance_scheme *scheme, size_t N, const double *x,
                   const double *u, const double *v, double *C);

/* fvi_scheme_energy -- Compute the energy that the scheme balances, and the part of it that can
 * only fall.                                                                  [(12.15), (12.16)]
 *
 *     E_{k+1/2} = d . (m - h^2 (1 - 2 kappa)^2 U''/4) d / (2 h^2) + U(mid),
 *     hat_{k+1/2} = E_{k+1/2} - h^(-2 alpha) chi(-1) d . rho d / 8,
 *
 * where d = x_{k+1} - x_k, mid = (x_k + x_{k+1})/2, and U'' is the Hessian at mid. The symbol of the
 * damping at z = -1 is chi(-1) = 4^alpha (1 - 2 theta) for EULER and 16^alpha (1 - 2 theta) for BDF2.
 *
 *   N    steps, N >= 1
 *   x    the trajectory, (N + 1) d numbers
 *   E    output, N numbers: E[k] is E_{k+1/2}
 *   hat  output, N numbers
 *
 * The theorems about E and hat need a quadratic U. For kappa = 1/2 both are defined for every U.
 * Cost O(N d) and N values of U; N Hessians more, O(N d^2), if kappa is not 1/2. Rounding errors: at
 * most (2 d + 16) 2^-53 times the sum of the absolute values of the terms.
 * Returns as fvi_green_form, with x, E and hat for the pointers; FVI_EOVRFLW if an energy is not
 * finite. After FVI_EOVRFLW or an error of the potential E and hat hold no result; after every other
 * error they are untouched. */
int fvi_scheme_energy(const fvi_balance_scheme *scheme, size_t N,
                      const double *x, double *E, double *hat);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
