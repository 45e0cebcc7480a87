/* src/program/fvi_values.h -- From the words of the command line to values. */
#ifndef FVI_VALUES_H
#define FVI_VALUES_H

#include "fvi_option_list.h"

/* Interpret o->text, presets filled in. Returns 0; 2 if a word is refused, 1 if there
 * is no memory, with the complaint written and nothing allocated. */
int fvi_options_interpret(fvi_options *o, fvi_complaint c);

/* fvi_options_free -- give back what was allocated. */
void fvi_options_free(fvi_options *o);

/* fvi_options_system -- the system that the words describe. It points into o. */
fvi_system fvi_options_system(const fvi_options *o);

/* fvi_options_run -- the run of that system. It points into o and the system. */
fvi_run fvi_options_run(const fvi_options *o, const fvi_system *system);

#endif
