/* tests/lobatto/lobatto_runs.h -- Runs in one dimension, for the tests of H 17. */
#ifndef LOBATTO_RUNS_H
#define LOBATTO_RUNS_H

#include <fvi/error.h>
#include "run/whole_run.h"
#include <fvi/lobatto.h>
#include "harness/ulp.h"

#include <gsl/gsl_math.h>

static const fvi_method *const methods[] = {
    NULL,          NULL,          &fvi_lobatto_m2, &fvi_lobatto_m3, &fvi_lobatto_m4,
    &fvi_lobatto_m5, &fvi_lobatto_m6, &fvi_lobatto_m7, &fvi_lobatto_m8
};
/* The same of form D. */
static const fvi_method *const damped[] = { NULL,           NULL,
                                            &fvi_lobatto_d2, &fvi_lobatto_d3,
                                            &fvi_lobatto_d4, &fvi_lobatto_d5,
                                            &fvi_lobatto_d6, &fvi_lobatto_d7,
                                            &fvi_lobatto_d8 };

typedef struct {
    size_t s;
    double alpha, rho, x0, p0, h;
    size_t steps;
    double cg[2]; /* Duffing */
    fvi_force force;
    fvi_history_kind memory;
    double mass; /* 0 stands for 1 */
    double tolerance;
} setup;

static inline int try_run(const setup *a, double *x, double *p)
{
    const double mass = a->mass > 0 ? a->mass : 1;
    const fvi_system system = { 1,        &mass,
                                &a->rho,  fvi_potential_duffing(a->cg),
                                a->force, NULL, NULL };
    const fvi_run run = { .system = &system,
                          .x0 = &a->x0,
                          .p0 = &a->p0,
                          .h = a->h,
                          .steps = a->steps,
                          .alpha = a->alpha,
                          .past = FVI_INITIAL_HISTORY_CAPUTO,
                          .memory = a->memory,
                          .tolerance = a->tolerance };
    return fvi_trajectory(methods[a->s], &run, x, p, NULL);
}

static inline void solve(const setup *a, double *x, double *p)
{
    ck_assert_int_eq(try_run(a, x, p), FVI_SUCCESS);
}

/* max |v_i - w_i|, i >= first; w may be NULL for zero. */
static inline double farthest(size_t first, size_t n, const double *v,
                              const double *w)
{
    double max = 0;
    for (size_t i = first; i < n; i++)
        max = larger(max, fabs(v[i] - (w ? w[i] : 0)));
    return max;
}

#endif
