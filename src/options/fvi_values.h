/* src/options/fvi_values.h -- From the words of the command line to values. */
#ifndef FVI_VALUES_H
#define FVI_VALUES_H

#include "fvi_option_list.h"
#include "fvi_problem.h"

/* Interpret o->text, presets filled in. Returns 0, or a code of fvi/error.h with the
 * error written and nothing allocated. */
int fvi_options_interpret(fvi_options *o, fvi_error *c);

/* fvi_options_free -- give back what was allocated. */
void fvi_options_free(fvi_options *o);

#endif
