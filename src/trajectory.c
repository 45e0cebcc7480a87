/* src/trajectory.c -- Runs: a start, a step size, a method.      [Chapter 2] */
#include "trajectory.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_math.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

fvi_run fvi_run_default(const fvi_system *system, const double *x0,
                        const double *p0, double h, size_t steps)
{
    return (fvi_run){ .system = system,
                      .x0 = x0,
                      .p0 = p0,
                      .h = h,
                      .steps = steps,
                      .kappa = 0.5,
                      .alpha = 0.5,
                      .past = FVI_PAST_HELD,
                      .memory = FVI_MEMORY_AUTO };
}

static int check_past(const fvi_method *method, const fvi_run *run)
{
    if (run->past != FVI_PAST_HELD && run->past != FVI_PAST_CAPUTO
        && run->past != FVI_PAST_RIEMANN_LIOUVILLE)
        GSL_ERROR("unknown past", GSL_EINVAL);
    for (size_t i = 0; i < run->system->d && !method->as_printed; i++)
        if (!fvi_past_has_solution(run->past, run->alpha,
                                   run->system->damping[i], run->x0[i]))
            GSL_ERROR("Riemann-Liouville with x0 != 0 has no solution for "
                      "alpha > 1/2",
                      GSL_EDOM);
    return GSL_SUCCESS;
}

static int check(const fvi_method *method, const fvi_run *run)
{
    if (!method || !run || !run->x0 || !run->p0)
        GSL_ERROR("null pointer", GSL_EFAULT);
    int status = fvi_system_check(run->system);
    if (status)
        return status;
    if (run->steps == 0)
        GSL_ERROR("a run has at least one step", GSL_EINVAL);
    if (!(gsl_finite(run->h) && run->h > 0))
        GSL_ERROR("h must be finite and positive", GSL_EDOM);
    if (!(run->kappa >= 0 && run->kappa <= 1))
        GSL_ERROR("kappa must be in [0, 1]", GSL_EDOM);
    if (!(run->alpha >= 0 && run->alpha <= 1))
        GSL_ERROR("alpha must be in [0, 1]", GSL_EDOM);
    if (method->half_only && run->alpha != 0.5)
        GSL_ERROR("this method knows only alpha = 1/2", GSL_EDOM);
    if (!(run->tolerance >= 0 && run->tolerance < 1))
        GSL_ERROR("tolerance must be in [0, 1)", GSL_EDOM);
    if (!fvi_all_finite(run->system->d, run->x0)
        || !fvi_all_finite(run->system->d, run->p0))
        GSL_ERROR("x0 and p0 must be finite", GSL_EDOM);
    return check_past(method, run);
}

int fvi_start(const fvi_method *method, const fvi_run *run,
              fvi_stepper **stepper)
{
    if (!stepper)
        GSL_ERROR("stepper is a null pointer", GSL_EFAULT);
    int status = check(method, run);
    if (status)
        return status;
    const size_t d = run->system->d;
    fvi_stepper *s = calloc(1, sizeof *s);
    double *block = calloc(5 * d, sizeof *block);
    if (!s || !block) {
        free(s);
        free(block);
        GSL_ERROR("no memory for the state", GSL_ENOMEM);
    }
    *s = (fvi_stepper){ .x = block,
                        .p = block + d,
                        .dx = block + 2 * d,
                        .g = block + 3 * d,
                        .F = block + 4 * d,
                        .run = *run,
                        .method = method };
    memcpy(s->x, run->x0, d * sizeof *s->x);
    memcpy(s->p, run->p0, d * sizeof *s->p);
    status = method->start ? method->start(s) : GSL_SUCCESS;
    if (status) {
        fvi_stop(s);
        return status;
    }
    *stepper = s;
    return GSL_SUCCESS;
}

int fvi_step(fvi_stepper *s)
{
    if (!s)
        GSL_ERROR("null pointer", GSL_EFAULT);
    if (s->k >= s->run.steps)
        GSL_ERROR("the run is over", GSL_EINVAL);
    int status = s->method->step(s);
    if (status)
        return status;
    if (!fvi_all_finite(2 * s->run.system->d, s->x)) /* x, then p */
        return GSL_EOVRFLW; /* no mistake of the caller: no handler */
    s->k++;
    s->t = (double)s->k * s->run.h;
    return GSL_SUCCESS;
}

void fvi_stop(fvi_stepper *s)
{
    if (!s)
        return;
    if (s->method->stop)
        s->method->stop(s);
    fvi_newton_free(s->newton);
    free(s->x);
    free(s);
}

static void store(const fvi_stepper *s, double *x, double *p, double *energy)
{
    const size_t d = s->run.system->d;
    if (x)
        memcpy(x + s->k * d, s->x, d * sizeof *x);
    if (p)
        memcpy(p + s->k * d, s->p, d * sizeof *p);
    if (energy)
        energy[s->k] = fvi_energy(s->run.system, s->x, s->p);
}

int fvi_trajectory(const fvi_method *method, const fvi_run *run, double *x,
                   double *p, double *energy)
{
    fvi_stepper *s;
    int status = fvi_start(method, run, &s);
    if (status)
        return status;
    if (run->steps >= SIZE_MAX / sizeof(double) / run->system->d) {
        fvi_stop(s);
        GSL_ERROR("steps must be addressable", GSL_EINVAL);
    }
    store(s, x, p, energy);
    while (s->k < run->steps && (status = fvi_step(s)) == GSL_SUCCESS)
        store(s, x, p, energy);
    fvi_stop(s);
    return status;
}
