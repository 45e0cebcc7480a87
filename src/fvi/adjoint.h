/* src/fvi/adjoint.h -- Every derivative of a run for one adjoint run.  [H 23]
 *
 * J = J(x_0, ..., x_N, p_0, ..., p_N) is one number made of a trajectory: a distance from what
 * was measured, the last position, an energy. A run that goes backwards through the same
 * memory, with Hess U along the trajectory in place of U, gives the derivative of J by
 * everything that determines the trajectory. */
#ifndef FVI_ADJOINT_H
#define FVI_ADJOINT_H

#include "sensitivity.h"
#include "trajectory.h"

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(default)

/* fvi_adjoint -- the derivatives of J by all that determines a run.
 *                [(23.4), (23.6), (23.13), (23.15), (23.16), (23.18), (23.19), (23.21), (23.25)]
 *
 *   method     fvi_fractional, fvi_cq2_shifted, fvi_cq_bdf2, fvi_cq2_midpoint; or with x and p
 *              NULL fvi_lobatto_m2 to 8d, of which form M has no derivative by alpha at
 *              alpha = 1, where its p jumps, (17.17); and fvi_variable_step, see mesh
 *   run        as it was run
 *   x, p       the trajectory as fvi_trajectory writes it: (N + 1) d positions, and the
 *              d momenta p_N of its last row. Or both NULL: the run is done here, and
 *              done again in pieces, so that about 2 (N d S)^(1/2) numbers are kept, not
 *              N d, where a stepper has S < N d; the digits are the same
 *   objective  J
 *   gradients  outputs, the caller's
 *
 * These are the derivatives of what the program computes, not of the motion it stands
 * for: no step size is small. With a compressed memory they belong to the weights as
 * they are compressed; the derivative by alpha is that of the true weights to (23.11),
 * (23.14), and on a mesh that of the weights (22.10) as they are, (23.18); those by the
 * orders and times of a law are sums of sums, (23.21), or weights of their own, (23.28), each
 * compressed by itself: up to four memories a term.
 *
 *   past   alpha > 1/2, CAPUTO: the memory knows p0/m; at alpha = 1/2 it begins to, and
 *          x jumps if p0 != 0: the derivative by alpha is that from below. The other
 *          pasts with all but fvi_fractional: likewise, if less. RIEMANN_LIOUVILLE
 *          with all but fvi_fractional and alpha > 1/2 runs from x0 = 0 alone, and
 *          where rho > 0 the derivative by x0 does not exist: NaN is written; so it is for
 *          each place that would stretch a damper of a mechanism with this past and a law
 *          that is no sum of powers with alpha <= 1/2
 *   mesh   of fvi_variable_step the steps count as given: the derivatives are those on these
 *          steps. Where the initial history acts, (19.3), so does the singular part of it,
 *          its terms and its end, (23.25); where a damped body has A = 0 and a derivative by
 *          A is wanted, steps end where it would; and there is none by alpha at 1, nor at 0
 *          of RIEMANN_LIOUVILLE. force: the force changes along straight lines between t_k
 *          and t_{k+1}. With a law: none by its orders, times and ends, and by a factor only
 *          that of a law of one term; by p0, where the law grows faster than s, NaN is
 *          written, as such a run begins at rest
 *   matrices  M, C, K (structures.h): by their factors, not by their entries. (23.19) With several
 *          dampers `damping` has a number for each, by a factor of its kernel.
 *          With stages x and p are NULL, and a law that grows faster than s has no terms to ends. No
 *          derivative at all where one of several dampers has the past RIEMANN_LIOUVILLE and a law that is not
 *          one power with alpha <= 1/2, and with this past none by fvi_fractional. Of
 *          fvi_variable_step no alpha at 0 and no orders to ends, and terms of a law of one term alone
 *   mechanism  fvi, fvi-stable, the methods with stages and fvi_variable_step, x and p NULL: dampers between points, a
 *          Lagrangian, forces of velocity and constraints that do not know the time, or imposed
 *          coordinates; elongations and constraints with second derivatives. (23.29) `damping` has a
 *          number for each damper, by a factor of its kernel, and terms to ends have those of all
 *          kernels. With constraints x0 and p0 are for changes that keep to them. Every p_k may be
 *          in J. Not by fvi-stable with a coordinate without inertia; with stages there are no terms
 *          to ends of a sum of laws that grows faster than s. All steps are kept: N (3 d + r s)
 *          numbers and more with stages. fvi_variable_step: by factors of laws and no terms to ends, of
 *          J with the last momentum alone; without coordinates without inertia, impulses beside constraints, the
 *          past RIEMANN_LIOUVILLE, and CAPUTO of a law that grows faster than s
 *   rho    a damping that is zero has a derivative too, at the cost of its memory; that of
 *          fvi_variable_step, where nothing is damped, is the one of form M with such a damping
 *
 * One factorisation of the size of a Hessian a step, none if U is quadratic (with stages
 * always one, s - 2 times as large, in form D s times), and no iteration. Measured,
 * fvi_fractional, one coordinate, the rows given: a third of the time of the run, and two fifths
 * with the derivative by alpha (figures/adjoint/adjoint_bench.tsv).
 * fvi_variable_step keeps 11 d numbers a step.
 * Accuracy: no bound is proved for the rounding. Seen: 5e-14 of a derivative, or of 1 where
 * that is more, N = 2000; with eight stages an identity of all derivatives is off by 1e-12.
 * They are derivatives of the x that doubles hold: where damping is so strong that x does not
 * leave x0 by a digit (rho = 1e20), those by masses, rho and alpha are 0, or rounding.
 *
 * Returns FVI_SUCCESS; what fvi_stepper_start and fvi_stepper_step return; FVI_EFAULT if method, run,
 * objective, its slopes or gradients is NULL, or one of x and p alone; FVI_EINVAL if
 * parameters are wanted and sensitivity.column is NULL, alpha of a law or terms, orders,
 * times or ends of none; FVI_EUNSUP if the method has no adjoint, or not this one, or mass
 * is wanted of matrices that have no inertia, or all momenta at alpha = 1 of a damped
 * run of form M or of fvi_variable_step, or no step is short enough
 * for a body whose A is 0 (22.23);
 * FVI_ESING if the equation of a step backwards has no unique solution; FVI_EOVRFLW if a
 * derivative is not finite; what a callback returned. On error the outputs are of no use. */
