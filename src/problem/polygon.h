/* src/problem/polygon.h -- Interpolate a table linearly.                          [H 18] */
#ifndef FVI_POLYGON_H
#define FVI_POLYGON_H

#include <stddef.h>

/* A table of n rows. t has steps of `stride` numbers between rows, F of `F_stride`. */
typedef struct {
    size_t n, stride, F_stride;
    const double *t, *F;
} fvi_polygon;

/* fvi_polygon_row -- Return the row low with t_low <= t < t_{low + 1}. Outside the table return the first or the last
 * but one row; 0 for a table of one row. F may be NULL. */
size_t fvi_polygon_row(const fvi_polygon *p, double t);

/* fvi_polygon_value -- Return F at t, linear between two rows. Before the first row and after the last one, F is that
 * of the row. */
double fvi_polygon_value(const fvi_polygon *p, double t);

/* fvi_polygon_bound -- Fill in most[k d], k = 0, ..., order, as the bound of fvi_force (system.h). */
void fvi_polygon_bound(const fvi_polygon *p, double from, double to,
                       size_t order, size_t d, double *most);

#endif
