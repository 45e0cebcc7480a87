/* tests/bench/peers/product_one.h -- Methods of order 2 for one mass.   [H 18] */
#ifndef PRODUCT_ONE_H
#define PRODUCT_ONE_H

#include "peers.h"
#include "product_weights.h"

/* product_one -- compute the rows of a run of a rule on one mass, d = 1. by_modes: the trapezoidal FLMM2 has
 * its past as exponentials, to the tolerance. Returns FVI_SUCCESS, FVI_ENOMEM, or FVI_EMAXITER if an iteration
 * does not end. */
int product_one(const task *of, rule which, int by_modes, double *rows);

#endif
