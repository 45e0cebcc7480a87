/* src/observer/observer_column.h -- How the forces that an observer tells depend on impulses and on the start. [H 23]
 *
 * Internal to the library. In each row the force of a damper is linear in the impulses J_1, ..., J_N of its rows, and in
 * the jump and the line with which its elongation begins, (13.20):
 *
 *     f_k = sum_i a_ki J_i + b_k jump + c_k line.                                    (23.32)
 *
 * What a gradient needs are the sums over k of these coefficients. They are read off the function that makes the forces.
 * The numbers of a damper are those that fvi_observer_read tells: one of a damper along a row, else one for each
 * coordinate. */
#ifndef FVI_OBSERVER_COLUMN_H
#define FVI_OBSERVER_COLUMN_H

#include <fvi/observer.h>

/* fvi_observer_numbers -- how many forces all dampers have together. */
size_t fvi_observer_numbers(const fvi_observer *o);

/* fvi_observer_transpose -- sum_k w_k . f_k, differentiated.
 *
 *   o        of FVI_OBSERVE_FORCE | FVI_OBSERVE_OWN_STEPS, at the start of the run; its sums are of no use afterwards
 *   run      its run
 *   w        dL/df of each row: (N + 1) times the numbers above
 *   impulse  likewise: dL/dJ, to which the sums of w_k a_ki are added
 *   jump, line  outputs: the sums of w_k b_k and of w_k c_k, one for each number
 *
 * Where the force at t = 0 is infinite, that row tells the mean over the first one, and so its w counts. Returns
 * FVI_SUCCESS. */
int fvi_observer_transpose(fvi_observer *o, const fvi_run *run, const double *w, double *impulse, double *jump,
                           double *line);

/* fvi_observer_first_forces -- sum_k w_k . f_k over the first rows alone, in which the law stands in the coefficients.
 *
 *   o        of FVI_OBSERVE_FORCE | FVI_OBSERVE_OWN_STEPS, at the start of a run, which may have another law than the one of the impulses
 *   power    of each number, as fvi_observer_powers has it of the run of the impulses: e, if its J is taken for t^(e - order) g
 *            in the first rows, or NAN, if it is compared with the answers of its law
 *   has_start  nonzero: t = 0 is one of these rows
 *   impulse  J of each row
 *   sum      output */
void fvi_observer_powers(const fvi_observer *o, double *power);
int fvi_observer_first_forces(fvi_observer *o, const fvi_run *run, const double *power, int has_start, const double *w,
                              const double *impulse, double *sum);

/* fvi_observer_size -- the jump and the line of each number; and the rate by which its impulse has the lead more
 * (13.18). Outputs. */
void fvi_observer_size(const fvi_observer *o, double *jump, double *line, double *rate);

/* fvi_observer_damper_of -- to which damper number i belongs, and which coordinate it pushes: that of the largest entry of
 * a row. */
size_t fvi_observer_damper_of(const fvi_observer *o, size_t i, size_t *coordinate);

#endif
