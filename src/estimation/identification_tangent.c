/* src/estimation/identification_tangent.c -- A run and its derivatives, side by side.
 *                                                                     [H 24] */
#include "identification_tangent.h"

#include <fvi/fvi.h>
#include "system/fail.h"

#include <stdlib.h>
#include <string.h>

static double rho(const fvi_tangent_run *o)
{
    return o->run->system->damping[0];
}

/* Does the memory know the line t p0/m? (9.6) */
static int knows_the_line(const fvi_tangent_run *o)
{
    return o->run->past == FVI_INITIAL_HISTORY_CAPUTO && o->run->alpha > 0.5;
}

/* ---- one step ---- */

/* d U'(S) by the parameters of U at fixed S, and U''(S). */
static int potential_at(fvi_tangent_run *o, double S, double *G)
{
    const fvi_system *system = o->run->system;
    double H[2] = { 0, 0 };
    int status = fvi_potential_hessian(system, &S, H);
    *G = H[0];
    for (size_t j = 0; j < o->P && !status; j++) {
        o->dU[j] = 0;
        if (o->which[j] >= FVI_FREE_PARAMETER_CONSTANT)
            status = o->by.column(o->which[j] - FVI_FREE_PARAMETER_CONSTANT, 1, &S,
                                  system->potential.params, &o->dU[j]);
    }
    return status;
}

//> tangent
/* (24.6): the derived equation of a step is linear, with one matrix for all slopes.
 * dx = x_{k+1} - x_k. */
static int tangent_step(fvi_tangent_run *o, double G, double dx)
{
    const double h = o->run->h, kappa = o->run->kappa,
                 m = o->run->system->mass[0],
                 J = m / h + kappa * (1 - kappa) * h * G;
    if (!(J != 0))
        return FVI_ESING;
    for (size_t j = 0; j < o->P; j++) {
        const double of_mass = o->which[j] == FVI_FREE_PARAMETER_MASS ? dx / h : 0;
        o->delta[j] =
            (o->pi[j] - kappa * h * (G * o->s[j] + o->dU[j]) - of_mass) / J;
        o->pi[j] -= h * (G * (o->s[j] + (1 - kappa) * o->delta[j]) + o->dU[j]);
        o->s[j] += o->delta[j];
    }
    return FVI_SUCCESS;
}
//< tangent

/* d z_k and its increment, of parameter j; k = 0 is the first, with delta = s. (24.7) */
static void take_in(fvi_tangent_run *o, size_t k)
{
    const double t = (double)k * o->run->h, m = o->run->system->mass[0],
                 p0 = o->run->p0[0];
    const int line = knows_the_line(o) && k > 0;
    for (size_t j = 0; j < o->P; j++) {
        const double origin = o->which[j] == FVI_FREE_PARAMETER_X0
                              && o->run->past != FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE,
                     speed = !line                               ? 0
                             : o->which[j] == FVI_FREE_PARAMETER_P0   ? 1 / m
                             : o->which[j] == FVI_FREE_PARAMETER_MASS ? -p0 / (m * m)
                                                                 : 0;
        o->z[j] = o->s[j] - origin - t * speed;
        o->dz[j] = k > 0 ? o->delta[j] - o->run->h * speed : o->z[j];
    }
}

/* The memory of the slopes, and what alpha and rho change in that of x. */
static int update_history(fvi_tangent_run *o, size_t k, double x, double dx)
{
    const fvi_run *r = o->run;
    const double t = (double)k * r->h, speed = r->p0[0] / r->system->mass[0];
    double H = 0, rate = 0;
    take_in(o, k);
    int status = o->memory ? fvi_history_push(o->memory, o->z, o->dz, o->z) : 0;
    if (!status && o->base_history) {
        double z = r->past == FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE ? x : x - r->x0[0],
               dz = k > 0 ? dx : z;
        if (knows_the_line(o)) {
            z -= t * speed;
            dz -= k > 0 ? r->h * speed : 0;
        }
        status = fvi_history_push_by_order(o->base_history, &z, &dz, &H, &rate);
    }
    for (size_t j = 0; j < o->P && k > 0 && !status; j++) {
        o->pi[j] -= o->memory ? o->c * o->z[j] : 0;
        if (o->which[j] == FVI_FREE_PARAMETER_RHO)
            o->pi[j] -= pow(r->h, 1 - 2 * r->alpha) * H;
        if (o->which[j] == FVI_FREE_PARAMETER_ALPHA)
            o->pi[j] -= 2 * o->c * (rate - log(r->h) * H);
    }
    return status;
}

