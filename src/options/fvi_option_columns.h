/* src/options/fvi_option_columns.h -- --columns and --reduce. */
#ifndef FVI_OPTION_COLUMNS_H
#define FVI_OPTION_COLUMNS_H

#include "fvi_option_list.h"

/* fvi_options_columns -- o->columns, o->typed and what goes with it; the system of o is there. With --reduce
 * a list of columns that was not asked for is none.
 * fvi_options_check_columns -- can this command, this method, have them? */
int fvi_options_columns(fvi_options *o, fvi_error *c);
int fvi_options_check_columns(const fvi_options *o, fvi_error *c);

/* fvi_options_check_reduced -- refuse what a run with --reduce has no use for. A sweep takes it: its runs share
 * their words with others. */
int fvi_options_check_reduced(const fvi_options *o, fvi_error *c);

/* fvi_text_speaks_of -- does the name stand in the text, with no letter, digit or _ beside it? */
int fvi_text_speaks_of(const char *text, const char *name);

/* fvi_options_observes -- nonzero if what is asked for has sums over the steps. */
int fvi_options_observes(const fvi_options *o);

/* fvi_options_needs_stepper -- nonzero if x and p of a row are not enough for its columns: they have sums over
 * the steps, or a velocity of a mechanism, where p tells nothing of a coordinate without mass. */
int fvi_options_needs_stepper(const fvi_options *o);

#endif
