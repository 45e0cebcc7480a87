/* src/fvi/paper/algorithm_3.h -- Algorithm 3 of the paper, line by line as the paper prints it.  [H 9] */
#ifndef FVI_ALGORITHM_3_H
#define FVI_ALGORITHM_3_H

#include <fvi/system.h>

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(default)

/* fvi_algorithm_3 -- Run Algorithm 3 of the paper in one dimension.                       [(9.2)]
 *
 * Each step solves the three-term equation of the paper for x_{k+1}. The damping is
 * Riemann-Liouville's; its weights are the product of two weight sequences of order alpha. The function
 * computes positions only. It is meant for reading and for comparisons: fvi_fractional (fvi.h) with the
 * past FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE has the same positions, at a lower cost, and the momenta.
 *
 *   system        d == 1, no impulses
 *   alpha         order of each of the two derivatives, in [0, 1]: the damping has the order 2 alpha
 *   kappa         potential at kappa x_k + (1 - kappa) x_{k+1}, in [0, 1]
 *   h             step, finite, > 0
 *   N             number of steps, N >= 1
 *   x0, p0        initial position and momentum, finite
 *   x             output, owned by the caller: the N + 1 positions x_0, ..., x_N
 *
 *     double x[101];
 *     if (fvi_algorithm_3(&system, 0.3, 0.5, 0.01, 100, 1, 0, x) == FVI_SUCCESS)
 *         printf("%g\n", x[100]);
 *
 * Cost O(N^2), memory O(N).
 * Returns FVI_SUCCESS; FVI_EFAULT if x is NULL; FVI_EINVAL if d != 1 or if 2 N + 2 numbers cannot
 * be addressed; FVI_EUNSUP if the force has impulses; what fvi_system_check and fvi_stepper_start
 * return; FVI_EMAXITER, FVI_ESING and FVI_EOVRFLW as fvi_stepper_step; what the potential or the
 * force returned; FVI_ENOMEM. On error x is untouched. */
int fvi_algorithm_3(const fvi_system *system, double alpha, double kappa,
                    double h, size_t N, double x0, double p0, double *x);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
