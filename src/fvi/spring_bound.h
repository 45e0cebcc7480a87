/* src/fvi/spring_bound.h -- How far form D on a spring can be from the motion at the end of any step.   [H 20] */
#ifndef FVI_SPRING_BOUND_H
#define FVI_SPRING_BOUND_H

#include "exact_solution.h"

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(default)

/* fvi_spring_bound -- bounds of the errors |x_n - x(t_n)| and |p_n/m - x'(t_n)|, at the ends of all steps. */
typedef struct {
    double x, v;
} fvi_spring_bound;

/* fvi_spring_bound_compute -- the bound of (20.19), which does not grow with the time
 *
 *     m x'' + c x + rho D^{2 alpha} x = F,   by fvi_lobatto_d2 to d8 or fvi_variable_step (form D).
 *
 *   problem  m, c, rho > 0, 0 < alpha < 1. The past is Caputo's, or held with 2 alpha <= 1 or v0 = 0.
 *            forcing: NONE, or STEP, where T has to be the end of a step
 *   stages   2 to 8
 *   n, h     n >= 1 lengths that the steps have, each > 0 and finite; of equal steps one is enough
 *   eps      what the memory may be wrong by in a stage, in units of D^{2 alpha} x; finite, >= 0. 0 for exact
 *            weights
 *   bound    output
 *   error    says what is wrong, in these names; NULL is allowed
 *
 *     const fvi_linear_oscillator spring = { .m = 1, .c = 1, .rho = 0.5, .alpha = 0.25, .x0 = 1 };
 *     const double h = 0.1;
 *     status = fvi_spring_bound_compute(&spring, 3, 1, &h, 0, &bound, NULL); // bound.x is 2.35e-6
 *
 * Rounding is not in the bound. Accuracy: rounded up, by at most 1 in 200. Cost: some thousand values of the
 * integrand, more by 1/(angle between pole and cut); O(n). Returns FVI_SUCCESS; FVI_EFAULT if a pointer
 * is NULL; FVI_EINVAL if n == 0, stages is no such number, or the forcing is COSINE; FVI_EDOM if a number is out of
 * its range, or for alpha = 1/2 and rho >= 2 sqrt(m c); FVI_EUNSUP for another past, for a law, and if the pole is
 * nearer than 0.001 to the cut, as it is beside alpha = 1/2 with rho above 2 sqrt(m c); FVI_EOVRFLW if the bound is
 * not finite, as where rounding hides the decay of the oscillation in a step. On error *bound is untouched. */
int fvi_spring_bound_compute(const fvi_linear_oscillator *problem, size_t stages, size_t n,
                             const double *h, double eps, fvi_spring_bound *bound, fvi_error *error);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
