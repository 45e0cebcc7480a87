/* src/observer/observer_ramp.c -- The error of the first impulses of a damper after a start with a velocity. [H 13] */
#include "observer_state.h"

#include "kernel/kernel_impulses.h"
#include "kernel/kernel_terms.h"
#include "mechanism/mechanism_state.h"
#include "methods/convolution_quadrature_dampers.h"
#include "run/run_damper.h"

#include <fvi/convolution_quadrature_methods.h>

#include <math.h>
#include <stdlib.h>

/* A body so heavy that no damper slows it down. It moves along x = t, and the impulses of its damper are those of the
 * line. */
static const double huge_mass = 1e150, one = 1, zero = 0;

static const fvi_system line = { .d = 1, .mass = &huge_mass, .damping = &one };

struct fvi_ramp {
    fvi_stepper *body; /* its motion is prescribed */
    fvi_impulses_of_kernel *exact; /* for a law that is not one power */
    double rho, order;             /* for one power */
    double is_over;                /* nonzero: no step adds anything any more */
};

static int is_by_quadrature(const fvi_method *method)
{
    return method->scheme == FVI_SCHEME_CQ_BDF2 || method->scheme == FVI_SCHEME_CQ2_SHIFTED
           || method->scheme == FVI_SCHEME_CQ2_MIDPOINT;
}

const fvi_method *fvi_ramp_method(const fvi_stepper *s)
{
    if (!is_by_quadrature(s->method))
        return NULL;
    return s->mechanism ? &fvi_cq2_midpoint : s->method; /* the line is no mechanism; both methods sum alike */
}

int fvi_ramp_start(const fvi_stepper *s, size_t j, fvi_ramp **ramp)
{
    const fvi_run_damper of = fvi_run_damper_of(&s->run, j);
    fvi_run run = fvi_run_default(&line, &zero, &huge_mass, s->run.h, s->run.steps);
    *ramp = NULL;
    if (!is_by_quadrature(s->method) || !(of.growth <= 1))
        return FVI_SUCCESS;
    fvi_ramp *o = calloc(1, sizeof *o);
    if (!o)
        return FVI_ENOMEM;
    run.memory = s->run.memory;
    run.tolerance = s->run.tolerance;
    run.alpha = of.alpha;
    run.law = fvi_summed_damper_of(s, j).law;
    o->order = of.growth;
    o->rho = !run.law ? 1 : fvi_kernel_is_power(run.law) ? run.law->term->rho : NAN;
    int status = fvi_stepper_start(fvi_ramp_method(s), &run, &o->body, NULL);
    if (!status && isnan(o->rho))
        status = fvi_impulses_of_kernel_alloc(run.law, run.h, &o->exact);
    if (status)
        fvi_ramp_free(o);
    else
        *ramp = o;
    return status;
}

/* The exact impulse of the line from t_k to t_{k+1}. */
static double exact_impulse(fvi_ramp *o, size_t k)
{
    double ends[2];
    if (o->exact) {
        fvi_impulses_of_kernel_at(o->exact, k, ends);
        return ends[0] + ends[1];
    }
    const double e = 2 - o->order, n = (double)k;
    const double rise = k == 0 ? 1 : pow(n, e) * expm1(e * log1p(1 / n));
    return o->rho * pow(o->body->run.h, e) * rise / tgamma(1 + e);
}

int fvi_ramp_step_prescribed(fvi_stepper *bodies, double *J)
{
    const fvi_cq_state *cq = bodies->method_state;
    const fvi_cq_damper *a = cq->each;
    if (cq->count == 0)
        return fvi_stepper_step(bodies);
    int status = fvi_damping_apply_force(a->damping, a->theta - 0.5, a->H, J);
    if (!status)
        status = fvi_stepper_step(bodies);
    return status ? status : fvi_damping_apply_force(a->damping, -0.5 - a->theta, a->H, J);
}

int fvi_ramp_step(fvi_ramp *o, double *lead)
{
    if (o->is_over != 0)
        return FVI_SUCCESS;
    double impulse = 0;
    const double exact = exact_impulse(o, o->body->k);
    const int status = fvi_ramp_step_prescribed(o->body, &impulse);
    *lead += exact - impulse;
    o->is_over = fabs(exact - impulse) <= 1e-10 * fabs(exact) && o->body->k > 4;
    return status;
}

