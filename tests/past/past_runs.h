/* tests/past/past_runs.h -- Runs in one dimension, for the tests of H 19. */
#ifndef PAST_RUNS_H
#define PAST_RUNS_H

#include <fvi/fvi.h>
#include "run/whole_run.h"
#include "harness/ulp.h"

#include <gsl/gsl_math.h>

static const fvi_method *const methods[] = { &fvi_fractional, &fvi_cq2_shifted,
                                             &fvi_cq_bdf2,       &fvi_lobatto_m2,
                                             &fvi_lobatto_m3,   &fvi_lobatto_m4 };
enum { FVI, SHIFTED, BDF2, LOBATTO2, LOBATTO3, LOBATTO4, METHODS };

static const fvi_initial_history pasts[] = { FVI_INITIAL_HISTORY_HELD, FVI_INITIAL_HISTORY_CAPUTO,
                                  FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE };
static const char *const past_names[] = { "held", "Caputo",
                                          "Riemann-Liouville" };

/* m = 1, U = c x^2/2 + g x^4/4; g = 0 is the harmonic potential. */
typedef struct {
    fvi_initial_history past;
    double alpha, rho, x0, p0, cg[2];
} problem;

static inline int try_run(const fvi_method *method, const problem *q, double h,
                          size_t steps, double *x, double *p)
{
    const double one = 1;
    const fvi_system system = { .d = 1,
                                .mass = &one,
                                .damping = &q->rho,
                                .potential =
                                    q->cg[1] == 0
                                        ? fvi_potential_harmonic(q->cg)
                                        : fvi_potential_duffing(q->cg) };
    fvi_run run = fvi_run_default(&system, &q->x0, &q->p0, h, steps);
    run.alpha = q->alpha;
    run.past = q->past;
    return fvi_trajectory(method, &run, x, p, NULL);
}

static inline void solve(const fvi_method *method, const problem *q, double h,
                         size_t steps, double *x, double *p)
{
    ck_assert_int_eq(try_run(method, q, h, steps, x, p), FVI_SUCCESS);
}

/* x and x' of the linear problem at `count` times. */
static inline void exact(const problem *q, size_t count, const double *t,
                         double *x, double *v)
{
    const fvi_linear_oscillator linear = { .m = 1,
                                .c = q->cg[0],
                                .rho = q->rho,
                                .alpha = q->alpha,
                                .past = q->past,
                                .x0 = q->x0,
                                .v0 = q->p0 };
    ck_assert_int_eq(fvi_exact_at(&linear, count, t, x, v, NULL), FVI_SUCCESS);
}

#endif
