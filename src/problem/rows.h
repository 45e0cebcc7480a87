/* src/problem/rows.h -- Read rows of numbers from a file; all tables and lists are read by these functions. */
#ifndef FVI_ROWS_H
#define FVI_ROWS_H

#include <fvi/error.h>
#include "system/lines.h"

/* The state of the reader. Numbers are decimal and finite. In the whole file they are separated in the same way: by
 * ';', by ',', or by blanks and tabs. With ';' a comma is a decimal point. A file must not contain decimal points and
 * decimal commas. If blanks are the separators, a comma could be either, so it is refused. An empty field and a word
 * after numbers are refused, too. '#' begins a comment. */
typedef struct {
    const char *field, *name; /* option and name of the file */
    fvi_lines lines;
    char between; /* ';', ',' or ' ', or 0 until a row has two numbers */
    char point;   /* ',' or '.', or 0 until a number has a decimal point */
    double *values;  /* numbers of the row */
    size_t *columns; /* where they begin in the line, from 1 */
    size_t count, room;
    fvi_error *error;
} fvi_rows;

#define FVI_ROWS_NO_NUMBER "not a finite decimal number"
#define FVI_ROWS_TOO_FEW "a number is missing"

typedef enum {
    FVI_ROWS_END,
    FVI_ROWS_NUMBERS, /* `count` numbers are in values */
    FVI_ROWS_WORDS,   /* lines.text begins with a word */
    FVI_ROWS_COMMENT  /* lines.text begins with '#' */
} fvi_rows_kind;

/* fvi_rows_open -- Open the file, which is the value of the option `field`. Return FVI_SUCCESS; FVI_EINVAL if it cannot
 * be read; FVI_ENOMEM. Close it with fvi_rows_close in each case. */
int fvi_rows_open(fvi_rows *rows, const char *field, const char *name,
                  fvi_error *error);

/* fvi_rows_next -- Read the next line that is not empty. Return FVI_SUCCESS; FVI_EINVAL with an error that names file,
 * line and column; FVI_ENOMEM. */
int fvi_rows_next(fvi_rows *rows, fvi_rows_kind *kind);

/* fvi_rows_refuse -- Refuse number i of the row; the error names its line and column. If the row has at most i numbers,
 * the column is the end of the line; if it has none, its beginning. Return FVI_EINVAL. */
int fvi_rows_refuse(const fvi_rows *rows, size_t i, const char *reason);

/* fvi_rows_check_width -- Refuse a row that does not have `width` numbers. Return FVI_SUCCESS or FVI_EINVAL. */
int fvi_rows_check_width(const fvi_rows *rows, size_t width);

void fvi_rows_close(fvi_rows *rows);

#endif
