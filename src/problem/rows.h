/* src/problem/rows.h -- Rows of numbers in a file: the one reader of tables and lists. */
#ifndef FVI_ROWS_H
#define FVI_ROWS_H

#include <fvi/error.h>
#include "system/lines.h"

/* Numbers are decimal and finite. They are separated by ';', by ',' or by blanks and tabs, in
 * the whole file in the same way. With ';' a comma is a decimal point; points and decimal
 * commas do not stand in one file. A comma next to blanks as separators may be either, and is
 * refused; so are an empty field and a word behind numbers. '#' begins a comment. */
typedef struct {
    const char *field, *name; /* of the file */
    fvi_lines lines;
    char between; /* ';', ',' or ' ', or 0 as long as no row has two numbers */
    char point;   /* ',' or '.', or 0 as long as no number has a point */
    double *values;  /* of the row */
    size_t *columns; /* where they begin in the line, from 1 */
    size_t count, room;
    fvi_error *error;
} fvi_rows;

#define FVI_ROWS_NO_NUMBER "not a finite decimal number"
#define FVI_ROWS_TOO_FEW "a number is missing"

typedef enum {
    FVI_ROWS_END,
    FVI_ROWS_NUMBERS, /* values: count of them */
    FVI_ROWS_WORDS,   /* lines.text begins with a word */
    FVI_ROWS_COMMENT  /* lines.text begins with '#' */
} fvi_rows_kind;

/* fvi_rows_open -- open the file, as the value of the field. Returns FVI_SUCCESS; FVI_EINVAL if it
 * cannot be read; FVI_ENOMEM. Close it with fvi_rows_close in any case. */
int fvi_rows_open(fvi_rows *rows, const char *field, const char *name,
                  fvi_error *error);

/* fvi_rows_next -- the next line that is not empty. Returns FVI_SUCCESS; FVI_EINVAL with an error
 * that names file, line and column; FVI_ENOMEM. */
int fvi_rows_next(fvi_rows *rows, fvi_rows_kind *kind);

/* fvi_rows_refuse -- refuse number i of the row, with line and column; the end of the line if
 * it has no more than i numbers, its beginning if it has none. Returns FVI_EINVAL. */
int fvi_rows_refuse(const fvi_rows *rows, size_t i, const char *reason);

/* fvi_rows_check_width -- refuse a row that has not so many numbers. Returns FVI_SUCCESS or
 * FVI_EINVAL. */
int fvi_rows_check_width(const fvi_rows *rows, size_t width);

void fvi_rows_close(fvi_rows *rows);

#endif
