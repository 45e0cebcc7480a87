/* src/fvi/adjoint.h -- All derivatives of a run: one adjoint run backwards, or sensitivities forwards.     [H 23, 24]
 *
 * An objective J is one number made of a trajectory, for example its distance from a measurement, its last position or
 * an energy. fvi_adjoint runs the integrator once more, from the end to the start, with the same memory and with the
 * Hessian of U along the trajectory in the place of U. This adjoint run gives the derivatives of J by everything that
 * determines the trajectory. fvi_adjoint_forces does the same if J contains the forces of the dampers.
 * fvi_directional_derivatives goes forwards, beside the run, and gives the change of every x_k and p_k along a few
 * directions. For example, with J = x_N and fvi_fractional the derivative of J by the force F_k, k >= 1, is h lambda_k,
 * where lambda_k is the position of the adjoint run at node k (23.6). */
#ifndef FVI_ADJOINT_H
#define FVI_ADJOINT_H

#include "sensitivity.h"
#include "trajectory.h"

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(default)

/* fvi_adjoint -- compute the derivatives of J by everything that determines a run.
 *                [(23.4), (23.6), (23.13), (23.15), (23.16), (23.18), (23.19), (23.21), (23.25)]
 *
 *     gradients = dJ/dx_0, dJ/dp_0, dJ/dF_k, dJ/dm, dJ/drho, ...,     J = J(x_0, ..., x_N, p_N)
 *
 * J may also depend on p_0, ..., p_{N-1}: see has_momenta of fvi_objective (sensitivity.h).
 *
 *   method     fvi_fractional, fvi_cq2_shifted, fvi_cq_bdf2, fvi_cq2_midpoint, fvi_lobatto_m2 to m8, fvi_lobatto_d2 to
 *              d8, or fvi_variable_step
 *   run        the run, as for fvi_stepper_start (trajectory.h); without events
 *   x, p       x_k of coordinate i at x[k * d + i], (N + 1) d numbers, and the d numbers p_N. Or both NULL: the
 *              function makes the run itself, and repeats it in pieces, so that about 2 (N d S)^(1/2) numbers are kept
 *              instead of N d, where S < N d is the number of doubles in a stepper. Both ways give the same digits
 *   objective  J, by its slopes
 *   gradients  outputs, owned by the caller: the arrays of fvi_sensitivities that are not NULL are written
 *
 *     static int last(size_t k, size_t d, const double *x, const double *p, void *params, double *Jx, double *Jp)
 *     {
 *         Jx[0] += p ? 1 : 0;   // J = x_N of coordinate 0, because p is NULL except for k = N
 *         (void)k, (void)d, (void)x, (void)params, (void)Jp;   // not used
 *         return 0;
 *     }
 *     const fvi_objective objective = { .slopes = last };
 *     const fvi_sensitivities gradients = { .x0 = by_x0, .damping = by_damping };
 *     status = fvi_adjoint(&fvi_cq2_midpoint, &run, NULL, NULL, &objective, &gradients);
 *
 * These are the derivatives of the numbers that the program computes, for every step size. They are not the derivatives
 * of the exact motion. With a compressed memory they belong to the compressed weights. The derivative by alpha belongs
 * to the exact weights, with the accuracy of (23.11) and (23.14); with fvi_variable_step it belongs to the weights
 * (22.10) of the run (23.18). The derivatives by the orders and times of a law are sums of sums (23.21), or sums with
 * weights of their own (23.28). Each of these sums is compressed by itself, so a term of a law takes up to four
 * memories.
 *
 * Some outputs need a remark:
 *
 *   - With matrices (structures.h) mass, damping and parameters are one number each: the derivatives by one factor of
 *     M, of C and of K, at the factor 1, and not by their entries (23.19).
 *   - With several dampers, of matrices or of a mechanism (dampers.h), damping has one number for each damper: the
 *     derivative by a factor of its kernel (23.29). terms, orders, times and ends run over the terms of all kernels.
 *   - A coordinate with rho = 0 has a derivative by its damping, too, at the cost of a memory. With fvi_variable_step,
 *     if nothing is damped, it is the derivative of form M with such a damping.
 *   - With constraints the derivatives by x0 and p0 hold for changes that keep to the constraints.
 *   - Alpha at 1/2: with CAPUTO the memory acts on x - x_0 for alpha <= 1/2 and on x - x_0 - t p_0/m for alpha > 1/2.
 *     So x jumps at alpha = 1/2 if p_0 != 0, and the derivative is the one from below. With the other pasts x
 *     jumps there, too, but by less; with fvi_fractional it does not jump.
 *   - fvi_variable_step holds the lengths of the steps fixed. If the force of the past is singular at t = 0 (19.3), it
 *     holds fixed the number of terms of the singular part of x and the time at which this part ends (23.25). If a
 *     damped body has the amplitude A = 0 in (19.3) and a derivative by A is wanted, a step ends where the singular
 *     part would end. The derivative by the force is by F(t_k), with F linear between t_k and t_{k+1}.
 *
 * NaN is written where there is no derivative, because no run starts at a neighbouring value:
 *
 *   - by x0 of a coordinate with rho > 0, the past RIEMANN_LIOUVILLE and alpha > 1/2 (19.2), except with
 *     fvi_fractional;
 *   - by x0 of a coordinate of a mechanism, if the change stretches a damper with the past RIEMANN_LIOUVILLE, except
 *     with fvi_fractional and with a law that is a sum of powers with alpha <= 1/2;
 *   - by p0 of a damped coordinate with fvi_variable_step and a law that grows faster than s, as such a run starts at
 *     rest.
 *
 * The function refuses (FVI_EUNSUP)
 *
 *   - a run with events; fvi_lagrange_dalembert and Euler's methods;
 *   - x and p that are not NULL, for methods with stages, for fvi_variable_step and for a mechanism;
 *   - the derivative by mass, for matrices without `inertia`;
 *   - fvi_cq2_shifted with run->law, or with a damper whose kernel is not one power;
 *   - fvi_lobatto_m2 to m8 at alpha = 1: the derivative by alpha, because p jumps there (17.17), and has_momenta if
 *     something is damped;
 *   - methods with stages, for matrices: the derivatives by terms, orders, times and ends of a law that grows faster
 *     than s;
 *   - matrices with several dampers, one of them with the past RIEMANN_LIOUVILLE: fvi_fractional always, and the other
 *     methods unless the law of this damper is one power with alpha <= 1/2;
 *   - a mechanism: a constraint that depends on the time (a coordinate may be imposed); a constraint, or an elongation
 *     that is not linear, without `hessian`; a start with a velocity, if a kernel grows faster than s and the rate of
 *     its elongation depends on x; fvi_cq2_midpoint with a coordinate without inertia; for methods with stages the
 *     derivatives by terms, orders, times and ends, if a kernel grows faster than s and is not one power;
 *   - fvi_variable_step: orders, times and ends; terms, unless run->law is one term with rho > 0; the derivative by
 *     alpha at alpha = 1 with HELD or RIEMANN_LIOUVILLE, at alpha = 0 with RIEMANN_LIOUVILLE, and at alpha = 0 with
 *     matrices; has_momenta at alpha = 1 if something is damped; a body whose A is 0, if no step is short enough for it
 *     (22.23);
 *   - fvi_variable_step with a mechanism: also terms; has_momenta; impulses beside constraints; the past
 *     RIEMANN_LIOUVILLE; CAPUTO of a kernel that grows faster than s.
 *
 * Cost: one factorisation of a Hessian for each step, none if U is quadratic, and no iteration. With stages it is
 * always one, of a matrix s - 2 times as large as a Hessian, or s times in form D. Measured for fvi_fractional, one
 * coordinate, x and p given: a third of the time of the run, or two fifths with the derivative by alpha
 * (figures/adjoint/adjoint_bench.tsv). fvi_variable_step keeps 11 d numbers a step. A mechanism with r dampers and m
 * constraints keeps all steps: N (3 d + 3 r + 2 m) numbers, and more with stages.
 * Accuracy: no bound is proved for the rounding. Seen: 5e-14 of a derivative, or of 1 if the derivative is below 1, for
 * N = 2000. With eight stages an identity of all derivatives is off by 1e-12. The derivatives belong to x as the
 * doubles hold it. So where the damping is so strong that no digit of x leaves x_0 (rho = 1e20), the derivatives by
 * masses, rho and alpha are 0 or rounding errors.
 *
 * Returns FVI_SUCCESS; what fvi_stepper_start and fvi_stepper_step return; what a callback returned; or
 *   FVI_EFAULT   method, run, objective, its slopes or gradients is NULL, or only one of x and p is
 *   FVI_EINVAL   sensitivity.count parameters are wanted without sensitivity.column, or of a Lagrangian without
 *                `lagrangian`; alpha is wanted of a law or of a mechanism; terms, orders, times or ends are wanted
 *                without a law or dampers; mass is wanted of a Lagrangian; names are wanted without their columns; N is
 *                too large to be addressed
 *   FVI_EUNSUP   a case of the list above
 *   FVI_ESING    the equation of a step backwards has no unique solution
 *   FVI_EOVRFLW  a derivative, or a slope of J, is not finite
 *   FVI_ENOMEM
 * On error the outputs are of no use. */
