/* tests/lobatto/lobatto_load.h -- The load of one mass, for the tests of H 17. */
#ifndef LOBATTO_LOAD_H
#define LOBATTO_LOAD_H

#include <fvi/error.h>
#include <fvi/stability.h>
#include "harness/ulp.h"

/* fvi_stability_lobatto for one mass and h = 1: W and R are c and rho. */
static inline double load_at(size_t s, double alpha, double W, double R)
{
    const double one = 1, zero = 0;
    const fvi_system system = { 1,     &one, &R, fvi_potential_harmonic(&W),
                                { 0 }, NULL, NULL };
    const fvi_run run = {
        .system = &system, .x0 = &zero, .h = 1, .alpha = alpha
    };
    double load = -1;
    ck_assert_int_eq(fvi_stability_lobatto(s, &run, &load), FVI_SUCCESS);
    return load;
}

#endif
