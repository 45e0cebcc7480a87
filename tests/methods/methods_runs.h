/* tests/methods/methods_runs.h -- The table, and runs of every method in it. */
#ifndef METHODS_RUNS_H
#define METHODS_RUNS_H

#include <fvi/fvi.h>
#include "harness/ulp.h"

#include <gsl/gsl_math.h>

enum { STEPS = 40 };
static const double one = 1, rho = 0.5, start = 1, push = 0.25;
static double c = 1;

/* One mass on a spring or a pendulum, with damping; where there is one, the direct sum,
 * which AUTO takes for so few steps. */
static inline fvi_run run_of(const fvi_system *system, double alpha)
{
    fvi_run run = fvi_run_default(system, &start, &push, 0.125, STEPS);
    run.alpha = alpha;
    return run;
}

static inline fvi_system spring(void)
{
    return (
        fvi_system){ 1, &one, &rho, fvi_potential_harmonic(&c), { 0 }, NULL, NULL };
}

static inline fvi_system pendulum(void)
{
    return (
        fvi_system){ 1, &one, &rho, fvi_potential_pendulum(&c), { 0 }, NULL, NULL };
}

static inline double middle(const fvi_method *m)
{
    return m->alpha_least + 0.3 * (m->alpha_most - m->alpha_least);
}

/* A loop over the table. */
#define FOR_EACH(m)                                                            \
    for (size_t i_ = 0; fvi_methods[i_]; i_++)                                 \
        for (const fvi_method *m = fvi_methods[i_]; m; m = NULL)

#endif
