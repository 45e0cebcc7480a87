/* src/command_fit/fvi_fit_records.h -- Read the options of `fvi fit` about the data, and the data.
 *
 * Functions that take an error return 0, or nonzero with the error filled in. */
#ifndef FVI_FIT_RECORDS_H
#define FVI_FIT_RECORDS_H

#include "fvi_fit_answer.h"

/* Read --compare, which says what the columns of DATA show. */
int fvi_fit_columns(fvi_fit_request *r, fvi_error *c);

/* Read --sigma: one number for each of these columns. */
int fvi_fit_sigma(fvi_fit_request *r, fvi_error *c);

/* Read the operands DATA, each with its own start and force: 'DATA : x0=... : p0=... : force=...'. */
int fvi_fit_read(fvi_fit_request *r, fvi_error *c);

/* Refuse an output that would replace a file that has been read. */
int fvi_fit_check_outputs(const fvi_fit_request *r, fvi_error *c);

/* Write the option "--time=T", or "--steps=N" if --h is given, so that forces are read up to the last time T of DATA.
 * For this purpose the data are read before the other options. Nothing is written if no force and no ground is named.
 * Data that are no ordinary file are skipped, because they can be read only once. */
void fvi_fit_time(const fvi_subcommand_options *w, char *const *run, size_t size, char *text);

void fvi_fit_records_free(fvi_fit_request *r);

#endif
