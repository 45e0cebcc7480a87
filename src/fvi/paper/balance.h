/* src/fvi/paper/balance.h -- What a scheme with memory conserves, and what it loses.
 *                                                                [H 21]
 * Sequences x_0, ..., x_N in R^d are laid out as in integration_by_parts.h: component
 * i of x_k is x[k * d + i]. */
#ifndef FVI_BALANCE_H
#define FVI_BALANCE_H

#include <fvi/convolution_quadrature.h>
#include <fvi/system.h>

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(default)

/* fvi_balance_scheme -- one of the three schemes of (21.1), as data.
 *
 *   system  its masses, dampings and potential; the force takes no part
 *   alpha   the damping is of order 2 alpha, 0 <= alpha <= 1
 *   kappa   potential at kappa x_k + (1 - kappa) x_{k+1}, 0 <= kappa <= 1
 *   h       step, finite, > 0
 *   weights EULER or BDF2: sum_n w_n z^n = delta(z)^(2 alpha)
 *   theta   the damping of node k is rho ((1 - theta) D_k + theta D_{k+1}),
 *           0 <= theta <= 1
 *
 * fvi_fractional is { EULER, 0 }, fvi_cq2_shifted { EULER, alpha }, fvi_cq_bdf2 { BDF2, 0 }. */
typedef struct {
    const fvi_system *system;
    double alpha, kappa, h;
    fvi_delta weights;
    double theta;
} fvi_balance_scheme;

/* fvi_green_form -- what pairs a forward with a backward variation.    [(21.4)]
 *
 *     C_n = v_n . K_{n,n+1} u_{n+1} - u_n . K_{n,n+1} v_{n+1}
 *           + sum_{k <= n < j} (v_j . T_{jk} u_k - v_k . T_{kj} u_j)
 *
 * for n = 0, ..., N - 1. All C_n are equal if u solves the scheme linearised about x,
 * and v its transpose.
 *
 *   N     steps, N >= 1
 *   x     the trajectory, (N + 1) d numbers; NULL if U is quadratic
 *   u, v  (N + 1) d numbers each
 *   C     output, N numbers; must not overlap u or v
 *
 * Plain sums, cost O(N^2 d + N d^2) and N Hessians; memory O(N d + d^2). To first order in
 * 2^-53, C_n is off by at most (N + d + 16) 2^-53 times the sum of the sizes of its
 * terms, where T stands for (1 - theta) |w_n| + theta |w_{n+1}|; exact where all of
 * them are short binary fractions. (BDF2: the weights' own 40 2^-53 max |w| comes on top.)
 * Returns FVI_SUCCESS; what fvi_system_check returns; FVI_EFAULT if a pointer is NULL;
 * FVI_EDOM if alpha, kappa, h or theta is out of range; FVI_EINVAL if N == 0, if the
 * weights are none of the two, or if 2 (N + 2) d numbers cannot be addressed;
 * FVI_ENOMEM; what the potential returned, C is then of no use. Else, on error, C is
 * untouched. */
int fvi_green_form(const fvi_balance_scheme *scheme, size_t N, const double *x,
                   const double *u, const double *v, double *C);

/* fvi_scheme_energy -- the energy that the scheme itself balances, and what of it can
 * only fall.                                                  [(12.15), (12.16)]
 *
 *     E_{k+1/2} = d . (m - h^2 (1 - 2 kappa)^2 U''/4) d / (2 h^2) + U(mid),
 *     hat_{k+1/2} = E_{k+1/2} - h^(-2 alpha) chi(-1) d . rho d / 8,
 *
 * d = x_{k+1} - x_k, mid = (x_k + x_{k+1})/2, U'' there; chi(-1) = 4^alpha (1 - 2 theta)
 * for EULER, 16^alpha (1 - 2 theta) for BDF2.
 *
 *   N    steps, N >= 1
 *   x    the trajectory, (N + 1) d numbers
 *   E    output, N numbers: E[k] is E_{k+1/2}
 *   hat  output, N numbers
 *
 * What is proved of them needs a quadratic U; with kappa = 1/2 they are defined for
 * any. Cost O(N d) and N values of U; N Hessians, O(N d^2), if kappa is not 1/2.
 * Rounding: (2 d + 16) 2^-53 times the sum of the sizes of the terms. Errors as
 * fvi_green_form; likewise E and hat. */
int fvi_scheme_energy(const fvi_balance_scheme *scheme, size_t N,
                      const double *x, double *E, double *hat);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
