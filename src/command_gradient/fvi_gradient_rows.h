/* src/command_gradient/fvi_gradient_rows.h -- The rows of `fvi gradient`, by name. */
#ifndef FVI_GRADIENT_ROWS_H
#define FVI_GRADIENT_ROWS_H

#include "fvi_gradient_answer.h"

/* Room for a name; a warning has three times as much. */
enum { FVI_GRADIENT_LETTERS = 80 };

/* A row: its name, and where its number stands, or will stand; or a line of warning instead. */
typedef struct {
    void (*visit)(void *to, const char *name, const double *by, const char *warning);
    void *to;
} fvi_gradient_visitor;

/* fvi_gradient_rows -- all rows that a gradient has, in the order of the table. */
void fvi_gradient_rows(const fvi_gradient_request *r, const fvi_gradient_visitor *visitor);

/* Why there is NaN. */
#define FVI_GRADIENT_NO_START "no derivative by %s: other starts have no solution"

#endif
