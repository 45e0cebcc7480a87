/* src/fvi/variable_steps.h -- A method of high order that chooses its own steps.                         [H 22]
 *
 *     m x'' + grad U(x) + rho D^{2 alpha} x = F(t)
 *
 * The method chooses its steps h_k, of different lengths. Let c be the s Lobatto nodes of every step. DD is the block
 * bidiagonal matrix with A^{-1} / h_k on its diagonal and -e_1 e_s^T / (h_k b_1) below it. It is the inverse of the
 * integration from node to node over all steps so far. The damping is a power of DD, and in form D so is the inertia:
 *
 *     m DD^2 x + rho DD^{2 alpha} x + grad U(x) = F                     (form D)
 *
 * With beta = 2 alpha - 1, the present step contributes h_k^{-beta} (A^{-1})^beta for any h_k. The history is a sum of
 * modes exp(-sigma t). All h_k and all sigma are powers of the same number, so one table has the coefficients of all
 * modes. */
#ifndef FVI_VARIABLE_STEPS_H
#define FVI_VARIABLE_STEPS_H

#include "trajectory.h"

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(default)

/* fvi_variable_step -- the method with variable steps, of s = 6 or 8 stages.
 *
 *     fvi_run run = fvi_run_default(&system, x0, p0, T / 100, 100);       // 101 rows
 *     run.alpha = 0.3;
 *     status = fvi_stepper_start(&fvi_variable_step, &run, &stepper, &error);
 *
 * Order. The steps follow the motion, so there is no power of h. With n steps of eight stages the error of x over all t
 * falls about like n^-10; fits of measured errors give exponents between 9 and 12.
 *
 * What it takes. Any system in R^d; all coordinates have the same steps. Any alpha in [0, 1], any rho, any past. A
 * mechanism (dampers.h), by form D. Matrices (structures.h) with complex factors and a product with M, and without
 * damping of order 2; each length of a step has its own factors (27.14). A law of damping whose poles beside the cut
 * have 2 alpha < 0.98 (26.18); if it grows faster than s, then with p0 = 0 and no impulse.
 *
 * Rows and steps. run->h and run->steps say where the rows are, t_k = k h. The steps are the method's own: after
 * fvi_stepper_step s->k counts the rows passed, and s->t is the time of x and p. fvi_stepper_advance_to and fvi_solve
 * interpolate within a step, with about the same error where the force is smooth.
 *
 *   run->step_error  the largest estimated error of x in a step, in the unit of x, >= 0; 0: 1e-10 of the size so far,
 *                    max |x_i|. The error of p is larger. Rounding hides 1e-17 of the size. So a step_error below 1e-17
 *                    of the size at the start is refused (FVI_ETOL); if the size grows, 1e-17 of it is allowed
 *   run->memory      FVI_HISTORY_AUTO or FVI_HISTORY_MODES; other kinds are refused (FVI_EUNSUP)
 *   run->tolerance   not read. The modes have an error of 2e-14; of 3e-10 if step_error is above 1e-7 of the size, and
 *                    of 1e-7 if it is above 1e-5
 *   run->kappa       not read
 *
 * Size at the start. It is max |x0|; if x0 = 0, h max |v0|; if also v0 = 0, h^2 max |F - grad U| / m at t = 0, or 1. A
 * number below 1e-12 of the next one counts as 0. If the Hessian is diagonal, h is here at most 2 sqrt(m / c), where c
 * is its entry at x0. If the Hessian is not diagonal, x0 is compared with the motion possible in that time, where c / m
 * is the largest sum_j |H_ij| / m_i. The method has s = 8, or s = 6 if step_error is above 1e-3 of this size.
 *
 * Form. Without damping the step has form M, that of the variational methods of H 17, which has no numerical damping;
 * else form D. fvi_stepper_statistics tells which.
 *
 * Jumps and pulses of the force. F may jump at any time in force.jumps: a step ends there, and the next steps start
 * small. If a jump is not declared, the method approaches it by some forty rejected steps, or overlooks it if it is
 * small; in the tests x was off by up to 21 step_error. With force.bound no step is so long that it could pass over
 * more of the force than the tolerance (22.25), except for steps of 1e-10 of the run. Without force.bound a step may
 * pass over a pulse that is shorter than the step. An impulse acts at its time, between two steps. For alpha > 1/2 the
 * steps after an impulse are as short as x'' then requires, and there are more modes for them.
 *
 * fvi_stepper_copy and fvi_stepper_archive work with this method. A saved run continues only to the same end, h times
 * steps.
 *
 * Equation of a step. If U is quadratic and its Hessian diagonal, it is one linear solution. Otherwise:
 *
 *   - a Hessian of few diagonals, at most s, and damping: Newton's method, with one Hessian for all stages;
 *   - a diagonal Hessian, without damping or with step_error above 1e-2 of the size: Newton's method, coordinate by
 *     coordinate;
 *   - any other Hessian: fixed-point iteration.
 *
 * If an iteration does not contract by .8, or by .9 coordinate by coordinate, the step becomes shorter; a fixed-point
 * iteration instead gives way to Newton's method for all stages and coordinates together. With step_error above 1e-2 of
 * the size the step also becomes shorter if it ends ten times farther away than all motion before.
 *
 * Cost of a step. O(Q s) for each damped coordinate, where Q is 70 modes for h = T and 9 more for each decade below; 30
 * and 4 if step_error is above 1e-5 of the size. s gradients for each of mostly 2 to 6 iterations; O(d s^2); and O(s^3)
 * for each mass, damping and spring when h changes. Newton's method takes O(d s b^2) more for a Hessian of b diagonals,
 * O(d s^3) coordinate by coordinate, and O(d s^3 b^2) or O(d^3 s^3) for all together. Memory: O(d (Q + s^2) + d s b),
 * where Q is 190, or up to 2300 for a singular start; O(d s^2 b) or O(d^2 s^2) more for all together.
 *
 * Errors as fvi_stepper_start and fvi_stepper_step; FVI_EMAXITER if no step is short enough. fvi_stepper_start returns
 * FVI_EUNSUP if this is clear beforehand:
 *
 *   the past HELD or RIEMANN_LIOUVILLE with p0 != 0, alpha < 1 near 1, one damping strong and another weak (22.23)
 *   the past RIEMANN_LIOUVILLE with alpha < 1/2 and a damping above 1e248 of the mass
 *   an impulse, for 1 - (4 + n) / 498 < alpha < 1 and a step_error of 10^-n of the size */
