/* tests/lobatto/lobatto_pairs.h -- Two runs that must be equal, for the tests of H 17. */
#ifndef LOBATTO_PAIRS_H
#define LOBATTO_PAIRS_H

#include "lobatto_runs.h"

enum { N = 400 };
static double x[3 * N + 3], p[3 * N + 3], want_x[3 * N + 3], want_p[3 * N + 3];

static const double alphas[] = { 0,   1e-9, 0.1, 0.25, 0.49,
                                 0.6, 0.75, 0.9, 0.99, 1 - 1e-9 };

/* Two runs that are equal but for rounding: some roundings of a number of the size
 * of x, p in each of n steps, all of one sign at the worst, none amplified (which
 * holds for these systems and times). An estimate, not a proof. Seen: 0.14 of it. */
static inline double rounding(const setup *a)
{
    const double size = 1 + farthest(0, a->steps + 1, want_x, NULL)
                        + farthest(0, a->steps + 1, want_p, NULL);
    return 2 * (double)a->steps * U * size;
}

#endif
