/* src/fvi/control.h -- From here to there with the least force.      [H 25] */
#ifndef FVI_CONTROL_H
#define FVI_CONTROL_H

#include "trajectory.h"

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(default)

/* fvi_control_result -- what was found.
 *
 *   cost        (h/2) sum_k |u_k|^2
 *   miss        the largest |x_N - x| and |p_N - p| of the run with this u: look at it, as
 *               a step that is unstable (stability.h) makes anything of the roundings of u
 *   change      the largest change of u in the last iteration, relative to the largest u
 *   iterations  each of one run and 2 d adjoint ones */
typedef struct {
    double cost, miss, change;
    size_t iterations;
} fvi_control_result;

/* fvi_control_solve -- the least force that ends a run at x, p, for quadratic U; for others a
 * stationary one.                                                     [(25.1)]
 *
 *     min (h/2) sum_{k=0}^{N} |u_k|^2   so that   x_N = x, p_N = p,
 *
 * u_k being added to the force F(t_k) of the system.
 *
 *   method  fvi_fractional, fvi_cq2_shifted, fvi_cq_bdf2 or fvi_cq2_midpoint
 *   run     the start, the steps, the past, a law if the method takes it; N >= 2
 *   x, p    where it is to end, d numbers each
 *   u       in: a guess, zeros will do; out: (N + 1) d numbers, component i at t_k at
 *           [k * d + i]
 *   found   output
 *
 * For a quadratic U the answer is unique, and found at once: 2 d adjoint runs and 2 d
 * equations, and once more to see that nothing changes. Else u solves the first-order
 * conditions (25.3), and need not be the least of all: where there are several, which one
 * is not said. The iteration is (25.4), with steps that are halved until (25.5) falls;
 * its speed is linear, and the faster the less U bends. There are no bounds on u.
 *
 * Ends when u changes by less than 1e-12 of its largest number. Accuracy for quadratic U:
 * seen 4.4e-16 of the largest u, one mass, N = 24 and 32.
 *
 * Cost of an iteration: one run, more if the step is halved, and 2 d adjoint ones;
 * (2 d + 18) d (N + 1) numbers are kept, and 4 d (d + 1).
 * Returns FVI_SUCCESS; what fvi_trajectory and fvi_adjoint return, FVI_EUNSUP for other
 * methods; FVI_EFAULT if a pointer is NULL; FVI_EINVAL if N < 2, or so many steps cannot
 * be addressed; FVI_EDOM if x or p is not finite; FVI_ESING if the force cannot reach x
 * and p; FVI_EOVRFLW if u, its cost or its miss is not finite; FVI_EMAXITER after 200
 * iterations, u and found being those of the last;
 * FVI_ENOMEM. After another error u is of no use. */
int fvi_control_solve(const fvi_method *method, const fvi_run *run, const double *x,
                const double *p, double *u, fvi_control_result *found);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
