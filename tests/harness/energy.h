/* tests/harness/energy.h -- Return the energy as a number, NaN if fvi_energy fails. */
#ifndef ENERGY_H
#define ENERGY_H

#include <fvi/system.h>

#include <math.h>

static inline double energy_of(const fvi_system *system, const double *x,
                               const double *p)
{
    double E;
    return fvi_energy(system, x, p, &E) ? (double)NAN : E;
}

#endif
