/* src/output/fvi_format.h -- A table as text: tsv, csv, json. */
#ifndef FVI_FORMAT_H
#define FVI_FORMAT_H

#include "options/fvi_option_list.h"

#include <stdio.h>

/* fvi_print_number -- `before`, and then v as the shortest number that comes back. */
void fvi_print_number(FILE *out, const char *before, double v);

/* fvi_print_estimate -- the rest of the row of a fitted number, behind its name. */
void fvi_print_estimate(FILE *out, double estimate, double sd, double lower, double upper);

/* In this order: the version, as the first parameter; parameters; the names of the columns,
 * then rows; the end. What a format has no place for is not printed. */
void fvi_format_begin(FILE *out, fvi_format format);

/* A parameter; in json a number if its value is one. */
void fvi_format_parameter(FILE *out, fvi_format format, const char *name,
                          const char *value);

/* A name: that of column i; number 0, or the one that stands behind the word. */
void fvi_format_name(FILE *out, fvi_format format, size_t i, const char *word,
                     size_t number);
void fvi_format_names_end(FILE *out, fvi_format format);

/* Row i of `width` finite numbers. */
void fvi_format_row(FILE *out, fvi_format format, size_t i, size_t width,
                    const double *row);

/* Behind the rows: events, of each the time and what was watched. csv has no place for them:
 * they go to standard error. */
void fvi_format_events_begin(FILE *out, fvi_format format);
void fvi_format_event(FILE *out, fvi_format format, size_t i, double t,
                      const char *name, const char *ending);
void fvi_format_end(FILE *out, fvi_format format);

#endif