int fvi_tangent_step(fvi_tangent_run *o)
{
    fvi_stepper *s = o->stepper;
    if (o->staged)
        return fvi_tangent_stages_step(o);
    const double before = s->x[0], kappa = o->run->kappa;
    double G;
    int status = fvi_stepper_step(s);
    if (!status)
        status = potential_at(o, kappa * before + (1 - kappa) * s->x[0], &G);
    if (!status)
        status = tangent_step(o, G, s->x[0] - before);
    return status ? status : update_history(o, s->k, s->x[0], s->x[0] - before);
}

/* ---- the whole ---- */

static int check(const fvi_tangent_run *o)
{
    if (!o->run || !o->which || !o->run->x0 || !o->run->p0)
        FVI_FAIL("a pointer of the tangents is NULL", FVI_EFAULT);
    if (o->run->law)
        FVI_FAIL("the tangents are those of a power", FVI_EUNSUP);
    int status = fvi_system_check(o->run->system);
    if (!status && (o->run->system->d != 1 || o->P == 0))
        FVI_FAIL("tangents are of one mass, by a parameter or more",
                 FVI_EINVAL);
    for (size_t j = 0; j < o->P && !status; j++)
        if (o->which[j] >= FVI_FREE_PARAMETER_CONSTANT
            && o->which[j] - FVI_FREE_PARAMETER_CONSTANT
                   >= fvi_parameter_gradient_of(&o->run->system->potential).count)
            FVI_FAIL("the potential has no such constant", FVI_EINVAL);
    return status;
}

/* The slopes of the start. */
static int begin(fvi_tangent_run *o)
{
    o->by = fvi_parameter_gradient_of(&o->run->system->potential);
    o->s = calloc(6 * o->P, sizeof *o->s);
    if (!o->s)
        FVI_FAIL("no memory for the tangents", FVI_ENOMEM);
    o->pi = o->s + o->P;
    o->delta = o->pi + o->P;
    o->z = o->delta + o->P;
    o->dz = o->z + o->P;
    o->dU = o->dz + o->P;
    for (size_t j = 0; j < o->P; j++) {
        o->s[j] = o->which[j] == FVI_FREE_PARAMETER_X0;
        o->pi[j] = o->which[j] == FVI_FREE_PARAMETER_P0;
    }
    return FVI_SUCCESS;
}

static int prepare(fvi_tangent_run *o)
{
    const fvi_run *r = o->run;
    int wants_own = 0;
    o->c = rho(o) * pow(r->h, 1 - 2 * r->alpha);
    for (size_t j = 0; j < o->P; j++)
        wants_own |= o->which[j] == FVI_FREE_PARAMETER_RHO
                     || (o->which[j] == FVI_FREE_PARAMETER_ALPHA && rho(o) > 0);
    int status = rho(o) > 0
                     ? fvi_history_alloc(2 * r->alpha, o->P, r->steps, r->memory,
                                        r->tolerance, &o->memory)
                     : FVI_SUCCESS;
    if (!status && wants_own)
        status = fvi_history_alloc_by_order(2 * r->alpha, 1, r->steps, r->memory,
                                       r->tolerance, &o->base_history);
    return status ? status : update_history(o, 0, r->x0[0], r->x0[0]);
}

int fvi_tangent_start(const fvi_method *method, const fvi_run *run, size_t P,
                      const fvi_free_parameter *which, fvi_tangent_run *o)
{
    *o = (fvi_tangent_run){ .run = run, .P = P, .which = which };
    int status = check(o);
    if (!status)
        status = fvi_stepper_start(method, run, &o->stepper);
    if (!status)
        status = begin(o);
    if (status)
        return status;
    return method->stages ? fvi_tangent_stages_start(o, method) : prepare(o);
}

void fvi_tangent_stop(fvi_tangent_run *o)
{
    fvi_stepper_free(o->stepper);
    fvi_tangent_stages_stop(o->staged);
    fvi_history_free(o->memory);
    fvi_history_free(o->base_history);
    free(o->s);
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
