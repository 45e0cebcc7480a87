/* src/frequency/pole_count.h -- Count the poles of a system.               [H 30] */
#ifndef FVI_POLE_COUNT_H
#define FVI_POLE_COUNT_H

#include "dynamic_stiffness.h"

/* fvi_poles_by_theorem -- Return nonzero if there are d poles by (30.7): K is positive definite, and on the upper side
 * of the cut the symbols of all dampings lie in the same half plane and are not negative. */
int fvi_poles_by_theorem(const fvi_response *response, double least_lambda);

/* fvi_poles_counted -- Count the zeros of det Z with 1.5 < arg s < 3.14 by the argument principle.  (30.8)
 *
 *   low, high  range of ln |s| in which they are counted
 *
 * Return their number, or SIZE_MAX if it is not known: for more unknowns than FVI_ALWAYS_DENSE, with a symbol that has
 * poles of its own, or if a zero is on the boundary. Two overdamped modes that are nearly equal may be counted by
 * mistake. */
size_t fvi_poles_counted(fvi_response *response, double low, double high);

/* fvi_poles_phase -- Return the phase of det Z at s = e^(u + i v); NaN if Z has no factors there. `params` is the
 * response. fvi_poles_step returns the step of ln s by which it may be followed. */
double fvi_poles_phase(const void *params, double u, double v);
double fvi_poles_step(const fvi_response *response);

#endif
