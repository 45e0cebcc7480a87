/* src/options/fvi_option_columns.h -- Interpret --columns and --reduce. */
#ifndef FVI_OPTION_COLUMNS_H
#define FVI_OPTION_COLUMNS_H

#include "fvi_option_list.h"

/* fvi_options_columns -- Make o->columns, o->typed and the arrays that belong to them. Call it when the system is
 * known. With --reduce there are no columns unless --columns is given.
 * fvi_options_check_columns -- Check that this command has these columns.
 * Both return 0, or a code of fvi/error.h with the error filled in. */
int fvi_options_columns(fvi_options *o, fvi_error *c);
int fvi_options_check_columns(const fvi_options *o, fvi_error *c);

/* fvi_options_check_reduced -- Refuse options that a run with --reduce does not use. A sweep does not call it, because
 * its runs share their options with others. Return as above. */
int fvi_options_check_reduced(const fvi_options *o, fvi_error *c);

/* fvi_text_speaks_of -- Return nonzero if the text contains the name with no letter, digit or _ beside it. */
int fvi_text_speaks_of(const char *text, const char *name);

/* fvi_options_observes -- Return nonzero if a column or a reduction has sums over the steps. */
int fvi_options_observes(const fvi_options *o);

/* fvi_options_needs_stepper -- Return nonzero if x and p of a row are not enough for its columns. This is so if a
 * column has sums over the steps, if there are events, or if a column needs the velocity of a mechanism, because p does
 * not determine the velocity of a coordinate without mass. */
int fvi_options_needs_stepper(const fvi_options *o);

#endif
