/* figures/springpot/first_run.h -- H 0: the data of the first run.
 *
 * m = c = 1, rho = 1/2, alpha = 1/4, so that the damping is of order 1/2. */
#ifndef FIRST_RUN_H
#define FIRST_RUN_H

#include <fvi/fvi.h>
#include "run/whole_run.h"
#include "ladder.h"

enum { ROWS = 4000, FORK = 560 };
#define STEP 0.005

/* x and p of the library, ROWS + 1 numbers each, of a body held at x0 and let go there
 * with p0. Returns what fvi_trajectory returns. */
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

/* The same body on a ladder of order 1/2, whose time eta / k is 1/1000 and whose rho,
 * the root of k eta, is 1/2; all nodes at x0. */
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
