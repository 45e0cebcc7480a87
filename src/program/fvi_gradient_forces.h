/* src/program/fvi_gradient_forces.h -- What forces and the ground add to a gradient. */
#ifndef FVI_GRADIENT_FORCES_H
#define FVI_GRADIENT_FORCES_H

#include "fvi_gradient_answer.h"

/* From the derivatives by each number of the force, in r->force, those by names that stand in the force or
 * the ground; and by the masses, with which the ground pulls. The second returns a code. */
void fvi_gradient_add_forces(fvi_gradient_request *r);
int fvi_gradient_add_ground(fvi_gradient_request *r);

#endif
