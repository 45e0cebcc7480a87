/* tests/step_search/step_search_runs.h -- Random linear problems, and searches of their step
 * that are compared with the exact solution, for the tests of H 18. */
#ifndef STEP_SEARCH_RUNS_H
#define STEP_SEARCH_RUNS_H


#include <fvi/fvi.h>
#include "error_control/step_search.h"
#include "harness/ulp.h"
#include "system/seeded.h"

#include <gsl/gsl_math.h>

enum { ROWS = 50 }; /* at most */

/* Uniform in [low, high]. */
static inline double dice(double low, double high)
{
    static uint64_t seed = 20240607;
    return fvi_seeded_uniform(&seed, low, high);
}

/* The cosine is within reach of the rows. */
static inline fvi_linear_oscillator any_problem(void)
{
    return (fvi_linear_oscillator){ .m = dice(0.5, 2),
                         .c = dice(0.2, 5),
                         .rho = dice(0.05, 1),
                         .alpha = dice(0.05, 0.95),
                         .past = FVI_INITIAL_HISTORY_CAPUTO,
                         .x0 = dice(-1, 1),
                         .v0 = dice(-1, 1),
                         .forcing = FVI_FORCING_COSINE,
                         .A = dice(-1, 1),
                         .w = dice(0, 3) };
}

/* max |x - exact| over the rows */
static inline double true_error(const fvi_linear_oscillator *q, double h, size_t rows,
                                const double *x)
{
    double t[ROWS + 1], want[ROWS + 1], worst = 0;
    for (size_t k = 0; k <= rows; k++)
        t[k] = (double)k * h;
    ck_assert_int_eq(fvi_exact_at(q, rows + 1, t, want, NULL,
                                  NULL), FVI_SUCCESS);
    for (size_t k = 0; k <= rows; k++)
        worst = larger(worst, fabs(x[k] - want[k]));
    return worst;
}

/* What decides: fvi_step_search, or another function of the same arguments. */
typedef int decider(const fvi_method *method, const fvi_run *run, double error,
                    size_t most, double *x, double *p, fvi_step_found *found);

/* rows rows to T; the status of the search, and what its error truly is. */
static inline int search_with(decider *decide, const fvi_method *method,
                              const fvi_linear_oscillator *q, double T, size_t rows,
                              double error, size_t most, fvi_step_found *found,
                              double *worst)
{
    const double aw[2] = { q->A, q->w }, p0 = q->m * q->v0;
    const fvi_force force = q->forcing == FVI_FORCING_COSINE
                                ? fvi_force_cosine(aw)
                                : (fvi_force){ 0 };
    const fvi_system system = { 1,       &q->m,
                                &q->rho, fvi_potential_harmonic(&q->c),
                                force,   NULL, NULL };
    const fvi_run run = { .system = &system,
                          .x0 = &q->x0,
                          .p0 = &p0,
                          .h = T / (double)rows,
                          .steps = rows,
                          .kappa = 0.5,
                          .alpha = q->alpha,
                          .past = q->past };
    double x[ROWS + 1];
    int status = decide(method, &run, error, most, x, NULL, found);
    *worst = status ? GSL_POSINF : true_error(q, run.h, rows, x);
    return status;
}

static inline int search_linear(const fvi_method *method, const fvi_linear_oscillator *q,
                                double T, size_t rows, double error,
                                size_t most, fvi_step_found *found,
                                double *worst)
{
    return search_with(fvi_step_search, method, q, T, rows, error, most, found,
                       worst);
}

#endif
