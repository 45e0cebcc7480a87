/* src/command_gradient/fvi_gradient_dampers.h -- `fvi gradient --of d1.force`: the last force or impulse of a damper. */
#ifndef FVI_GRADIENT_DAMPERS_H
#define FVI_GRADIENT_DAMPERS_H

#include "fvi_gradient_answer.h"

/* Does --of name a force or an impulse, d1.force2 or NAME.impulse? */
int fvi_gradient_is_of_damper(const char *text);

/* What it names: r->of is 3 of a force and 4 of an impulse, r->i its place among all numbers of all dampers, and
 * r->of_dampers how many these are. Returns the exit code. */
int fvi_gradient_find_damper(fvi_gradient_request *r, fvi_error *c);

/* r->value and the derivatives. Returns a code of the library's. */
int fvi_gradient_of_damper(fvi_gradient_request *r, const fvi_objective *objective);

#endif
