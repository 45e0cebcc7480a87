/* src/estimation/identification_tangent.c -- A run and its derivatives, side by side.
 *                                                                     [H 24] */
#include "identification_tangent.h"

#include <fvi/fvi.h>
#include "system/fail.h"
#include "system/system_check.h"

#include <stdlib.h>
#include <string.h>

#define ENOUGH                                                                 \
    1e-10 /* for a memory of stages: slopes lead to the least, and are not it */

static double rho(const fvi_tangent_run *o)
{
    return o->run->system->damping[0];
}

static double velocity_at_start(const fvi_tangent_run *o)
{
    return o->run->p0[0] / o->run->system->mass[0];
}

/* ---- one step ---- */

int fvi_tangent_evaluate_potential(fvi_tangent_run *o, size_t i, double X)
{
    const fvi_system *system = o->run->system;
    double H[2] = { 0, 0 };
    int status = fvi_potential_hessian(system, &X, H);
    for (size_t j = 0; j < o->P && !status; j++) {
        const fvi_free_parameter which = o->which[j];
        o->G[i * o->P + j] = H[0];
        if (which >= FVI_FREE_PARAMETER_CONSTANT)
            status = o->by.column(which - FVI_FREE_PARAMETER_CONSTANT, 1, &X,
                                  system->potential.params, &o->dU[i * o->P + j]);
    }
    return status;
}

/* The history of x, H_k and its derivative by 2 alpha. */
static int update_history(fvi_tangent_run *o, double x, double dx, double *H,
                          double *rate)
{
    const fvi_run *r = o->run;
    const fvi_stepper *s = o->stepper;
    double z = r->past == FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE ? x : x - r->x0[0],
           dz = s->k > 0 ? dx : z;
    if (r->past == FVI_INITIAL_HISTORY_CAPUTO && r->alpha > 0.5 && s->k > 0) { /* (9.6) */
        z -= s->t * velocity_at_start(o);
        dz -= r->h * velocity_at_start(o);
    }
    return o->history ? fvi_history_push_by_order(o->history, &z, &dz, H, rate)
                      : FVI_SUCCESS;
}

//> tangent
/* (24.6): the derived equation of a step is linear, and a step of the linearised run. What
 * the parameters change besides is force: in the equation for x_{k+1} before the step, in
 * p_{k+1} behind it. dx = x_{k+1} - x_k. */
static int tangent_step(fvi_tangent_run *o, double dx)
{
    const double h = o->run->h, kappa = o->run->kappa;
    double H = 0, rate = 0, *p = o->tangent->p;
    for (size_t j = 0; j < o->P; j++)
        p[j] -= kappa * h * o->dU[j]
                + (o->which[j] == FVI_FREE_PARAMETER_MASS ? dx / h : 0);
    int status = fvi_stepper_step(o->tangent);
    if (!status)
        status = update_history(o, o->stepper->x[0], dx, &H, &rate);
    for (size_t j = 0; j < o->P; j++) {
        p[j] -= (1 - kappa) * h * o->dU[j];
        if (o->which[j] == FVI_FREE_PARAMETER_MASS)
            p[j] += dx / h;
        if (o->which[j] == FVI_FREE_PARAMETER_RHO)
            p[j] -= pow(h, 1 - 2 * o->run->alpha) * H;
        if (o->which[j] == FVI_FREE_PARAMETER_ALPHA)
            p[j] -= 2 * o->c * (rate - log(h) * H);
    }
    return status;
}
//< tangent

/* A step of Algorithm 3. */
static int step(fvi_tangent_run *o)
{
    fvi_stepper *s = o->stepper;
    const double before = s->x[0], kappa = o->run->kappa;
    int status = fvi_stepper_step(s);
    if (!status)
        status = fvi_tangent_evaluate_potential(
            o, 0, kappa * before + (1 - kappa) * s->x[0]);
    return status ? status : tangent_step(o, s->x[0] - before);
}

