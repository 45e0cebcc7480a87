/* src/program/fvi_gradient_rows.h -- The rows of `fvi gradient`, by name. */
#ifndef FVI_GRADIENT_ROWS_H
#define FVI_GRADIENT_ROWS_H

#include "fvi_gradient_answer.h"

/* A row: its name, and where its number stands, or will stand; or a line of warning instead. */
typedef struct {
    void (*visit)(void *to, const char *name, const double *by, const char *warning);
    void *to;
} fvi_gradient_visitor;

/* fvi_gradient_rows -- all rows that a gradient has, in the order of the table. */
void fvi_gradient_rows(const fvi_gradient_request *r, const fvi_gradient_visitor *visitor);

/* fvi_gradient_has_row -- is the row asked for? Without --by each is; x0 stands for x0_1, x0_2, ... */
int fvi_gradient_has_row(const fvi_gradient_request *r, const char *name);

/* fvi_gradient_choose -- what --by does not ask for is not computed. A name that no row has, or only a row without a
 * derivative, is refused, as fvi_refuse does.
 * fvi_gradient_check_answer -- the same of the numbers that were found: NaN is no derivative. */
int fvi_gradient_choose(fvi_gradient_request *r, fvi_error *c);
int fvi_gradient_check_answer(fvi_gradient_request *r, fvi_error *c);

/* Why there is NaN. */
#define FVI_GRADIENT_NO_START "no derivative by %s: other starts have no solution"

#endif
