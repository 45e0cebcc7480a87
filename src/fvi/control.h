/* src/fvi/control.h -- The least force that moves a body from here to there.      [H 25]
 *
 * Among all forces u_k that bring a run to the position x and the momentum p at its last step, fvi_control_solve finds
 * the force with the least sum of squares. It finds the force by adjoint runs (adjoint.h), which give the derivatives
 * of the end by every u_k. */
#ifndef FVI_CONTROL_H
#define FVI_CONTROL_H

#include "trajectory.h"

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(default)

/* fvi_control_result -- the force that was found, in numbers.
 *
 *   cost        (h/2) sum_k |u_k|^2
 *   miss        the largest |x_N - x| and |p_N - p| of the run with this u. Look at it: if a step is unstable
 *               (stability.h), rounding errors of u grow without limit, and the run misses its aim
 *   change      the largest change of u in the last iteration, divided by the largest |u|
 *   iterations  how many; one iteration is a run and 2 d adjoint runs */
typedef struct {
    double cost, miss, change;
    size_t iterations;
} fvi_control_result;

/* fvi_control_solve -- find the least force that ends a run at x, p.                    [(25.1)]
 *
 *     min (h/2) sum_{k=0}^{N} |u_k|^2   so that   x_N = x, p_N = p,
 *
 * where u_k is added to the force F(t_k) of the system.
 *
 *   method  fvi_fractional, fvi_cq2_shifted, fvi_cq_bdf2 or fvi_cq2_midpoint
 *   run     the start, the steps, the past, and a law if the method takes it; N >= 2; no matrices and no events
 *   x, p    where the run is to end, d finite numbers each
 *   u       in: a guess, zeros will do. out: (N + 1) d numbers, owned by the caller, component i at t_k at [k * d + i]
 *   found   output
 *
 *     double u[(N + 1) * 1] = { 0 };
 *     const double x = 1, p = 0;
 *     status = fvi_control_solve(&fvi_cq2_midpoint, &run, &x, &p, u, &found);
 *
 * For a quadratic U the answer is unique, and the first iteration finds it; a second iteration sees that nothing
 * changes. For any other U the answer solves the first-order conditions (25.3). It is stationary, but it need not be
 * the least force, and where there are several solutions the guess decides which of them is found. Method: the
 * iteration (25.4), with steps that are halved until (25.5) falls. Near the solution several iterations are combined
 * (Anderson's acceleration). The iteration converges linearly, the faster the less U differs from a quadratic one. u
 * has no bounds.
 *
 * The iteration ends when u changes by less than 1e-12 of its largest number. Accuracy for quadratic U: 4.4e-16 of the
 * largest u was seen, for one mass and N = 24 and 32.
 *
 * Cost of an iteration: one run, more if the step is halved, and 2 d adjoint runs. Memory: (2 d + 18) d (N + 1) and
 * 4 d (d + 1) numbers.
 * Returns FVI_SUCCESS; what fvi_stepper_start, fvi_stepper_step, fvi_adjoint and a callback return; or
 *   FVI_EFAULT    a pointer is NULL
 *   FVI_EINVAL    N < 2, or so many steps cannot be addressed
 *   FVI_EDOM      x or p is not finite
 *   FVI_EUNSUP    another method, matrices, or events
 *   FVI_ESING     the force cannot reach x and p
 *   FVI_EOVRFLW   u, its cost or its miss is not finite
 *   FVI_EMAXITER  200 iterations were not enough, or 40 halvings of a step did not lower (25.5); u and *found are those
 *                 of the last iteration
 *   FVI_ENOMEM
 * After any other error u is of no use. */
int fvi_control_solve(const fvi_method *method, const fvi_run *run, const double *x,
                const double *p, double *u, fvi_control_result *found);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
