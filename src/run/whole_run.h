/* src/run/whole_run.h -- Write a whole run into arrays. */
#ifndef FVI_WHOLE_RUN_H
#define FVI_WHOLE_RUN_H

#include <fvi/trajectory.h>

/* fvi_trajectory -- write a whole run into arrays.
 *
 *   x, p    NULL, or (steps + 1) d numbers: component i of row k at [k * d + i]
 *   energy  NULL, or steps + 1 numbers
 *
 * A NULL array is not computed. Returns what fvi_stepper_start and fvi_stepper_step return, and FVI_EINVAL if
 * (steps + 1) d numbers cannot be addressed. If fvi_stepper_start refuses the run, the arrays are untouched. If the
 * step to row k, or U in its energy, fails, the rows 0 ... k - 1 are valid. */
int fvi_trajectory(const fvi_method *method, const fvi_run *run, double *x,
                   double *p, double *energy);

#endif
