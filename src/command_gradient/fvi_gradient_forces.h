/* src/command_gradient/fvi_gradient_forces.h -- What forces and the ground add to a gradient. */
#ifndef FVI_GRADIENT_FORCES_H
#define FVI_GRADIENT_FORCES_H

#include "fvi_gradient_answer.h"

/* fvi_gradient_add_forces -- add to r->lets the derivative by each --let that stands in the force or the ground. It
 * is made of the derivatives by the numbers of the force, r->force.
 * fvi_gradient_add_ground -- the ground's force -m a_g, to the derivatives by the masses. Returns a code. */
void fvi_gradient_add_forces(fvi_gradient_request *r);
int fvi_gradient_add_ground(fvi_gradient_request *r);

#endif