extern const fvi_method fvi_variable_step;

/* fvi_variable_step_takes_structure -- Return nonzero if fvi_variable_step certainly takes a system with matrices
 * (structures.h): the matrices have complex factors and a product with M, no damping has the order 2, and each law is a
 * sum of FVI_KERNEL_POWER, MAXWELL and DISTRIBUTED terms and of ZENER terms with 2 alpha < 0.98. Return 0 for a system
 * without matrices. fvi_solve uses this function to choose the method.
 *
 *   alpha, law  as those of a run; with several dampers neither is read */
int fvi_variable_step_takes_structure(const fvi_system *system, double alpha,
                                      const fvi_kernel *law);

/* fvi_step_statistics -- counts of a run of fvi_variable_step, up to its present step.
 *
 *   steps, rejected  number of steps, and of rejected trial steps
 *   stages           s
 *   form             'D' or 'M'
 *   longest          the longest step; 0 before the first
 *   memory           the error of the modes, relative to the size: 1e-7 or 3e-10 for coarser modes; 0 for the finest */
typedef struct {
    size_t steps, rejected;
    int stages;
    char form;
    double longest, memory;
} fvi_step_statistics;

/* fvi_stepper_statistics -- Copy the counts of a stepper of fvi_variable_step, at any step.
 *
 *     fvi_step_statistics counts;
 *     if (fvi_stepper_statistics(s, &counts) == FVI_SUCCESS)
 *         printf("%zu steps of form %c\n", counts.steps, counts.form);
 *
 * Returns FVI_SUCCESS; FVI_EFAULT if a pointer is NULL; FVI_EINVAL for a stepper of another method. */
int fvi_stepper_statistics(const fvi_stepper *s, fvi_step_statistics *counts);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
