/* tests/program/fit_rows.h -- Rows and lines of what `fvi fit` prints. */
#ifndef FIT_ROWS_H
#define FIT_ROWS_H

#include "program.h"

/* The row of a parameter in out: estimate, sd, lower, upper. */
static inline void row_of(const char *name, double row[4])
{
    char start[40];
    snprintf(start, sizeof start, "\n%s\t", name);
    const char *at = strstr(out, start);
    ck_assert_msg(at, "%s is not in %s", name, out);
    ck_assert_int_eq(sscanf(at + strlen(start), "%lf\t%lf\t%lf\t%lf", row,
                            row + 1, row + 2, row + 3),
                     4);
}

static inline double value_of(const char *name)
{
    char start[60];
    snprintf(start, sizeof start, "\n# %s = ", name);
    const char *at = strstr(out, start);
    ck_assert_msg(at, "%s is not in %s", name, out);
    return strtod(at + strlen(start), NULL);
}

#endif
