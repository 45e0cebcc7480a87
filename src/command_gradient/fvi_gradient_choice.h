/* src/command_gradient/fvi_gradient_choice.h -- Which rows of `fvi gradient` --by asks for. */
#ifndef FVI_GRADIENT_CHOICE_H
#define FVI_GRADIENT_CHOICE_H

#include "fvi_gradient_answer.h"

/* fvi_gradient_has_row -- is the row asked for? Without --by each is; x0 stands for x0_1, x0_2, ... */
int fvi_gradient_has_row(const fvi_gradient_request *r, const char *name);

/* fvi_gradient_choose -- what --by does not ask for is not computed. A name that no row has, or only a row without a
 * derivative, is refused, as fvi_refuse does.
 * fvi_gradient_check_answer -- the same of the numbers that were found: NaN is no derivative. */
int fvi_gradient_choose(fvi_gradient_request *r, fvi_error *c);
int fvi_gradient_check_answer(fvi_gradient_request *r, fvi_error *c);

#endif
