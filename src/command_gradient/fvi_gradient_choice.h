/* src/command_gradient/fvi_gradient_choice.h -- Find the rows of `fvi gradient` for which --by asks. */
#ifndef FVI_GRADIENT_CHOICE_H
#define FVI_GRADIENT_CHOICE_H

#include "fvi_gradient_answer.h"

/* fvi_gradient_has_row -- Return nonzero if the row is asked for. Without --by each row is; x0 stands for x0_1, x0_2,
 * ... */
int fvi_gradient_has_row(const fvi_gradient_request *r, const char *name);

/* fvi_gradient_choose -- Leave out the derivatives for which --by does not ask. Refuse a name that no row has, and a
 * name whose rows have no derivative.
 * fvi_gradient_check_answer -- After the run, refuse a name whose rows are NaN, which means that there is no
 * derivative.
 * Both return 0, or nonzero with the error filled in. */
int fvi_gradient_choose(fvi_gradient_request *r, fvi_error *c);
int fvi_gradient_check_answer(fvi_gradient_request *r, fvi_error *c);

#endif