/* d x and d p of the linearised run, whose momentum is m dv in form D. */
static void read_tangent(fvi_tangent_run *o)
{
    const double v = o->stepper->p[0] / o->run->system->mass[0];
    memcpy(o->s, o->tangent->x, o->P * sizeof *o->s);
    memcpy(o->pi, o->tangent->p, o->P * sizeof *o->pi);
    for (size_t j = 0; j < o->P; j++)
        if (o->which[j] == FVI_FREE_PARAMETER_MASS && o->damped_inertia)
            o->pi[j] += v;
}

int fvi_tangent_step(fvi_tangent_run *o)
{
    const int status = o->stages ? fvi_tangent_stages_step(o) : step(o);
    if (!status)
        read_tangent(o);
    return status;
}

/* ---- the whole ---- */

static int check(const fvi_tangent_run *o)
{
    if (!o->run || !o->which || !o->run->x0 || !o->run->p0)
        FVI_FAIL("a pointer of the tangents is NULL", FVI_EFAULT);
    if (o->run->law)
        FVI_FAIL("the tangents are those of a power", FVI_EUNSUP);
    int status = fvi_system_require(o->run->system);
    if (!status && (o->run->system->d != 1 || o->P == 0))
        FVI_FAIL("tangents are of one mass, by a parameter or more",
                 FVI_EINVAL);
    for (size_t j = 0; j < o->P && !status; j++)
        if (o->which[j] >= FVI_FREE_PARAMETER_CONSTANT
            && o->which[j] - FVI_FREE_PARAMETER_CONSTANT
                   >= fvi_parameter_gradient_of(&o->run->system->potential).count)
            FVI_FAIL("the potential has no such constant", FVI_EINVAL);
    if (!status && o->stages && o->run->alpha == 1)
        FVI_FAIL("the tangents of stages are those of a damping below alpha = "
                 "1",
                 FVI_EUNSUP);
    return status;
}

static int make_room(fvi_tangent_run *o)
{
    const size_t stages = o->stages ? o->stages : 1;
    o->block = calloc((4 + 3 * stages) * o->P, sizeof *o->block);
    if (!o->block)
        FVI_FAIL("no memory for the tangents", FVI_ENOMEM);
    o->s = o->block;
    o->pi = o->s + o->P;
    o->mass = o->pi + o->P;
    o->damping = o->mass + o->P;
    o->G = o->damping + o->P;
    o->dU = o->G + stages * o->P;
    o->source = o->dU + stages * o->P;
    return FVI_SUCCESS;
}

/* The tolerance with which the memory of stages keeps ENOUGH, or as much as that of the run:
 * it keeps a part of run->tolerance, the same part of all (17.21). */
static double tolerance_of_slopes(const fvi_run *run)
{
    enum { PROBE = 100 };
    fvi_run probe = *run;
    probe.tolerance = 1. / PROBE;
    const double part = PROBE * fvi_lobatto_history_tolerance(&probe),
                 keep = fmax(fvi_lobatto_history_tolerance(run), ENOUGH);
    return fmin(keep / part, 1. / PROBE);
}

/* The linearised run at k = 0. Its past is that of the run: a line from d x0 with d v0. As a
 * momentum its start is m dv0, to which form M and Algorithm 3 add v0 dm. Where no motion
 * starts at another x0, (19.2), that slope is the slope of a run whose past does not act. */