int fvi_adjoint(const fvi_method *method, const fvi_run *run, const double *x,
                const double *p, const fvi_objective *objective,
                const fvi_sensitivities *gradients);

/* fvi_adjoint_forces -- the derivatives of a J that the forces of the dampers stand in, too.        [(23.32), (23.33)]
 *
 *     J = J(x_k, p_k, f_k, I_k)     f_k the forces of the dampers in row k, I_k their impulses up to there
 *
 *   method, run, objective, gradients  as for fvi_adjoint; the run is done here. fvi_variable_step takes no part
 *   force    dJ/df: N + 1 rows, each of the numbers of all dampers one behind another, as an observer of
 *            FVI_OBSERVE_OWN_STEPS tells them (observer.h); or NULL
 *   impulse  dJ/dI, likewise; or NULL. That of t = 0 is not read, as all impulses are 0 there
 *
 * These are the derivatives of the numbers that such an observer tells, also in the first rows, where a law is compared with
 * what it answers to a line. Where the force at t = 0 is infinite, its row is the mean over the first one, and so is its
 * derivative.
 *
 *     const double by_peak[] = { 0, 0, 0, 1, 0 };               four steps: J is the force in row 3
 *     fvi_adjoint_forces(&fvi_cq2_midpoint, &run, &nothing, by_peak, NULL, &gradients);
 *
 * Cost: the adjoint of a run with twice the coordinates, of matrices and of a mechanism with one more for each number of a
 * damper. By numbers of a law one run more, and for each number up to seven starts of a stepper and an observer; by
 * fvi_cq2_shifted, fvi_cq_bdf2 and fvi_cq2_midpoint each of these starts has a run of one body. Accuracy: that of
 * fvi_adjoint, but by alpha and the numbers of a law, which stand in the first rows: there 1e-9 of these rows. A mass of
 * 1e150 stands for what holds the dampers, so masses, dampings and forces of the run must be below 1e130: larger ones
 * move it, and nothing tells.
 *
 * Returns what fvi_adjoint, fvi_stepper_start and fvi_observer_start return; FVI_EUNSUP for fvi_variable_step, with
 * events, of matrices without their entries M and K, and of coordinates that are damped one by one at alpha = 1, where
 * the damping is a mass. */
int fvi_adjoint_forces(const fvi_method *method, const fvi_run *run, const fvi_objective *objective,
                       const double *force, const double *impulse, const fvi_sensitivities *gradients);

/* fvi_directional_derivatives -- how every x_k and p_k of a run changes along directions: forward
 * sensitivities, side by side with the run.                                         [(24.6), (24.12)]
 *
 *     dx_k = sum_theta (dx_k / dtheta) dtheta
 *
 *   method  as for fvi_adjoint, but for fvi_variable_step
 *   run     of a chain, or of matrices with any number of dampers; without events
 *   count   directions, >= 1
 *   along   of each what changes: the arrays of fvi_sensitivities, as fvi_adjoint writes them, hold dtheta, and
 *           are read. NULL: nothing. `sensitivity` names the derivatives of U by its parameters
 *   x       output: x_k of coordinate i at [k * d + i], (N + 1) d numbers
 *   p       output: p_k, likewise; or NULL
 *   dx, dp  outputs: along direction j at [(k * count + j) * d + i], (N + 1) count d numbers; dp may be NULL
 *
 * These are the derivatives of what the program computes, as fvi_adjoint has them: for any weights w_k,
 * sum w_k . dx_k is the sum of dJ/dtheta dtheta of J = sum w_k . x_k, to rounding. Where no motion starts at another
 * x0 (19.2), dx_k is NaN along such a direction for k > 0.
 *
 *     double step[] = { 1, 0 }, dx[(N + 1) * 2];
 *     const fvi_sensitivities along = { .damping = step };      by the first damping of two
 *     fvi_directional_derivatives(&fvi_cq2_midpoint, &run, 1, &along, x, NULL, dx, NULL);
 *
 * Cost: of one coordinate a run with as many coordinates as directions; else a run for each direction, with one
 * factorisation a step; and a memory more where a damping is changed, with a number of a law up to four.
 * Accuracy: that of the run; no bound is proved for the rounding.
 *
 * Returns FVI_SUCCESS; what fvi_stepper_start and fvi_stepper_step return; FVI_EFAULT if a pointer is NULL;
 * FVI_EINVAL for no direction, alpha of a law or of several dampers, numbers of a law without one, or parameters
 * without a sensitivity; FVI_EUNSUP for another method or run, with stages at alpha = 1, by x0 of several dampers where
 * no motion starts at another x0, and without stages for what fvi_adjoint refuses of several dampers;
 * FVI_ESING if the equation of a step has no unique solution; FVI_EOVRFLW if a derivative is not finite; FVI_ENOMEM;
 * what a callback returned. */
int fvi_directional_derivatives(const fvi_method *method, const fvi_run *run, size_t count,
                                const fvi_sensitivities *along, double *x, double *p, double *dx,
                                double *dp);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
