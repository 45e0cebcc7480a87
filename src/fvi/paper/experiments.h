/* src/fvi/paper/experiments.h -- Yardsticks for the numerical section.    [H 10] */
#ifndef FVI_EXPERIMENTS_H
#define FVI_EXPERIMENTS_H

#include <fvi/system.h>
#include <fvi/trajectory.h>

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(default)

/* fvi_damped_oscillator -- the linearly damped oscillator, solved. [(10.1)]
 *
 *     m x'' + rho x' + c x = 0,   x(0) = x0,   p = m x',   p(0) = p0
 *
 *   m       mass, > 0
 *   rho, c  damping and stiffness, >= 0
 *   x0, p0  start, finite
 *   t       time, finite, >= 0
 *   x, p    outputs, one number each; NULL for one that is not wanted
 *
 * Each of m, rho, c is to lie in [1e-140, 1e140] or, for rho and c, to be 0, so
 * that rho^2 and m c neither overflow nor vanish.
 *
 * Accuracy: x is off by at most
 *     (24 + 10 (L + w) t) u e^{-L t} ((1 + L g) |x0| + g |p0| / m),
 * p by the same with |p0| for |x0| and c |x0| for |p0| / m. Here u = 2^-53,
 * L and s are those of (10.1), w = s if the solution oscillates, else 0, and
 * g = min(t, 1 / s). No digits are lost near critical damping, where s
 * vanishes: rho^2 - 4 m c is formed with its last bits.
 *
 * Cost O(1). Returns FVI_SUCCESS; FVI_EFAULT if x and p are both NULL; FVI_EDOM
 * if an argument is out of range; FVI_EOVRFLW if the result is not finite. On
 * error the outputs are untouched. */
int fvi_damped_oscillator(double m, double rho, double c, double x0, double p0,
                          double t, double *x, double *p);

/* fvi_oscillator_errors -- the global errors of a method on it.    [(10.2)]
 *
 *     max_k |x_k - x(t_k)|,   max_k |p_k - p(t_k)|,   max_k |E_k - E(t_k)|
 *
 * over k = 0, ..., N, with E = p^2 / (2 m) + c x^2 / 2, kappa = 1/2,
 * alpha = 1/2, t_k = k h.
 *
 *   method  any that knows alpha = 1/2
 *   h, N    step, finite, > 0; number of steps, >= 1
 *   errors  output: the three numbers
 *   m, rho, c, x0, p0  as in fvi_damped_oscillator
 *
 * Nothing is stored over the steps. Cost: N steps of the method and N
 * exponentials. Returns FVI_SUCCESS; FVI_EFAULT if errors is NULL; what
 * fvi_stepper_start, fvi_stepper_step and fvi_damped_oscillator return. On error errors is
 * untouched. */
int fvi_oscillator_errors(const fvi_method *method, double m, double rho,
                          double c, double x0, double p0, double h, size_t N,
                          double errors[3]);

/* fvi_matrix_method -- Podlubny's matrix method for zero data.     [(10.9)]
 *
 *     m x'' + rho D^{2 alpha} x + c x = F,   x(0) = x'(0) = 0:
 *
 *     (m / h^2 B_2 + rho / h^{2 alpha} B_{2 alpha} + c I) x = F,   x_0 = x_1 = 0,
 *
 * with B_beta the lower triangular Toeplitz matrix of the weights of order beta
 * (H 4); the first two equations give way to the start.
 *
 *   m, rho, c  finite, m > 0, rho >= 0, c >= 0
 *   alpha      0 <= alpha <= 1
 *   force      F(t); a zeroed one is none
 *   h, N       step, finite, > 0; last index, N >= 2
 *   x          output, N + 1 numbers
 *
 * Row after row, by forward substitution: all rows are pieces of one, so the
 * matrix is not stored. Cost O(N^2) time, O(N) memory.
 * Returns FVI_SUCCESS; FVI_EFAULT if x is NULL; FVI_EINVAL if N < 2 or if N is
 * too large to be addressed; FVI_EDOM if a number is out of range; FVI_ENOMEM;
 * FVI_EOVRFLW if a value is not finite; what the force returned. On error x is
 * untouched. */
int fvi_matrix_method(double m, double rho, double c, double alpha,
                      fvi_force force, double h, size_t N, double *x);

/* fvi_matrix_method_simple -- the same as it is usually written: the triangular
 * matrix is filled and handed to GSL (gsl_blas_dtrsv). To read and to compare
 * with. Memory O(N^2): 128 MB for N = 4000, and FVI_EINVAL if (N + 1)^2 numbers
 * cannot be addressed. Else as fvi_matrix_method. */
int fvi_matrix_method_simple(double m, double rho, double c, double alpha,
                             fvi_force force, double h, size_t N, double *x);

/* fvi_observed_order -- the slope of log error against log h.      [(10.3)]
 *
 * The least-squares line log error = log K + order log h, by gsl_fit_linear.
 *
 *   n         points, n >= 2
 *   h, error  n numbers each, finite, > 0; the h not all equal
 *   order, K  outputs; NULL for one that is not wanted
 *
 * Cost O(n). Returns FVI_SUCCESS; FVI_EFAULT if h, error or both outputs are
 * NULL; FVI_EINVAL if n < 2 or if 2 n numbers cannot be addressed; FVI_EDOM if
 * a number is out of range or all h are equal; FVI_ENOMEM. On error the outputs
 * are untouched. */
int fvi_observed_order(size_t n, const double *h, const double *error,
                       double *order, double *K);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