static int start_linearised(fvi_tangent_run *o, const fvi_method *method)
{
    fvi_run tangent = *o->run;
    const int has = method->paper_convention
                    || fvi_initial_history_solvable(tangent.past, tangent.alpha, rho(o), 1);
    o->linearised = (fvi_linearised){ .G = o->G,
                                      .d = o->P,
                                      .diagonals = 1,
                                      .size = o->P,
                                      .is_one_body = 1,
                                      .stages = o->stages ? o->stages : 1 };
    for (size_t j = 0; j < o->P; j++) {
        o->mass[j] = o->run->system->mass[0];
        o->damping[j] = rho(o);
        o->s[j] = has && o->which[j] == FVI_FREE_PARAMETER_X0;
        o->pi[j] = o->which[j] == FVI_FREE_PARAMETER_P0     ? 1
                   : o->which[j] == FVI_FREE_PARAMETER_MASS ? -velocity_at_start(o)
                                                            : 0;
    }
    o->system = fvi_linearised_system(o->run->system, &o->linearised);
    o->system.mass = o->mass;
    o->system.damping = o->damping;
    if (o->stages) {
        o->linearised.source = o->source;
        tangent.tolerance = tolerance_of_slopes(o->run);
    }
    tangent.system = &o->system;
    tangent.x0 = o->s;
    tangent.p0 = o->pi;
    const int status = fvi_stepper_start(method, &tangent, &o->tangent, NULL);
    for (size_t j = 0; !status && j < o->P; j++) {
        if (o->which[j] == FVI_FREE_PARAMETER_MASS && !o->damped_inertia)
            o->tangent->p[j] += velocity_at_start(o);
        if (o->which[j] == FVI_FREE_PARAMETER_X0)
            o->tangent->x[j] = 1;
    }
    return status;
}

/* The history of x, where alpha or rho are asked for. */
static int start_history(fvi_tangent_run *o)
{
    const fvi_run *r = o->run;
    int wants_own = 0;
    double H, rate;
    o->c = rho(o) * pow(r->h, 1 - 2 * r->alpha);
    for (size_t j = 0; j < o->P; j++)
        wants_own |= o->which[j] == FVI_FREE_PARAMETER_RHO
                     || (o->which[j] == FVI_FREE_PARAMETER_ALPHA && rho(o) > 0);
    int status = wants_own ? fvi_history_alloc_by_order(2 * r->alpha, 1, r->steps,
                                                        r->memory, r->tolerance,
                                                        &o->history)
                           : FVI_SUCCESS;
    return status ? status : update_history(o, r->x0[0], r->x0[0], &H, &rate);
}

int fvi_tangent_start(const fvi_method *method, const fvi_run *run, size_t P,
                      const fvi_free_parameter *which, fvi_tangent_run *o)
{
    *o = (fvi_tangent_run){ .run = run,
                            .P = P,
                            .which = which,
                            .stages = (size_t)method->stages,
                            .damped_inertia = method->damped_inertia };
    int status = check(o);
    if (!status)
        status = fvi_stepper_start(method, run, &o->stepper, NULL);
    if (!status)
        status = make_room(o);
    if (status)
        return status;
    o->by = fvi_parameter_gradient_of(&run->system->potential);
    status = fvi_tangent_evaluate_potential(o, 0, run->x0[0]);
    if (!status)
        status = start_linearised(o, method);
    if (!status)
        status = o->stages ? fvi_tangent_stages_start(o) : start_history(o);
    if (!status)
        read_tangent(o);
    return status;
}

void fvi_tangent_stop(fvi_tangent_run *o)
{
    fvi_stepper_free(o->stepper);
    fvi_stepper_free(o->tangent);
    fvi_history_free(o->history);
    fvi_lobatto_history_free(o->of_stages);
    free(o->block);
}

int fvi_tangent(const fvi_run *run, size_t P, const fvi_free_parameter *which,
                 double *x, double *slope)
{
    fvi_tangent_run o;
    if (!x || !slope)
        FVI_FAIL("a pointer of the tangents is NULL", FVI_EFAULT);
    int status = fvi_tangent_start(&fvi_fractional, run, P, which, &o);
    for (size_t k = 0; !status; k++) {
        x[k] = o.stepper->x[0];
        memcpy(slope + k * P, o.s, P * sizeof *slope);
        if (k == run->steps)
            break;
        status = fvi_tangent_step(&o);
        if (!status && !fvi_all_finite(P, o.s))
            status = FVI_EOVRFLW;
    }
    fvi_tangent_stop(&o);
    return status;
}
