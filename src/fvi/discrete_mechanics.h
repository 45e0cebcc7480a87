/* src/fvi/discrete_mechanics.h -- The discrete Lagrangian of one step, the integrators that follow from it, and Euler's
 * methods for comparison.                                          [H 2]
 *
 * A variational integrator makes the sum of the discrete Lagrangians L_d(x_k, x_{k+1}) stationary. */
#ifndef FVI_DISCRETE_MECHANICS_H
#define FVI_DISCRETE_MECHANICS_H

#include "trajectory.h"

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(default)

/* fvi_discrete_lagrangian -- compute the discrete Lagrangian, the action of one step.                [(2.5)]
 *
 *     L_d(x, y) = (y - x) . m (y - x) / (2 h) - h U(kappa x + (1 - kappa) y)
 *
 *   x, y   positions at both ends of the step, d numbers each
 *   kappa  0 <= kappa <= 1
 *   h      finite, > 0
 *   L      output, one number
 *
 *     const double x = 0, y = 1;
 *     double L;
 *     fvi_discrete_lagrangian(&system, 0.5, 1, &x, &y, &L);   // m = 1, U = x^2/2: L = 1/2 - 1/8 = 0.375
 *
 * Cost: one value of U. Returns FVI_SUCCESS; what fvi_system_check returns; FVI_EFAULT if a pointer is NULL; FVI_EDOM
 * if kappa or h is out of range; FVI_ENOMEM; what the potential returned. On error L is untouched. */
int fvi_discrete_lagrangian(const fvi_system *system, double kappa, double h,
                            const double *x, const double *y, double *L);

/* fvi_discrete_slopes -- compute the derivatives D1 L_d and D2 L_d of the discrete Lagrangian by x and y.   [(2.6)]
 *
 *     D1 = -m (y - x) / h -    kappa    h grad U(kappa x + (1 - kappa) y)
 *     D2 =  m (y - x) / h - (1 - kappa) h grad U(kappa x + (1 - kappa) y)
 *
 *   system, kappa, h, x, y  as for fvi_discrete_lagrangian
 *   D1, D2  outputs, d numbers each; NULL for one that is not wanted
 *
 *     double D1, D2;
 *     fvi_discrete_slopes(&system, 0.5, 1, &x, &y, &D1, &D2);   // the step above: -1.25 and 0.75
 *
 * Cost: one gradient of U. Returns FVI_SUCCESS; what fvi_system_check returns; FVI_EFAULT if x or y is NULL; FVI_EDOM
 * and FVI_ENOMEM as fvi_discrete_lagrangian; what the potential returned. On error D1 and D2 are untouched. */
int fvi_discrete_slopes(const fvi_system *system, double kappa, double h,
                        const double *x, const double *y, double *D1,
                        double *D2);

/* fvi_midpoint_variational -- Algorithm 1. A step solves D1 L_d(x_k, x_{k+1}) + D2 L_d(x_{k-1}, x_k) = 0 for x_{k+1},
 * and the first step solves p_0 = -D1 L_d(x_0, x_1) for x_1. Symplectic. Order 2 for kappa = 1/2, else 1.
 * fvi_stepper_start refuses damping and force (FVI_EINVAL), which have no place in Algorithm 1. */
extern const fvi_method fvi_midpoint_variational;

/* fvi_lagrange_dalembert -- Algorithm 2 with f^- = 0 and f^+ = -rho (x_{k+1} - x_k) + h F(t_{k+1}): the forced
 * integrator of Lagrange and d'Alembert for linear damping. Only alpha = 1/2 (FVI_EDOM). Order 1; order 2 for
 * kappa = 1/2, rho = 0, F = 0. */
extern const fvi_method fvi_lagrange_dalembert;

/* fvi_euler_explicit, fvi_euler_implicit -- Euler's methods for x' = p/m, p' = -grad U(x) - rho p/m + F(t), for
 * comparison. Only alpha = 1/2 (FVI_EDOM). Order 1. kappa is not used. */
extern const fvi_method fvi_euler_explicit;
extern const fvi_method fvi_euler_implicit;

/* fvi_variational_solver -- for the authors of methods: make the solver s->newton of
 *
 *     p_k = -D1 L_d(x_k, x_k + dx)     for dx.
 *
 * The stepper s owns the solver. Returns FVI_SUCCESS; FVI_ENOMEM; FVI_EDOM if m/h is not finite and > 0; FVI_ESING if U
 * is quadratic and the matrix of the equation is singular; what the Hessian returned. */
int fvi_variational_solver(fvi_stepper *s);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
