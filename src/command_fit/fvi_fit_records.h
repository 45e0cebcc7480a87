/* src/command_fit/fvi_fit_records.h -- What the words of `fvi fit` say of the data. */
#ifndef FVI_FIT_RECORDS_H
#define FVI_FIT_RECORDS_H

#include "fvi_fit_answer.h"

/* --compare: what the columns of DATA show. */
int fvi_fit_columns(fvi_fit_request *r, fvi_error *c);

/* --sigma: one number for each of them. */
int fvi_fit_sigma(fvi_fit_request *r, fvi_error *c);

/* The operands DATA, each with what it has of its own: 'DATA : x0=... : p0=... : force=...'. */
int fvi_fit_read(fvi_fit_request *r, fvi_error *c);

/* Forces are asked for up to the last time of DATA, which is read before the other words are: the
 * word "--time=T", or "--steps=N" where there is --h. None where no force is named, or where a DATA
 * can be read but once. */
void fvi_fit_time(const fvi_subcommand_options *w, char *const *run, size_t size, char *text);

void fvi_fit_records_free(fvi_fit_request *r);

#endif
