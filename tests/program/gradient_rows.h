/* tests/program/gradient_rows.h -- Rows that `fvi gradient` prints, and last rows of runs. */
#ifndef GRADIENT_ROWS_H
#define GRADIENT_ROWS_H

#include "program.h"

/* The number behind `name` in out; the test fails without one. */
static inline double derivative(const char *name)
{
    char wanted[80];
    snprintf(wanted, sizeof wanted, "\n%s\t", name);
    const char *at = strstr(out, wanted);
    ck_assert_msg(at != NULL, "no row %s in\n%s", name, out);
    return strtod(at + strlen(wanted), NULL);
}

/* The last row of a run with one more option: so many columns. */
static inline void last_row(const char *options, const char *columns, const char *more,
                            size_t count, double *v)
{
    char line[1000];
    snprintf(line, sizeof line, "run %s --columns %s --every 1000 %s", options,
             columns, more);
    ck_assert_int_eq(fvi(line), 0);
    char *row = strrchr(out, '\n');
    while (row > out && row[-1] != '\n')
        row--;
    for (size_t i = 0; i < count; i++)
        v[i] = strtod(row, &row);
}

static inline double last(const char *options, const char *column, const char *more)
{
    double v;
    last_row(options, column, more, 1, &v);
    return v;
}

#endif
