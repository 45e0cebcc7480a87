/* src/command_gradient/fvi_gradient_dampers.h -- Compute `fvi gradient --of d1.force`: derivatives of the last force or
 * impulse of a damper. */
#ifndef FVI_GRADIENT_DAMPERS_H
#define FVI_GRADIENT_DAMPERS_H

#include "fvi_gradient_answer.h"

/* Return nonzero if --of names a force or an impulse, as in d1.force2 or NAME.impulse. */
int fvi_gradient_is_of_damper(const char *text);

/* Find what --of names. r->of becomes 3 for a force and 4 for an impulse. r->i is its position among the numbers of all
 * dampers, and r->of_dampers is the count of these numbers. Return 0, or nonzero with the error filled in. */
int fvi_gradient_find_damper(fvi_gradient_request *r, fvi_error *c);

/* Return nonzero if --of names a force that comes from steps shorter than those of the run, if the run begins beside x0
 * along coordinate i. */
int fvi_gradient_is_short_beside(const fvi_gradient_request *r, size_t i);

/* Compute r->value and the derivatives; NaN by an x0 beside which the force is that of shorter steps. Return
 * FVI_SUCCESS or a code of the library. */
int fvi_gradient_of_damper(fvi_gradient_request *r, const fvi_objective *objective);

#endif
