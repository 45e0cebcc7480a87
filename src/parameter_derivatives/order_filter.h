/* src/parameter_derivatives/order_filter.h -- The derivative of sums by the order of a power. [H 23]
 *
 * Internal. The weights of a power are those of (1 - z)^(2 alpha) times a factor g(z), (13.11) or
 * (13.16). A memory gives the derivative of the first alone; the filter adds that of g. */
#ifndef FVI_ORDER_FILTER_H
#define FVI_ORDER_FILTER_H

#include <fvi/convolution_quadrature.h>
#include <fvi/trajectory.h>

typedef struct {
    size_t taps, place, width; /* taps < 2: there is no factor; the latest is at [place] */
    size_t past_taps;          /* of g */
    double g[FVI_BDF2_TAPS], gdot[FVI_BDF2_TAPS]; /* the factor, and its derivative, or both over g */
    double *ring, *ring_by_order; /* width 2 taps each: the last sums, twice; owned */
} fvi_order_filter;

/* fvi_order_filter_start -- for sums of `width` numbers; f is zeroed before, and given back by
 * fvi_order_filter_stop in any case. Returns FVI_SUCCESS or FVI_ENOMEM. */
int fvi_order_filter_start(fvi_scheme scheme, double alpha, size_t width,
                           fvi_order_filter *f);

/* fvi_order_filter_next -- the derivative by 2 alpha of the next sums.
 *
 *   H, Hdot  what the memory has given, and its own derivative
 *   out      room
 *
 * Returns the derivative: out, or Hdot where there is no factor. */
const double *fvi_order_filter_next(fvi_order_filter *f, const double *H,
                                    const double *Hdot, double *out);

void fvi_order_filter_stop(fvi_order_filter *f);

#endif
