/* src/newton/newton_lanes.h -- Solve the equations of several oscillators as lanes of a vector.  [H 28] */
#ifndef FVI_NEWTON_LANES_H
#define FVI_NEWTON_LANES_H

#include "newton_stages.h"

/* fvi_newton_by_lanes -- Solve the equations of a system of lanes if U is not quadratic, or if there are several
 * stages. fvi_newton_solve calls it; arguments and codes are the same, and FVI_ENOMEM is possible, too. Each
 * lane gets the solution of its own run, to the last digit: it stops when its own iteration has converged,
 * whatever the other lanes do. */
int fvi_newton_by_lanes(fvi_newton *n, const double *x, const double *r, double *d, double *g);

#endif
