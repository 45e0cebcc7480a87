/* src/fvi/paper/legendre.h -- The discrete Legendre transformations, between two positions and a position
 * with a momentum.                                                                               [H 8] */
#ifndef FVI_LEGENDRE_H
#define FVI_LEGENDRE_H

#include <fvi/system.h>

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(default)

/* fvi_legendre_minus -- Compute F^-, the momentum at the beginning of a step.                    [(8.1)]
 *
 *     p_k^- = -D1 L_d(x_k, x_{k+1})
 *
 * fvi_legendre_plus -- Compute F^+, the momentum at the end of a step.                           [(8.2)]
 *
 *     p_{k+1}^+ = D2 L_d(x_k, x_{k+1}) - h rho D_{k+1} + h F_{k+1}
 *
 *   kappa  0 <= kappa <= 1
 *   h      step, finite, > 0
 *   x, y   x_k and x_{k+1}, d numbers each
 *   D      D_{k+1} = Delta_-^alpha Delta_-^alpha x_{k+1}, d numbers, or NULL for zero
 *   F      F(t_{k+1}), d numbers, or NULL for zero
 *   p      output, d numbers
 *
 *     double p[2];
 *     status = fvi_legendre_minus(&system, 0.5, h, x, y, p);       // p_k of a system with d = 2
 *
 * rho is the system's damping. Cost: one gradient of U.
 * Returns as fvi_discrete_slopes (discrete_mechanics.h): FVI_SUCCESS; what fvi_system_check returns;
 * FVI_EFAULT, also if p is NULL; FVI_EDOM if kappa or h is out of range; FVI_ENOMEM; what the potential
 * returned. On error p is untouched. */
int fvi_legendre_minus(const fvi_system *system, double kappa, double h,
                       const double *x, const double *y, double *p);
int fvi_legendre_plus(const fvi_system *system, double kappa, double h,
                      const double *x, const double *y, const double *D,
                      const double *F, double *p);

/* fvi_legendre_inverse -- Compute (F^-)^(-1): solve p = -D1 L_d(x_k, x_{k+1}) for x_{k+1}.        [(8.4)]
 *
 * With p = p_0 this is the first step of Algorithms 1 to 3. With p = p_k, after the momenta of two steps have
 * been matched, it is every other step.
 *
 *   kappa, h  as above
 *   x, p      x_k and p_k, d finite numbers each
 *   y         output x_{k+1}, d numbers
 *
 *     status = fvi_legendre_inverse(&system, 0.5, h, x, p, y);
 *
 * Cost: the equation of one step (fvi_stepper_step), and a factorisation in every call. So it suits a single
 * step, not a run.
 * Returns FVI_SUCCESS; what fvi_system_check returns; FVI_EMAXITER or FVI_ESING if the equation could not be
 * solved; what the potential returned; FVI_EFAULT if a pointer is NULL; FVI_EDOM if kappa or h is out of
 * range, m/h is not finite and > 0, or x or p is not finite; FVI_EOVRFLW if x_{k+1} is not finite;
 * FVI_ENOMEM. On error y is untouched. */
int fvi_legendre_inverse(const fvi_system *system, double kappa, double h,
                         const double *x, const double *p, double *y);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
