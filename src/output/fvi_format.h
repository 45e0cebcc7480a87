/* src/output/fvi_format.h -- Write a table as text: tsv, csv or json. */
#ifndef FVI_FORMAT_H
#define FVI_FORMAT_H

#include "options/fvi_option_list.h"

#include <stdio.h>

/* fvi_print_number -- Write `before`, and then v in the fewest digits that read back to the same double. */
void fvi_print_number(FILE *out, const char *before, double v);

/* fvi_print_estimate -- Write the numbers of the row of a fitted parameter, which has its name already. */
void fvi_print_estimate(FILE *out, double estimate, double sd, double lower, double upper);

/* Call these functions in this order: begin, which writes the version as the first parameter; parameters; the names of
 * the columns; rows; end. If a format has no place for something, it is not written. */
void fvi_format_begin(FILE *out, fvi_format format);

/* Write a parameter. In json it is a number if its value reads as a finite number. */
void fvi_format_parameter(FILE *out, fvi_format format, const char *name,
                          const char *value);

/* Write the name of column i: the word, followed by `number` unless that is 0. */
void fvi_format_name(FILE *out, fvi_format format, size_t i, const char *word,
                     size_t number);
void fvi_format_names_end(FILE *out, fvi_format format);

/* Write row i of `width` finite numbers. */
void fvi_format_row(FILE *out, fvi_format format, size_t i, size_t width,
                    const double *row);

/* After the rows, write the events: for each event its time and its text. csv has no place for events, so they go to
 * standard error. */
void fvi_format_events_begin(FILE *out, fvi_format format);
void fvi_format_event(FILE *out, fvi_format format, size_t i, double t,
                      const char *name, const char *ending);
void fvi_format_end(FILE *out, fvi_format format);

#endif
