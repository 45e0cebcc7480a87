/* src/problem/polygon.h -- A table as a function of t.                          [H 18] */
#ifndef FVI_POLYGON_H
#define FVI_POLYGON_H

#include <stddef.h>

/* n rows; their t stand `stride` numbers apart, their F `F_stride`. */
typedef struct {
    size_t n, stride, F_stride;
    const double *t, *F;
} fvi_polygon;

/* fvi_polygon_row -- low, where t_low <= t < t_{low + 1}, or the first or the last two rows;
 * 0 of a table of one. F may be NULL. */
size_t fvi_polygon_row(const fvi_polygon *p, double t);

/* fvi_polygon_value -- linear between two rows; before the first and behind the last its
 * first and its last F. */
double fvi_polygon_value(const fvi_polygon *p, double t);

/* fvi_polygon_bound -- most[k d], k = 0, ..., order, as fvi_force's bound (system.h). */
void fvi_polygon_bound(const fvi_polygon *p, double from, double to,
                       size_t order, size_t d, double *most);

#endif
