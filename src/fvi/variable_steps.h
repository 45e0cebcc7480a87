/* src/fvi/variable_steps.h -- Steps of any length.                  [H 22]
 *
 *     m x'' + grad U(x) + rho D^{2 alpha} x = F(t)
 *
 * by steps h_k of the method's own choice. On the s Lobatto nodes c of every step, DD is
 * the block bidiagonal matrix with A^{-1} / h_k on its diagonal and -e_1 e_s^T / (h_k b_1)
 * below it, the inverse of integration from node to node over all steps so far. What
 * damps is one of its powers; so is, in form D, the inertia:
 *
 *     m DD^2 x + rho DD^{2 alpha} x + grad U(x) = F                     (form D)
 *
 * with, beta = 2 alpha - 1, the present part h_k^{-beta} (A^{-1})^beta for any h_k, and
 * the history a sum over modes exp(-sigma t) whose coefficients are one table, as the
 * steps and the sigma are powers of the same number. */
#ifndef FVI_VARIABLE_STEPS_H
#define FVI_VARIABLE_STEPS_H

#include "trajectory.h"

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(default)

/* fvi_variable_step -- variable steps, s = 6 or 8 stages.
 *
 * Order: the steps follow the motion, so no power of h is an order. With n steps of eight
 * stages the error of x over all t falls about like n^-10: fits lie between 9 and 12.
 *
 * Any system in R^d, all coordinates with the same steps, also with a mechanism
 * (dampers.h), which is form D, or with matrices (structures.h) that have complex
 * factors, of which each length of a step has its own (27.14), and no damping of order 2; any alpha
 * in [0, 1], any rho, any past; or a law of damping whose poles beside the cut have 2 alpha <
 * 0.98 (26.18), with p0 = 0 and no impulse where it grows faster than s. run->h and
 * run->steps say where the rows are, t_k = k h; the steps are the method's own, see fvi_stepper_step: s->k counts rows that
 * have been passed, s->t is the time of x and p. Between the ends of its steps fvi_stepper_advance_to
 * and fvi_solve interpolate, with about the same error as far as the force is smooth.
 *
 *   run->step_error  what x may be off by the estimate of each step, >= 0; 0: 1e-10 of
 *                    the size so far, max |x_i|. p is off by more. Rounding hides 1e-17 of the size: less
 *                    than that at the start is refused (FVI_ETOL); if the size grows, 1e-17 of it is allowed
 *   run->memory      AUTO or EXPONENTIALS; the others are refused (FVI_EUNSUP)
 *   run->tolerance   not read: the modes are right to 2e-14, or where step_error is above
 *                    1e-7 of the size to 3e-10, above 1e-5 to 1e-7
 *   run->kappa       not read
 *
 * The size at first is max |x0|; h max |v0| if x0 = 0; h^2 max |F - grad U| / m at t = 0
 * if v0 = 0 too, or 1; what is below 1e-12 of the next counts as 0. Where the Hessian is
 * diagonal, h is there at most 2 sqrt(m / c), c its entry at x0; where it is not, x0 is
 * compared with what is possible in that time, c / m the largest sum_j |H_ij| / m_i. s = 8,
 * or 6 if step_error is above 1e-3 of that size. Where nothing is damped the step is form M
 * instead, that of the variational methods of H 17, which has no numerical damping;
 * fvi_stepper_statistics says which.
 *
 * The force may jump where force.jumps says so, at any times: steps end there, and the
 * next begin small. A jump that is not declared is come near to by rejected steps, some
 * forty, or is overlooked where it is small: x was off by up to 21 step_error in what the
 * tests try. Where force.bound is there, no step is so long that it could pass over more of
 * the force than the tolerance (22.25), but steps of 1e-10 of the run; else a pulse that is
 * shorter than the steps may be passed over. An impulse acts at
 * its time, between two steps; for alpha > 1/2 those that follow begin as short as what it
 * leaves in x'' asks for, and there are more modes for them.
 *
 * fvi_stepper_copy and fvi_stepper_archive know it; a run that was saved goes on only to the same end,
 * h times steps.
 *
 * Equation of a step: one linear solution if U is quadratic and its Hessian diagonal. Else,
 * if something is damped, Hessians of few diagonals, s at most, by Newton's method with one
 * Hessian for all stages; if nothing is, or step_error is above 1e-2 of the size, diagonal
 * ones by Newton's method coordinate by coordinate; others by fixed-point iteration. What
 * does not contract by .8, or coordinate by coordinate by .9, makes the step shorter, and
 * above 1e-2 so does what ends ten times farther off than all motion before; but others
 * then take Newton's method with all stages and coordinates.
 *
 * Cost of a step: O(Q s) for each damped coordinate, Q 70 modes for h = T and 9 more for
 * each decade below, or, above 1e-5 of the size, 30 and 4; s gradients for each
 * iteration, mostly 2 to 6 of them; O(d s^2), and O(s^3) for each mass, damping and
 * spring where h changes. Newton's method is O(d s b^2) more for a Hessian of b
 * diagonals, O(d s^3) coordinate by coordinate, and for all together O(d s^3 b^2) or
 * O(d^3 s^3). Memory O(d (Q + s^2) + d s b), Q 190, or up to 2300 where a start is
 * singular; with all together O(d s^2 b) or O(d^2 s^2) more. Errors as fvi_stepper_start and
 * fvi_stepper_step; FVI_EMAXITER if no step is short enough; FVI_EUNSUP from fvi_stepper_start if it is
 * clear beforehand: a past that bodies have to forget, HELD or RIEMANN_LIOUVILLE with
 * p0 != 0, where alpha < 1 is near 1, one damping strong and another weak (22.23), or
 * RIEMANN_LIOUVILLE with alpha < 1/2 and a damping above 1e248 of the mass; an impulse, for
 * 1 - (4 + n) / 498 < alpha < 1 and a step_error of 10^-n of the size. */
extern const fvi_method fvi_variable_step;

/* fvi_variable_step_takes_structure -- nonzero if fvi_variable_step takes a system with matrices (structures.h)
 * for sure: they have complex factors, no damping has the order 2, and each law is a sum of powers, of
 * fractions with 2 alpha < 0.98, of relaxations, or of powers side by side. alpha, law: as those of a run; with
 * dampers neither is read. fvi_solve asks this when it chooses the method. */
int fvi_variable_step_takes_structure(const fvi_system *system, double alpha,
                                      const fvi_kernel *law);

/* fvi_step_statistics -- what a run of fvi_variable_step has done so far.
 *
 *   steps, rejected  steps taken; trials that were given up
 *   stages           s
 *   form             'D' or 'M'
 *   longest          the longest step, 0 before the first
 *   memory           what part of the size coarser modes may be off by: 1e-7, 3e-10; else 0 */
typedef struct {
    size_t steps, rejected;
    int stages;
    char form;
    double longest, memory;
} fvi_step_statistics;

/* fvi_stepper_statistics -- of a stepper of fvi_variable_step, at any time.
 * Returns FVI_SUCCESS; FVI_EFAULT if a pointer is NULL; FVI_EINVAL for a stepper of
 * another method. */
int fvi_stepper_statistics(const fvi_stepper *s, fvi_step_statistics *counts);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