int fvi_adjoint(const fvi_method *method, const fvi_run *run, const double *x,
                const double *p, const fvi_objective *objective,
                const fvi_sensitivities *gradients);

/* fvi_adjoint_forces -- compute the derivatives of a J that contains the forces of the dampers.   [(23.32), (23.33)]
 *
 *     J = J(x_k, p_k, f_k, I_k)     f_k: the forces of the dampers in row k, I_k: their impulses from 0 to t_k
 *
 *   method, run, objective, gradients  as for fvi_adjoint, but not fvi_variable_step. The function makes the run itself
 *   force    dJ/df: N + 1 rows of n numbers, or NULL. n counts the force numbers of all dampers, one damper after
 *            another, as an observer with FVI_OBSERVE_OWN_STEPS gives them (observer.h)
 *   impulse  dJ/dI: an array of the same shape, or NULL. The row of t = 0 is not read, because all impulses are 0 there
 *
 * These are the derivatives of the numbers that such an observer gives. This includes the first rows, where the
 * observer compares a damper with the answer of its law to a line. Where the force at t = 0 is infinite, row 0 is the
 * mean over the first step, and its derivative is the derivative of this mean.
 *
 *     const double by_force[] = { 0, 0, 0, 1, 0 };   // four steps, one damper: J is the force in row 3
 *     fvi_adjoint_forces(&fvi_cq2_midpoint, &run, &nothing, by_force, NULL, &gradients);
 *
 * where `nothing` has slopes that add nothing and return 0.
 *
 * Method: each damper gets a wall, a body of mass 1e150, whose momentum is the impulse of the damper. So the adjoint of
 * a run with walls gives the derivatives. The masses, dampings and forces of the run must be below 1e130. Larger ones
 * would move the wall, and this is not checked.
 * Cost: coordinates damped one by one: the adjoint of a run with twice the coordinates. Matrices and mechanisms: the
 * adjoint of a run with one coordinate more for each force number of a damper. Derivatives by numbers of a law take one
 * run more, and up to seven starts of a stepper and an observer for each number; with fvi_cq2_shifted, fvi_cq_bdf2 and
 * fvi_cq2_midpoint each of these starts includes a run of one body.
 * Accuracy: that of fvi_adjoint, except for the derivatives by alpha and by numbers of a law. These numbers also stand
 * in the first rows, and their part of the derivative is right to 1e-9 of these rows.
 *
 * Returns what fvi_adjoint, fvi_stepper_start and fvi_observer_start return; FVI_EUNSUP for fvi_variable_step, for a
 * run with events, for matrices without their entries M and K, for coordinates that are damped one by one
 * at alpha = 1, where the damping is a mass, and for derivatives by x0 if they contain the rate g_t(0, x0) of an
 * elongation and this rate changes with the place. On error the outputs are of no use. */
