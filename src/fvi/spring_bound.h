/* src/fvi/spring_bound.h -- A bound of the error of form D on a damped spring, at the end of every step.  [H 20] */
#ifndef FVI_SPRING_BOUND_H
#define FVI_SPRING_BOUND_H

#include "exact_solution.h"

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(default)

/* fvi_spring_bound -- bounds x of |x_n - x(t_n)| and v of |p_n/m - x'(t_n)|, at the ends t_n of all steps. */
typedef struct {
    double x, v;
} fvi_spring_bound;

/* fvi_spring_bound_compute -- Compute the bound (20.19) of the error of a run of
 *
 *     m x'' + c x + rho D^{2 alpha} x = F
 *
 * by fvi_lobatto_d2 to fvi_lobatto_d8 or fvi_variable_step (form D). The bound does not grow with time.
 *
 *   problem  m, c, rho > 0, 0 < alpha < 1. The past is Caputo's; or the body was held, and 2 alpha <= 1 or v0 = 0.
 *            forcing: NONE, or STEP, if T is the end of a step
 *   stages   2 to 8
 *   n, h     n >= 1 numbers: the lengths of the steps, each > 0 and finite. For equal steps one number is enough
 *   eps      the largest error of the memory in a stage, in units of D^{2 alpha} x; finite, >= 0. 0 for exact
 *            weights
 *   bound    output
 *   error    output, or NULL; its fields are these names
 *
 *     const fvi_linear_oscillator spring = { .m = 1, .c = 1, .rho = 0.5, .alpha = 0.25, .x0 = 1 };
 *     const double h = 0.1;
 *     status = fvi_spring_bound_compute(&spring, 3, 1, &h, 0, &bound, NULL); // bound.x is 2.35e-6
 *
 * The bound does not contain the rounding errors of the run. Accuracy: the bound is rounded up by at most 1 in 200.
 * Cost: some thousand values of the integrand, times 1/(angle between pole and cut) if that is large; O(n).
 * Returns FVI_SUCCESS; FVI_EFAULT if a pointer is NULL; FVI_EINVAL if n == 0, if stages is out of range, or if the
 * forcing is COSINE; FVI_EDOM if a number is out of its range, or for alpha = 1/2 and rho >= 2 sqrt(m c); FVI_EUNSUP
 * for another past, for a law, and if the angle between the pole and the cut is below 0.001, which happens near
 * alpha = 1/2 with rho above 2 sqrt(m c); FVI_EOVRFLW if the bound is not finite, for example because rounding hides
 * the decay of the oscillation in a step. On error *bound is untouched. */
int fvi_spring_bound_compute(const fvi_linear_oscillator *problem, size_t stages, size_t n,
                             const double *h, double eps, fvi_spring_bound *bound, fvi_error *error);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