int fvi_ramp_leads(const fvi_stepper *s, size_t j, size_t rows, int is_whole, double *lead)
{
    fvi_ramp *ramp;
    double sum = 0;
    int status = fvi_ramp_start(s, j, &ramp);
    for (size_t k = 0; k < rows && !status; k++) {
        if (ramp && is_whole)
            ramp->is_over = 0;
        if (ramp)
            status = fvi_ramp_step(ramp, &sum);
        lead[k] = sum;
    }
    fvi_ramp_free(ramp);
    return status;
}

int fvi_ramp_copy(const fvi_ramp *from, fvi_ramp **to)
{
    fvi_ramp *o = *to = malloc(sizeof *o);
    if (!o)
        return FVI_ENOMEM;
    *o = *from;
    o->body = NULL;
    o->exact = NULL;
    const int status = fvi_stepper_copy(from->body, &o->body);
    return status || !from->exact ? status : fvi_impulses_of_kernel_copy(from->exact, &o->exact);
}

int fvi_ramp_archive(fvi_ramp *o, fvi_archive *archive)
{
    const int status = archive->serialize(archive, &o->is_over, sizeof o->is_over, 0);
    return status || o->is_over != 0 ? status : fvi_stepper_archive(o->body, archive);
}

void fvi_ramp_free(fvi_ramp *o)
{
    if (!o)
        return;
    fvi_stepper_free(o->body);
    fvi_impulses_of_kernel_free(o->exact);
    free(o);
}

/* ---- for all dampers of a run ---- */

/* Write the rates of damper j: for a mechanism one, the rate of its elongation; else C v0, one for each coordinate. */
static int begin_rates(fvi_observer *o, const fvi_stepper *s, size_t j, int *acts)
{
    const fvi_run_damper of = fvi_run_damper_of(&s->run, j);
    const size_t d = o->d;
    double z, *rate = o->rate + (o->has_mechanism ? j : j * d);
    int status = FVI_SUCCESS;
    if (o->has_mechanism) {
        status = fvi_observer_elongation(o, s, &s->run.system->mechanism->damper[j].of, &z, rate);
        o->power[j] = *rate * *rate;
        *acts = *rate != 0;
        return status;
    }
    if (o->matrices)
        status = fvi_damping_multiply(&of.matrix, d, of.rho, o->v, rate);
    for (size_t i = 0; i < d && !status; i++) {
        if (!o->matrices)
            rate[i] = s->run.system->damping[i] * o->v[i];
        o->power[j] += rate[i] * o->v[i];
        *acts |= rate[i] != 0;
    }
    return status;
}

int fvi_observer_begin_ramps(fvi_observer *o, const fvi_stepper *s)
{
    if (!o->is_damped || o->is_mass || !is_by_quadrature(s->method))
        return FVI_SUCCESS;
    o->ramp = calloc(o->dampers + 1, sizeof *o->ramp);
    if (!o->ramp)
        return FVI_ENOMEM;
    int status = fvi_observer_velocity(o, s, s->p, o->v);
    for (size_t j = 0; j < o->dampers && !status; j++) {
        int acts = 0;
        status = begin_rates(o, s, j, &acts);
        if (!status && acts)
            status = fvi_ramp_start(s, j, &o->ramp[j]);
    }
    return status;
}

int fvi_observer_step_ramps(fvi_observer *o, double *changed)
{
    int status = FVI_SUCCESS;
    for (size_t j = 0; j < o->dampers && !status; j++) {
        const double lead = o->lead[j];
        if (o->ramp[j])
            status = fvi_ramp_step(o->ramp[j], &o->lead[j]);
        changed[j] = o->lead[j] - lead;
    }
    return status;
}

int fvi_observer_copy_ramps(const fvi_observer *from, fvi_observer *to)
{
    int status = FVI_SUCCESS;
    to->ramp = calloc(from->dampers + 1, sizeof *to->ramp);
    if (!to->ramp)
        return FVI_ENOMEM;
    for (size_t j = 0; j < from->dampers && !status; j++)
        if (from->ramp[j])
            status = fvi_ramp_copy(from->ramp[j], &to->ramp[j]);
    return status;
}

void fvi_observer_free_ramps(fvi_observer *o)
{
    for (size_t j = 0; o->ramp && j < o->dampers; j++)
        fvi_ramp_free(o->ramp[j]);
    free(o->ramp);
}