int fvi_adjoint_forces(const fvi_method *method, const fvi_run *run, const fvi_objective *objective,
                       const double *force, const double *impulse, const fvi_sensitivities *gradients);

/* fvi_directional_derivatives -- compute a run, and how every x_k and p_k changes along given directions (forward
 * sensitivities).                                                                                  [(24.6), (24.12)]
 *
 *     dx_k = sum_theta (dx_k / dtheta) dtheta,     dp_k = sum_theta (dp_k / dtheta) dtheta
 *
 *   method  as for fvi_adjoint, but not fvi_variable_step
 *   run     of coordinates that are damped one by one, or of matrices with any number of dampers; without events
 *   count   how many directions, >= 1
 *   along   `count` directions. The arrays of fvi_sensitivities hold dtheta here, in the shapes in which fvi_adjoint
 *           writes derivatives, and are read. An array that is NULL stands for zeros. `sensitivity` gives the
 *           derivatives of grad U by its parameters
 *   x       output: x_k of coordinate i at [k * d + i], (N + 1) d numbers
 *   p       output: p_k, in the same shape; or NULL
 *   dx, dp  outputs: along direction j at [(k * count + j) * d + i], (N + 1) count d numbers; dp may be NULL
 *
 *     double by_damping[] = { 1, 0 }, dx[(N + 1) * 2];   // by the first damping of two coordinates
 *     const fvi_sensitivities along = { .damping = by_damping };
 *     fvi_directional_derivatives(&fvi_cq2_midpoint, &run, 1, &along, x, NULL, dx, NULL);
 *
 * These are the derivatives of the numbers that the program computes, as with fvi_adjoint: for any weights w_k the sum
 * of w_k . dx_k equals, to rounding, the sum of dJ/dtheta dtheta for J = sum_k w_k . x_k. Where no motion starts at
 * another x_0 (19.2), dx_k and dp_k are NaN for k > 0 along a direction that changes this x_0.
 *
 * Cost: one coordinate: a second run with as many coordinates as directions. Else: one more run for each direction,
 * with one factorisation for each step. A direction that changes a damping takes one memory more, and a direction that
 * changes a number of a law takes up to four. Accuracy: that of the run; no bound is proved for the rounding.
 *
 * Returns FVI_SUCCESS; what fvi_stepper_start and fvi_stepper_step return; what a callback returned; or
 *   FVI_EFAULT   method, run, x0 or p0 of the run, along, x or dx is NULL
 *   FVI_EINVAL   count is 0; a direction changes alpha of a law or of several dampers, terms, orders, times or ends
 *                without a law or dampers, or parameters without sensitivity.column
 *   FVI_EUNSUP   the method or the run is not one of those above; stages at alpha = 1 (unless the run has a law or
 *                several dampers); fvi_cq2_shifted with a law; mass of matrices without `inertia`; what fvi_adjoint
 *                refuses of several dampers without stages, and of matrices with stages and a law that grows faster
 *                than s; a change of x_0 with several dampers where no motion starts at another x_0
 *   FVI_ESING    the equation of a step has no unique solution
 *   FVI_EOVRFLW  a derivative is not finite
 *   FVI_ENOMEM
 * On error the outputs are of no use. */
int fvi_directional_derivatives(const fvi_method *method, const fvi_run *run, size_t count,
                                const fvi_sensitivities *along, double *x, double *p, double *dx,
                                double *dp);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
