/* src/fvi/paper/legendre.h -- The discrete Legendre transformation.        [H 8] */
#ifndef FVI_LEGENDRE_H
#define FVI_LEGENDRE_H

#include <fvi/system.h>

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(default)

/* fvi_legendre_minus -- F^-: the momentum at the beginning of a step. [(8.1)]
 *
 *     p_k^- = -D1 L_d(x_k, x_{k+1})
 *
 * fvi_legendre_plus -- F^+: the momentum at its end.                 [(8.2)]
 *
 *     p_{k+1}^+ = D2 L_d(x_k, x_{k+1}) - h rho D_{k+1} + h F_{k+1}
 *
 *   kappa  0 <= kappa <= 1
 *   h      finite, > 0
 *   x, y   x_k and x_{k+1}, d numbers each
 *   D      Delta_-^alpha Delta_-^alpha x_{k+1}, d numbers, or NULL for zero
 *   F      F(t_{k+1}), d numbers, or NULL for zero
 *   p      output, d numbers
 *
 * rho is the system's damping. Cost: one gradient of U.
 * Returns what fvi_discrete_slopes returns; FVI_EFAULT if p is NULL. On error p
 * is untouched. */
int fvi_legendre_minus(const fvi_system *system, double kappa, double h,
                       const double *x, const double *y, double *p);
int fvi_legendre_plus(const fvi_system *system, double kappa, double h,
                      const double *x, const double *y, const double *D,
                      const double *F, double *p);

/* fvi_legendre_inverse -- (F^-)^(-1): x_{k+1} from p = -D1 L_d(x_k, x_{k+1}).
 *                                                                     [(8.4)]
 *
 * With p = p_0 it is the start of Algorithms 1 to 3; with p = p_k, matched, it
 * is their step.
 *
 *   x, p  d finite numbers each
 *   y     output x_{k+1}, d numbers
 *
 * Cost of the equation of a step (fvi_stepper_step), and a factorisation each time: for one
 * step, not for a run. Returns what fvi_system_check returns; FVI_EMAXITER or FVI_ESING
 * if the equation could not be solved; what the potential returned; FVI_EFAULT if a
 * pointer is NULL; FVI_EDOM if kappa or h is out of range, m/h is not finite and > 0, or
 * x or p is not finite; FVI_EOVRFLW if x_{k+1} is not finite; FVI_ENOMEM. On error
 * y is untouched. */
int fvi_legendre_inverse(const fvi_system *system, double kappa, double h,
                         const double *x, const double *p, double *y);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
