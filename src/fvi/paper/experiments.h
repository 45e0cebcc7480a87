/* src/fvi/paper/experiments.h -- Exact motions and reference methods for the numerical section of the
 * paper.                                                                                       [H 10] */
#ifndef FVI_EXPERIMENTS_H
#define FVI_EXPERIMENTS_H

#include <fvi/system.h>
#include <fvi/trajectory.h>

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(default)

/* fvi_damped_oscillator -- Compute the exact motion of the linearly damped oscillator.      [(10.1)]
 *
 *     m x'' + rho x' + c x = 0,   x(0) = x0,   p = m x',   p(0) = p0
 *
 *   m       mass, > 0
 *   rho, c  damping and stiffness, >= 0
 *   x0, p0  initial position and momentum, finite
 *   t       time, finite, >= 0
 *   x, p    outputs, one number each; NULL for an output that is not wanted
 *
 * m must lie in [1e-140, 1e140]; rho and c must lie there or be 0. Then rho^2 and m c neither overflow nor
 * vanish.
 *
 *     double x, p;
 *     if (fvi_damped_oscillator(1, 0.2, 4, 1, 0, 3, &x, &p) == FVI_SUCCESS)
 *         printf("%g %g\n", x, p);
 *
 * Accuracy: x is off by at most
 *     (24 + 10 (L + w) t) u e^{-L t} ((1 + L g) |x0| + g |p0| / m),
 * and p by at most the same expression with |p0| for |x0| and c |x0| for |p0| / m. Here u = 2^-53, L and s
 * are the L and s of (10.1), w = s if the solution oscillates and w = 0 otherwise, and g = min(t, 1 / s).
 * No digits are lost near critical damping, where s vanishes, because rho^2 - 4 m c is computed with its
 * last bits.
 *
 * Cost O(1). Returns FVI_SUCCESS; FVI_EFAULT if x and p are both NULL; FVI_EDOM if an argument is out of
 * range; FVI_EOVRFLW if the result is not finite. On error the outputs are untouched. */
int fvi_damped_oscillator(double m, double rho, double c, double x0, double p0,
                          double t, double *x, double *p);

/* fvi_oscillator_errors -- Run a method on this oscillator and compute its global errors.   [(10.2)]
 *
 *     max_k |x_k - x(t_k)|,   max_k |p_k - p(t_k)|,   max_k |E_k - E(t_k)|
 *
 * over k = 0, ..., N, with E = p^2 / (2 m) + c x^2 / 2, kappa = 1/2, alpha = 1/2 and t_k = k h.
 *
 *   method  any method that takes alpha = 1/2
 *   h, N    step, finite, > 0; number of steps, >= 1
 *   errors  output: the three numbers
 *   m, rho, c, x0, p0  as in fvi_damped_oscillator
 *
 *     double errors[3];
 *     status = fvi_oscillator_errors(&fvi_fractional, 1, 0.2, 4, 1, 0, 0.01, 1000, errors);
 *
 * The function stores no rows. Cost: N steps of the method and N exponentials.
 * Returns FVI_SUCCESS; FVI_EFAULT if errors is NULL; what fvi_stepper_start, fvi_stepper_step,
 * fvi_damped_oscillator and fvi_energy return. On error errors is untouched. */
int fvi_oscillator_errors(const fvi_method *method, double m, double rho,
                          double c, double x0, double p0, double h, size_t N,
                          double errors[3]);

/* fvi_matrix_method -- Run Podlubny's matrix method from a start at rest at 0.              [(10.9)]
 *
 *     m x'' + rho D^{2 alpha} x + c x = F,   x(0) = x'(0) = 0,
 *
 * becomes the linear system
 *
 *     (m / h^2 B_2 + rho / h^{2 alpha} B_{2 alpha} + c I) x = F,   x_0 = x_1 = 0,
 *
 * where B_beta is the lower triangular Toeplitz matrix of the weights of order beta (H 4). The two
 * conditions x_0 = x_1 = 0 replace the first two equations.
 *
 *   m, rho, c  finite, m > 0, rho >= 0, c >= 0
 *   alpha      0 <= alpha <= 1
 *   force      F(t), as that of a system with d = 1; a zeroed force is no force
 *   h, N       step, finite, > 0; last index, N >= 2
 *   x          output, N + 1 numbers, owned by the caller
 *
 *     double x[101];
 *     status = fvi_matrix_method(1, 0.2, 4, 0.3, force, 0.01, 100, x);
 *
 * The function solves the system row by row, by forward substitution. All rows are parts of one sequence of
 * numbers, so the matrix is not stored. Cost O(N^2), memory O(N).
 * Returns FVI_SUCCESS; FVI_EFAULT if x is NULL; FVI_EINVAL if N < 2 or if N is too large to be addressed;
 * FVI_EDOM if a number is out of range; FVI_ENOMEM; FVI_EOVRFLW if a value is not finite; what the force
 * returned. On error x is untouched. */
int fvi_matrix_method(double m, double rho, double c, double alpha,
                      fvi_force force, double h, size_t N, double *x);

/* fvi_matrix_method_simple -- Solve the same system in the usual way: fill the triangular matrix and hand
 * it to GSL (gsl_blas_dtrsv). It is meant for reading and for comparisons.
 *
 * Arguments and errors are those of fvi_matrix_method; FVI_EINVAL, too, if (N + 1)^2 numbers cannot be
 * addressed. Cost O(N^2), memory O(N^2): 128 MB for N = 4000. */
int fvi_matrix_method_simple(double m, double rho, double c, double alpha,
                             fvi_force force, double h, size_t N, double *x);

/* fvi_observed_order -- Compute the observed order: the slope of log error against log h.   [(10.3)]
 *
 * gsl_fit_linear fits the least-squares line log error = log K + order log h.
 *
 *   n         number of points, n >= 2
 *   h, error  n numbers each, finite, > 0; the numbers h must not all be equal
 *   order, K  outputs; NULL for an output that is not wanted
 *
 *     const double h[] = { 0.1, 0.05 }, error[] = { 4e-2, 1e-2 };
 *     double order;
 *     status = fvi_observed_order(2, h, error, &order, NULL);      // order = 2
 *
 * Cost O(n). Returns FVI_SUCCESS; FVI_EFAULT if h, error or both outputs are NULL; FVI_EINVAL if n < 2 or
 * if 2 n numbers cannot be addressed; FVI_EDOM if a number is out of range or all h are equal; FVI_ENOMEM.
 * On error the outputs are untouched. */
int fvi_observed_order(size_t n, const double *h, const double *error,
                       double *order, double *K);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
