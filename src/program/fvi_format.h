/* src/program/fvi_format.h -- A table as text: tsv, csv, json. */
#ifndef FVI_FORMAT_H
#define FVI_FORMAT_H

#include <stddef.h>
#include <stdio.h>

/* tsv: lines "# name = value", a line "# " with the names, rows parted by tabs.
 * csv: the names, rows parted by commas, no head.
 * json: { "parameters": {...}, "columns": [...], "rows": [[...], ...] }. */
typedef enum { FVI_FORMAT_TSV, FVI_FORMAT_CSV, FVI_FORMAT_JSON } fvi_format;

extern const char *const fvi_format_names[]; /* in this order, ended by NULL */

/* fvi_shortest -- the shortest decimal number that is read back as v, finite. Of those
 * with as many digits the nearest to v. Returns its length. */
int fvi_shortest(double v, char text[32]);

/* fvi_print_number -- `before`, and then v in that way. */
void fvi_print_number(FILE *out, const char *before, double v);

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
void fvi_format_end(FILE *out, fvi_format format);

#endif
