/* src/fvi/discrete_mechanics.h -- Discrete Lagrangians and the integrators that
 * they give; Euler's methods beside them.                        [H 2] */
#ifndef FVI_DISCRETE_MECHANICS_H
#define FVI_DISCRETE_MECHANICS_H

#include "trajectory.h"

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(default)

/* fvi_discrete_lagrangian -- the action of one step.                [(2.5)]
 *
 *     L_d(x, y) = (y - x) . m (y - x) / (2 h) - h U(kappa x + (1 - kappa) y)
 *
 *   x, y   positions at both ends of the step, d numbers each
 *   kappa  0 <= kappa <= 1
 *   h      finite, > 0
 *   L      output, one number
 *
 * Cost: one value of U. Returns FVI_SUCCESS; what fvi_system_check returns;
 * FVI_EFAULT if a pointer is NULL; FVI_EDOM if kappa or h is out of range;
 * FVI_ENOMEM; what the potential returned. On error L is untouched. */
int fvi_discrete_lagrangian(const fvi_system *system, double kappa, double h,
                            const double *x, const double *y, double *L);

/* fvi_discrete_slopes -- its derivatives D_1 L_d and D_2 L_d.       [(2.6)]
 *
 *     D1 = -m (y - x) / h -    kappa    h grad U(kappa x + (1 - kappa) y)
 *     D2 =  m (y - x) / h - (1 - kappa) h grad U(kappa x + (1 - kappa) y)
 *
 *   D1, D2  outputs, d numbers each; NULL for one that is not wanted
 *
 * Cost: one gradient of U. Returns FVI_SUCCESS; what fvi_system_check returns;
 * FVI_EFAULT, FVI_EDOM and FVI_ENOMEM as above; what the potential returned. On error
 * D1 and D2 are untouched. */
int fvi_discrete_slopes(const fvi_system *system, double kappa, double h,
                        const double *x, const double *y, double *D1,
                        double *D2);

/* Algorithm 1: x_{k+1} from D1 L_d(x_k, x_{k+1}) + D2 L_d(x_{k-1}, x_k) = 0,
 * x_1 from p_0 = -D1 L_d(x_0, x_1). Symplectic. Refuses damping and force
 * (FVI_EINVAL): it has no place for them. Order 2 for kappa = 1/2, else 1. */
extern const fvi_method fvi_midpoint_variational;

/* Algorithm 2 with f^- = 0 and f^+ = -rho (x_{k+1} - x_k) + h F(t_{k+1}), the
 * forced (Lagrange-d'Alembert) integrator for linear damping. alpha = 1/2 only
 * (FVI_EDOM). Order 1; order 2 for kappa = 1/2, rho = 0, F = 0. */
extern const fvi_method fvi_lagrange_dalembert;

/* Euler's methods for x' = p/m, p' = -grad U(x) - rho p/m + F(t), the baselines.
 * alpha = 1/2 only (FVI_EDOM). Order 1. kappa is not used. */
extern const fvi_method fvi_euler_explicit;
extern const fvi_method fvi_euler_implicit;

/* fvi_variational_solver -- for methods: s->newton solves
 * p_k = -D1 L_d(x_k, x_k + dx) for dx. Returns FVI_SUCCESS; FVI_ENOMEM; FVI_EDOM if
 * m/h is not finite and > 0; FVI_ESING if U is quadratic and the matrix singular; what
 * the Hessian returned. */
int fvi_variational_solver(fvi_stepper *s);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
