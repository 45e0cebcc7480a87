/* src/observer/observer_column.h -- The forces of an observer as linear functions of impulses and of the start. [H 23]
 *
 * Internal to the library. In each row the force of a damper is linear in the impulses J_1, ..., J_N of its rows, and
 * in the jump and the line with which its elongation begins, (13.20):
 *
 *     f_k = sum_i a_ki J_i + b_k jump + c_k line.                                    (23.32)
 *
 * A gradient needs the sums over k of these coefficients. They are read off the function that computes the forces. The
 * numbers of a damper are those that fvi_observer_read gives: one number for a damper along a row or an elongation, and
 * one for each coordinate for other dampers. */
#ifndef FVI_OBSERVER_COLUMN_H
#define FVI_OBSERVER_COLUMN_H

#include <fvi/observer.h>

/* fvi_observer_numbers -- how many forces all dampers have together. */
size_t fvi_observer_numbers(const fvi_observer *o);

/* fvi_observer_transpose -- the derivatives of L = sum_k w_k . f_k by the impulses, the jumps and the lines.
 *
 *   o           started with FVI_OBSERVE_FORCE | FVI_OBSERVE_OWN_STEPS, at the start of the run; its sums are of no use
 *               afterwards
 *   run         its run
 *   w           dL/df of each row: N + 1 rows of the numbers above
 *   impulse     rows likewise: the sums of w_k a_ki are added to it
 *   jump, line  outputs: the sums of w_k b_k and of w_k c_k, one for each number
 *
 * If the force at t = 0 is infinite, its row is the mean over the first row, and its w is the derivative by this mean.
 * Returns FVI_SUCCESS. */
int fvi_observer_transpose(fvi_observer *o, const fvi_run *run, const double *w, double *impulse, double *jump,
                           double *line);

/* fvi_observer_first_forces -- sum_k w_k . f_k over the first rows only, whose coefficients depend on the law.
 *
 *   o          started with FVI_OBSERVE_FORCE | FVI_OBSERVE_OWN_STEPS, at the start of a run whose law may differ from
 *              the law of the run of the impulses
 *   power      one for each number, from fvi_observer_powers of the run of the impulses: e if its J is taken for
 *              t^(e - order) g in the first rows, or NAN if J is compared with the answers of its law
 *   has_start  nonzero: t = 0 is one of these rows
 *   impulse    J of each row
 *   sum        output */
void fvi_observer_powers(const fvi_observer *o, double *power);
int fvi_observer_first_forces(fvi_observer *o, const fvi_run *run, const double *power, int has_start, const double *w,
                              const double *impulse, double *sum);

/* fvi_observer_size -- write the jump and the line of each number, and the rate with which the lead (13.18) is added to
 * its impulse. */
void fvi_observer_size(const fvi_observer *o, double *jump, double *line, double *rate);

/* fvi_observer_damper_of -- the damper that number i belongs to, and to *coordinate the coordinate it acts on; for a
 * damper along a row the coordinate with the largest entry. */
size_t fvi_observer_damper_of(const fvi_observer *o, size_t i, size_t *coordinate);

#endif
