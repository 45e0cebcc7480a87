/* tests/stability/scalar_run.h -- The scalar problem, for the tests of H 14. */
#ifndef SCALAR_RUN_H
#define SCALAR_RUN_H

#include <fvi/fvi.h>
#include "harness/ulp.h"

#include <gsl/gsl_math.h>

/* A run of the scalar problem with given W, R and h = m = 1. */
static double m = 1, c, rho, x0, p0 = 1;
static fvi_system scalar;

static inline fvi_run scalar_run(double alpha, double kappa, double W, double R,
                                 size_t steps)
{
    c = W;
    rho = R;
    scalar =
        (fvi_system){ 1, &m, &rho, fvi_potential_harmonic(&c), { 0 }, NULL, NULL };
    return (fvi_run){ .system = &scalar,
                      .x0 = &x0,
                      .p0 = &p0,
                      .h = 1,
                      .steps = steps,
                      .kappa = kappa,
                      .alpha = alpha };
}

#endif
