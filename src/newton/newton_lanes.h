/* src/newton/newton_lanes.h -- The equations of several oscillators at once.   [H 28] */
#ifndef FVI_NEWTON_LANES_H
#define FVI_NEWTON_LANES_H

#include "newton_stages.h"

/* fvi_newton_by_lanes -- as fvi_newton_solve, of a system with lanes whose U is not quadratic, or with
 * several stages. Each lane has the solution, digit for digit, that its own run finds: it
 * does not wait for the others, and goes no further with them. */
int fvi_newton_by_lanes(fvi_newton *n, const double *x, const double *r, double *d, double *g);

#endif
