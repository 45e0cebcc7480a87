/* src/fvi/paper/algorithm_3.h -- Algorithm 3 as the paper prints it. [H 9] */
#ifndef FVI_ALGORITHM_3_H
#define FVI_ALGORITHM_3_H

#include <fvi/system.h>

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(default)

/* fvi_algorithm_3 -- the same, as the paper prints it, in one dimension: the
 * three-term equation, positions only, the memory as the product of two weight
 * sequences. To read and to compare with.                              [(9.2)]
 *
 *   system        d == 1
 *   kappa, alpha  in [0, 1]
 *   h             finite, > 0
 *   N             steps, N >= 1
 *   x0, p0        start
 *   x             output, N + 1 numbers
 *
 * Riemann-Liouville. Cost O(N^2), memory O(N). Returns FVI_SUCCESS; what
 * fvi_stepper_start returns; FVI_EINVAL if d != 1 or if 2 N + 2 numbers cannot be
 * addressed; FVI_EMAXITER, FVI_ESING and FVI_EOVRFLW as fvi_stepper_step; FVI_ENOMEM. On
 * error x is untouched. */
int fvi_algorithm_3(const fvi_system *system, double alpha, double kappa,
                    double h, size_t N, double x0, double p0, double *x);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
