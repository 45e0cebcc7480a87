/* src/problem/polygon.c -- Interpolate a table linearly.                          [H 18] */
#include "polygon.h"

#include "system/larger.h"

#include <math.h>

size_t fvi_polygon_row(const fvi_polygon *p, double t)
{
    size_t low = 0, high = p->n - 1;
    while (high - low > 1) {
        const size_t middle = low + (high - low) / 2;
        if (p->t[middle * p->stride] <= t)
            low = middle;
        else
            high = middle;
    }
    return low;
}

double fvi_polygon_value(const fvi_polygon *p, double t)
{
    if (t <= p->t[0])
        return p->F[0];
    if (t >= p->t[(p->n - 1) * p->stride])
        return p->F[(p->n - 1) * p->F_stride];
    const size_t low = fvi_polygon_row(p, t), high = low + 1;
    const double part_of = (t - p->t[low * p->stride])
                           / (p->t[high * p->stride] - p->t[low * p->stride]);
    return p->F[low * p->F_stride]
           + part_of * (p->F[high * p->F_stride] - p->F[low * p->F_stride]);
}

/* The bound is that of the lines of the table between two times. If there is a kink among them, there is no second
 * derivative. */
void fvi_polygon_bound(const fvi_polygon *p, double from, double to,
                       size_t order, size_t d, double *most)
{
    double low = fvi_polygon_value(p, from), high = low, slope = 0, t = from,
           F = low;
    size_t kinks = 0;
    for (size_t i = fvi_polygon_row(p, from); t < to; i++) {
        if (i < p->n && p->t[i * p->stride] <= from)
            continue;
        const int is_row = i < p->n && p->t[i * p->stride] < to;
        const double next_t = is_row ? p->t[i * p->stride] : to,
                     next = is_row ? p->F[i * p->F_stride]
                                   : fvi_polygon_value(p, to);
        kinks += is_row ? 1 : 0;
        slope = larger(slope, fabs((next - F) / (next_t - t)));
        low = smaller(low, next);
        high = larger(high, next);
        t = next_t;
        F = next;
    }
    for (size_t k = 0; k <= order; k++)
        most[k * d] = k == 0   ? (high - low) / 2 * (1 + 1e-15)
                      : k == 1 ? slope * (1 + 1e-12)
                      : kinks  ? INFINITY
                               : 0;
}
