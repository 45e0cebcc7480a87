/* tests/identification/identification_runs.h -- Fits to data of known parameters, for the
 * tests of H 24. */
#ifndef IDENTIFICATION_RUNS_H
#define IDENTIFICATION_RUNS_H

#include "identification_ref.h"

#include <fvi/fvi.h>
#include "harness/seen.h"
#include "harness/ulp.h"

#include <gsl/gsl_randist.h>
#include <gsl/gsl_rng.h>
#include <string.h>

/* In the order of the reference values. */
static const fvi_free_parameter FIVE[] = { FVI_FREE_PARAMETER_ALPHA, FVI_FREE_PARAMETER_RHO,
                                      FVI_FREE_PARAMETER_CONSTANT, FVI_FREE_PARAMETER_X0,
                                      FVI_FREE_PARAMETER_P0 };

/* All that a fit points to: a spring, its mass, where the search begins. */
typedef struct {
    double m, rho, constants[2], x0, p0, t[REF_POINTS], x[REF_POINTS];
    fvi_system system;
    fvi_run run;
    fvi_estimation fit;
} question;

/* A linear spring, the values of the run far from those of the references; the data are
 * x, at their times, and `parameters` of FIVE are asked for. */
static inline void ask(question *q, const double *x, size_t parameters)
{
    *q = (question){
        .m = 1, .rho = 0.2, .constants = { 2.5, 0 }, .x0 = 1, .p0 = 0.25
    };
    q->system =
        (fvi_system){ .d = 1,
                      .mass = &q->m,
                      .damping = &q->rho,
                      .potential = fvi_potential_duffing(q->constants) };
    q->run = fvi_run_default(&q->system, &q->x0, &q->p0, 1, 1);
    for (size_t i = 0; i < REF_POINTS; i++)
        q->t[i] = 0.1 * (double)(i + 1);
    if (x)
        memcpy(q->x, x, sizeof q->x);
    q->fit = (fvi_estimation){ .method = &fvi_lobatto_m4,
                        .run = &q->run,
                        .constants = q->constants,
                        .n = REF_POINTS,
                        .t = q->t,
                        .x = q->x,
                        .parameters = parameters,
                        .which = FIVE,
                        .starts = 4 };
}

static inline void add_noise(question *q, double sigma, gsl_rng *r)
{
    for (size_t i = 0; i < q->fit.n; i++)
        q->x[i] += gsl_ran_gaussian(r, sigma);
    q->fit.sigma = sigma;
}

/* The worst distance from the truth, in standard deviations. */
static inline double off(const fvi_estimate *f, const double *truth, size_t P)
{
    double worst = 0;
    for (size_t j = 0; j < P; j++)
        worst = larger(worst, fabs(f->estimate[j] - truth[j]) / f->sd[j]);
    return worst;
}

static int handled; /* how often the error handler was called */
static inline void handler(const char *reason, const char *file, int line,
                           int code)
{
    (void)reason;
    (void)file;
    (void)line;
    (void)code;
    handled++;
}

#endif
