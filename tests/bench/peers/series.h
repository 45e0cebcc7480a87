/* tests/bench/peers/series.h -- Power series of a force along a motion. [H 18] */
#ifndef SERIES_H
#define SERIES_H

#include "peers.h"

enum { SERIES_MOST = 32 };

/* series_term -- return g_n of U'(x(t)) = sum_n g_n t^n for one mass with x(t) = sum_n x_n t^n.
 *
 *   n       the calls are in order, 0, 1, 2, ...
 *   x       x_0, ..., x_n
 *   room    2 (SERIES_MOST + 1) numbers, kept from one n to the next
 *   params  of the potential */
typedef double (*series_term)(size_t n, const double *x, double *room,
                              const double *params);

/* series_of -- return the function for the potential of this problem; NULL if there is none. */
series_term series_of(const problem *p);

#endif
