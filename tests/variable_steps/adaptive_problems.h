/* tests/variable_steps/adaptive_problems.h -- Random problems for fvi_variable_step_search: how
 * much of 1.2 times the wanted error is used. */
#ifndef ADAPTIVE_PROBLEMS_H
#define ADAPTIVE_PROBLEMS_H

#include <fvi/fvi.h>
#include "run/whole_run.h"
#include "error_control/variable_step_search.h"
#include "system/larger.h"

#include <gsl/gsl_math.h>
#include <gsl/gsl_rng.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { ROWS_MOST = 60, MASSES_MOST = 3 };

/* What is random; and its rows, wanted and found. */
typedef struct {
    size_t d, N;
    double T, alpha, error, mass[MASSES_MOST], rho[MASSES_MOST];
    double x0[MASSES_MOST], p0[MASSES_MOST], spring[2], force[2];
    fvi_initial_history past;
    int kind, pushed; /* of potential, of force */
    double want[(ROWS_MOST + 1) * MASSES_MOST],
        x[(ROWS_MOST + 1) * MASSES_MOST];
    fvi_variable_step_found found;
    int status;
} adaptive_problem;

static inline double between(gsl_rng *r, double low, double high)
{
    return low + (high - low) * gsl_rng_uniform(r);
}

static inline double decades(gsl_rng *r, double low, double high)
{
    return exp(between(r, log(low), log(high)));
}

/* Masses, springs and dampings over decades, one in seven very stiff, one in seven damped
 * very strongly, some not at all; forces that end anywhere or swing fast; all pasts. */
static inline void draw(gsl_rng *r, int linear, adaptive_problem *q)
{
    static const double hard[] = { 0, 0.01, 0.499999, 0.5, 0.500001, 0.95, 1 };
    *q = (adaptive_problem){ .d = linear ? 1 : 1 + gsl_rng_uniform_int(r, 3),
                             .N = 1 + gsl_rng_uniform_int(r, ROWS_MOST) };
    const double w = decades(r, 0.1, 10),
                 stiff = gsl_rng_uniform_int(r, 7) ? 1 : 100,
                 strong = gsl_rng_uniform_int(r, 7) ? 1 : 1e4,
                 none = gsl_rng_uniform_int(r, 10) == 0;
    q->alpha = gsl_rng_uniform_int(r, 4) ? gsl_rng_uniform(r)
                                         : hard[gsl_rng_uniform_int(r, 7)];
    q->T = decades(r, 1, 100) / w;
    q->past = (fvi_initial_history)gsl_rng_uniform_int(r, 3);
    q->kind = (int)gsl_rng_uniform_int(r, 3);
    q->pushed = (int)gsl_rng_uniform_int(r, 3);
    for (size_t j = 0; j < q->d; j++) {
        q->mass[j] = decades(r, 0.1, 10);
        q->rho[j] = none != 0 ? 0
                         : strong * decades(r, 1e-3, 3) * q->mass[j]
                               * pow(w, 2 - 2 * q->alpha);
        q->x0[j] = between(r, -1, 1);
        q->p0[j] = q->mass[j] * w * between(r, -1, 1);
        if (!fvi_initial_history_solvable(q->past, q->alpha, q->rho[j], q->x0[j]))
            q->x0[j] = 0;
    }
    q->spring[0] = stiff * q->mass[0] * w * w;
    q->spring[1] = linear ? 0 : q->spring[0] * decades(r, 0.01, 1);
    q->force[0] = q->mass[0] * w * w * between(r, -2, 2);
    q->force[1] =
        q->pushed == 1 ? q->T * between(r, 0, 1.1) : w * decades(r, 0.1, 100);
    q->error = decades(r, 1e-11, 1e-3);
}

