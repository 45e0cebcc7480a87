/* src/parameter_derivatives/order_filter.h -- The derivative of the sums of a history by the order of a power. [H 23]
 *
 * Internal. The weights of a power are the weights of (1 - z)^(2 alpha) times a factor g(z), (13.11) or (13.16). A
 * history gives the derivative of (1 - z)^(2 alpha) alone. This filter adds the derivative of g. */
#ifndef FVI_ORDER_FILTER_H
#define FVI_ORDER_FILTER_H

#include <fvi/convolution_quadrature.h>
#include <fvi/trajectory.h>

typedef struct {
    size_t taps, place, width; /* taps < 2: there is no factor; the latest term is at [place] */
    size_t past_taps;          /* how many coefficients g has */
    double g[FVI_BDF2_TAPS], gdot[FVI_BDF2_TAPS]; /* the factor g and its derivative; for BDF2 1 and g'/g */
    double *ring, *ring_by_order; /* 2 taps for each of the width numbers: the last sums, stored twice; owned */
} fvi_order_filter;

/* fvi_order_filter_start -- start a filter for sums of `width` numbers. *f is zeroed before; give it back with
 * fvi_order_filter_stop, also after an error. Returns FVI_SUCCESS or FVI_ENOMEM. */
int fvi_order_filter_start(fvi_scheme scheme, double alpha, size_t width,
                           fvi_order_filter *f);

/* fvi_order_filter_next -- compute the derivative of the next sums by 2 alpha.
 *
 *   H, Hdot  the sums of the history, and their derivative without the factor
 *   out      room for `width` numbers
 *
 * Returns the derivative: out, or Hdot if there is no factor. */
const double *fvi_order_filter_next(fvi_order_filter *f, const double *H,
                                    const double *Hdot, double *out);

void fvi_order_filter_stop(fvi_order_filter *f);

#endif
