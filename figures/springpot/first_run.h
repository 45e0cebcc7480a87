/* figures/springpot/first_run.h -- H 0: the first run of the Handbook, by the library and by a ladder.
 *
 * m = c = 1, rho = 1/2, alpha = 1/4, so the damping has the order 1/2. */
#ifndef FIRST_RUN_H
#define FIRST_RUN_H

#include <fvi/fvi.h>
#include "run/whole_run.h"
#include "ladder.h"

enum { ROWS = 4000, FORK = 560 };
#define STEP 0.005

/* Compute x and p, ROWS + 1 numbers each, of a body that is held at x0 and let go with the momentum p0, with the
 * library. Returns the code of fvi_trajectory. */
static inline int first_run(double x0, double p0, double *x, double *p)
{
    const double one = 1, rho = 0.5;
    const fvi_system system = { .d = 1,
                                .mass = &one,
                                .damping = &rho,
                                .potential = fvi_potential_harmonic(&one) };
    fvi_run run = fvi_run_default(&system, &x0, &p0, STEP, ROWS);
    run.alpha = 0.25;
    return fvi_trajectory(&fvi_lobatto_m4, &run, x, p, NULL);
}

/* Return the same body on a ladder of order 1/2, with all nodes at x0 and the velocity v0 of the body. The time eta / k
 * of the ladder is 1/1000 and its rho, the square root of k eta, is 1/2. */
static inline ladder first_ladder(double x0, double v0)
{
    const double k = sqrt(1000) / 2;
    ladder l = ladder_of_order(0.5, k, k / 1000);
    l.m = l.c = 1;
    l.v = v0;
    for (size_t j = 0; j < RUNGS; j++)
        l.x[j] = x0;
    return l;
}

#endif