static inline fvi_system system_of(const adaptive_problem *q, int linear)
{
    fvi_system s = { .d = q->d, .mass = q->mass, .damping = q->rho };
    s.potential = linear         ? fvi_potential_harmonic(q->spring)
                  : q->kind == 0 ? fvi_potential_duffing(q->spring)
                  : q->kind == 1 ? fvi_potential_pendulum(q->spring)
                                 : fvi_potential_chain(q->spring);
    if (q->pushed)
        s.force = q->pushed == 1 ? fvi_force_step(q->force)
                                 : fvi_force_cosine(q->force);
    return s;
}

/* The truth: the exact motion; or, where there is none, a run with 1e-13 a step. */
static inline int truth(adaptive_problem *q, int linear, const fvi_run *run)
{
    if (!linear) {
        fvi_run finer = *run;
        finer.step_error = 1e-13;
        return fvi_trajectory(&fvi_variable_step, &finer, q->want, NULL, NULL);
    }
    const fvi_linear_oscillator exact = {
        .m = q->mass[0],
        .c = q->spring[0],
        .rho = q->rho[0],
        .alpha = q->alpha,
        .past = q->past,
        .x0 = q->x0[0],
        .v0 = q->p0[0] / q->mass[0],
        .forcing = q->pushed == 0   ? FVI_FORCING_NONE
                   : q->pushed == 1 ? FVI_FORCING_STEP
                                    : FVI_FORCING_COSINE,
        .A = q->force[0],
        .T = q->force[1],
        .w = q->force[1],
    };
    double t[ROWS_MOST + 1];
    for (size_t k = 0; k <= q->N; k++)
        t[k] = (double)k * run->h;
    return fvi_exact_at(&exact, q->N + 1, t, q->want, NULL, NULL);
}

/* (true error - 1e-12 of the size of the motion) / (1.2 of the wanted error). -1, which the
 * callers count, where nothing can be compared: it was refused, and the error is below 1e-9
 * of that size, or the motion may be chaotic, or alpha is above .99; or the finer run of a
 * motion that may be chaotic was refused. Refused without such a reason is a failure, 2; a
 * linear motion without a truth is one too, NaN. */
static inline double used_by(adaptive_problem *q, int linear)
{
    const fvi_system system = system_of(q, linear);
    fvi_run run =
        fvi_run_default(&system, q->x0, q->p0, q->T / (double)q->N, q->N);
    run.alpha = q->alpha;
    run.past = q->past;
    double size = fabs(q->p0[0]) / sqrt(q->mass[0] * q->spring[0]), worst = 0;
    if (truth(q, linear, &run))
        return linear ? GSL_NAN : -1;
    for (size_t i = 0; i < (q->N + 1) * q->d; i++)
        size = larger(size, fabs(q->want[i]));
    q->error *= size;
    q->status =
        fvi_variable_step_search(&run, 0, NULL, q->error, 1 << 22, q->x, NULL, &q->found);
    if (q->status) /* said in words; is there a reason? */
        return (q->status == FVI_ETOL && (!linear || q->error < 1e-9 * size))
                       || (q->status == FVI_EUNSUP && q->alpha > 0.99)
                   ? -1
                   : 2;
    for (size_t i = 0; i < (q->N + 1) * q->d; i++)
        worst = larger(worst, fabs(q->x[i] - q->want[i]));
    return larger(0, worst - 1e-12 * size) / (1.2 * q->error);
}

static inline void describe_problem(const adaptive_problem *q, char *text,
                                    size_t size)
{
    snprintf(text, size,
             "d=%zu T=%.17g N=%zu alpha=%.17g past=%d m=%.17g rho=%.17g "
             "c=%.17g g=%.17g x0=%.17g p0=%.17g kind=%d "
             "force %d %.17g %.17g error %g: status %d, %zu steps, estimate %g",
             q->d, q->T, q->N, q->alpha, (int)q->past, q->mass[0], q->rho[0],
             q->spring[0], q->spring[1], q->x0[0], q->p0[0], q->kind, q->pushed,
             q->force[0], q->force[1], q->error, q->status,
             q->found.counts.steps, q->found.estimate);
}

#endif
