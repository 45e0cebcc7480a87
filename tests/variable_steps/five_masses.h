/* tests/variable_steps/five_masses.h -- Five masses, some damped, and their start, for tests of H 22. */
#ifndef FIVE_MASSES_H
#define FIVE_MASSES_H

#include <fvi/fvi.h>

enum { D = 5, N = 80 };
static const double one = 1;
static const double mass[D] = { 1, 1, 2, 0.5, 1 },
                    rho[D] = { 0.3, 0.3, 0, 1, 0.1 },
                    start[D] = { 0.5, -0.2, 0.1, 0.7, 0 },
                    push[D] = { 0, 1, -0.5, 0.2, 0.3 };

static inline fvi_run run_of(const fvi_system *system, double step_error)
{
    fvi_run run = fvi_run_default(system, start, push, 0.125, N);
    run.alpha = 0.3;
    run.step_error = step_error;
    return run;
}

#endif
