/* src/parameter_derivatives/order_filter.c -- The derivative of the sums of a history by the order of a power.
 * [H 23] */
#include "order_filter.h"

#include "constant_history.h"
#include "system/fail.h"

#include <stdlib.h>

int fvi_order_filter_start(fvi_scheme scheme, double alpha, size_t width,
                           fvi_order_filter *f)
{
    if (scheme == FVI_SCHEME_CQ_BDF2) { /* g = ((3 - z)/2)^(2 alpha), and g'/g is a logarithm */
        f->taps = fvi_bdf2_log(f->gdot);
        f->past_taps = 1;
        f->g[0] = 1;
    } else
        f->taps = f->past_taps = fvi_power_factor(scheme, alpha, f->g, f->gdot);
    f->width = width;
    if (f->taps < 2)
        return FVI_SUCCESS;
    f->ring = calloc(4 * f->taps * width, sizeof *f->ring);
    if (!f->ring)
        FVI_FAIL("no memory for the adjoint run", FVI_ENOMEM);
    f->ring_by_order = f->ring + 2 * f->taps * width;
    return FVI_SUCCESS;
}

/* The history takes in g lambda. So the derivative of its sums N through g is y = (g'/g) N, a filter of the sums. It is
 * computed from g y = g' N. */
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
               *rated = f->ring_by_order + i * 2 * taps + f->place;
        past[0] = past[taps] = H[i];
        const double y = (fvi_power_factor_sum(taps, f->gdot, past)
                          - fvi_dot(f->past_taps - 1, f->g + 1, rated + 1))
                         / f->g[0];
        rated[0] = rated[taps] = y;
        out[i] = Hdot[i] + y;
    }
    return out;
}
//< filter

void fvi_order_filter_stop(fvi_order_filter *f)
{
    free(f->ring);
}
