/* src/problem/force_table.c -- Make a force from measured rows.                        [H 18] */
#include <fvi/parse.h>

#include "polygon.h"

static fvi_polygon column_of(const fvi_force_rows *rows, size_t i)
{
    return (fvi_polygon){ rows->n, 1, rows->columns, rows->t, rows->F + i };
}

static int value(double t, size_t d, void *params, double *F)
{
    const fvi_force_rows *rows = params;
    for (size_t i = 0; i < d; i++) {
        const fvi_polygon column = column_of(rows, i);
        F[i] = i < rows->columns ? fvi_polygon_value(&column, t) : F[0];
    }
    return 0;
}

static int bound(double from, double to, size_t order, size_t d, void *params,
                 double *most)
{
    const fvi_force_rows *rows = params;
    for (size_t i = 0; i < d; i++) {
        const fvi_polygon column = column_of(rows, i);
        if (i < rows->columns)
            fvi_polygon_bound(&column, from, to, order, d, most + i);
        for (size_t k = 0; i >= rows->columns && k <= order; k++)
            most[k * d + i] = most[k * d];
    }
    return 0;
}

fvi_force fvi_force_table(const fvi_force_rows *rows)
{
    return rows->n == 0 ? (fvi_force){ 0 }
                        : (fvi_force){ .value = value,
                                       .params = (void *)rows,
                                       .jumps = rows->t,
                                       .jump_count = rows->n,
                                       .bound = bound };
}
