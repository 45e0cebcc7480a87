/* src/parameter_derivatives/order_filter.c -- The derivative of sums by the order of a power. [H 23] */
#include "order_filter.h"

#include "constant_history.h"
#include "system/fail.h"

#include <stdlib.h>

int fvi_order_filter_start(fvi_scheme scheme, double alpha, size_t width,
                           fvi_order_filter *f)
{
    f->taps = fvi_power_factor(scheme, alpha, f->g, f->gdot);
    f->width = width;
    if (f->taps < 2)
        return FVI_SUCCESS;
    f->ring = calloc(4 * f->taps * width, sizeof *f->ring);
    if (!f->ring)
        FVI_FAIL("no memory for the mirrored run", FVI_ENOMEM);
    f->ring_by_order = f->ring + 2 * f->taps * width;
    return FVI_SUCCESS;
}

/* The memory takes in g lambda, so that the derivative by g is that of the filter g'/g on its
 * sums:  g y = g' N. */
//> filter
const double *fvi_order_filter_next(fvi_order_filter *f, const double *H,
                                    const double *Hdot, double *out)
{
    const size_t taps = f->taps;
    if (taps < 2)
        return Hdot;
    f->place = (f->place ? f->place : taps) - 1;
    for (size_t i = 0; i < f->width; i++) {
        double *past = f->ring + i * 2 * taps + f->place,
               *rated = f->ring_by_order + i * 2 * taps + f->place, y = 0;
        past[0] = past[taps] = H[i];
        y += f->gdot[0] * past[0];
        for (size_t n = 1; n < taps; n++)
            y += f->gdot[n] * past[n] - f->g[n] * rated[n];
        rated[0] = rated[taps] = y /= f->g[0];
        out[i] = Hdot[i] + y;
    }
    return out;
}
//< filter

void fvi_order_filter_stop(fvi_order_filter *f)
{
    free(f->ring);
}
