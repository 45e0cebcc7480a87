/* src/frequency/pole_count.h -- How many poles are there?               [H 30] */
#ifndef FVI_POLE_COUNT_H
#define FVI_POLE_COUNT_H

#include "dynamic_stiffness.h"

/* fvi_poles_by_theorem -- nonzero if (30.7) says that there are d: K is positive definite, and the
 * symbols of all dampings are in one half plane on the upper side of the cut, and not negative. */
int fvi_poles_by_theorem(const fvi_response *response, double least_lambda);

/* fvi_poles_counted -- zeros of det Z with arg s < 3.14, by the argument principle.  (30.8)
 *
 *   low, high  ln |s| between which they are
 *
 * Returns their number, or SIZE_MAX if it is not known: of more unknowns than FVI_ALWAYS_DENSE,
 * with a symbol that has poles of its own, or where a zero is on the boundary. Two overdamped modes
 * that are nearly alike may be counted by mistake. */
size_t fvi_poles_counted(fvi_response *response, double low, double high);

#endif
