/* src/methods/force_times.h -- The times at which a step of given length evaluates its force.   [H 2, 13, 17] */
#ifndef FVI_FORCE_TIMES_H
#define FVI_FORCE_TIMES_H

#include <fvi/trajectory.h>

enum { FVI_MOST_FORCE_TIMES = 8 };

/* fvi_step_force_times -- Write the times at which a method of the library evaluates F in step k, from k h to
 * (k + 1) h, to t, in their order. Return their number: 1 for a method that takes a node, and 2 or the number of stages
 * for a method that takes the limits of F from within the step at its ends; 0 for a method that chooses its steps. */
size_t fvi_step_force_times(const fvi_method *method, double h, size_t k, double t[FVI_MOST_FORCE_TIMES]);

#endif
