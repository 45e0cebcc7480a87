/* src/options/fvi_values.h -- Interpret the values of the options. */
#ifndef FVI_VALUES_H
#define FVI_VALUES_H

#include "fvi_option_list.h"
#include "fvi_problem.h"

/* fvi_options_interpret -- Interpret o->text, with presets filled in. Return 0, or a code of fvi/error.h with the error
 * filled in and nothing allocated. */
int fvi_options_interpret(fvi_options *o, fvi_error *c);

/* fvi_options_free -- Free the arrays and objects of o. Only o->command and o->about stay, so a second call does
 * nothing. */
void fvi_options_free(fvi_options *o);

#endif
