/* src/command_gradient/fvi_gradient_rows.h -- Name the rows of `fvi gradient`. */
#ifndef FVI_GRADIENT_ROWS_H
#define FVI_GRADIENT_ROWS_H

#include "fvi_gradient_answer.h"

/* Bytes for a name; a warning has three times as many. */
enum { FVI_GRADIENT_LETTERS = 80 };

/* The visitor of a row. It is called with the name of the row and a pointer to its number, now or later, or with a
 * warning instead of the number. */
typedef struct {
    void (*visit)(void *to, const char *name, const double *by, const char *warning);
    void *to;
} fvi_gradient_visitor;

/* fvi_gradient_rows -- Visit all rows of a gradient, in the order of the table. */
void fvi_gradient_rows(const fvi_gradient_request *r, const fvi_gradient_visitor *visitor);

/* The reason for a NaN. */
#define FVI_GRADIENT_NO_START "no derivative by %s: other starts have no solution"

#endif
