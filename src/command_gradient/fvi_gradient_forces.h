/* src/command_gradient/fvi_gradient_forces.h -- Add what forces and the ground contribute to a gradient. */
#ifndef FVI_GRADIENT_FORCES_H
#define FVI_GRADIENT_FORCES_H

#include "fvi_gradient_answer.h"

/* fvi_gradient_add_forces -- Add to r->lets the derivative by each --let that stands in the force or in the
 * acceleration of the ground. It follows from r->force, the derivatives by the numbers of the force.
 * fvi_gradient_add_ground -- Add the contribution of the ground's force -M r a_g to the derivatives by the masses.
 * Return FVI_SUCCESS or the code of the acceleration's function. */
void fvi_gradient_add_forces(fvi_gradient_request *r);
int fvi_gradient_add_ground(fvi_gradient_request *r);

#endif
