/* src/estimation/identification_tangent_stages.c -- A run through stages and its derivatives,
 * side by side.                                                         [H 24] */
#include "identification_tangent.h"

#include "methods/lobatto_stages.h"
#include "system/band.h"
#include "system/fail.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define ENOUGH                                                                 \
    1e-10 /* for the memory: slopes lead to the least, and are not it */

typedef double matrix[FVI_STAGES][FVI_STAGES];

/* Stage i of parameter j stands at [j * s + i]. Stages count from 0 here. */
struct fvi_tangent_stages {
    const fvi_lobatto_rule *rule;
    size_t s;
    double unit;                      /* h^(-beta), beta = 2 alpha - 1 */
    double pull;                      /* rho h^(1 + e) */
    matrix W, rate, K, WD;            /* W_0 and by beta; D^T B D; W_0 D */
    fvi_lobatto_history *memory, *base_history; /* of the slopes; of x, with rates */
    double *v, *H;                    /* of the slopes: v, and its history */
    double *dX;                       /* the slopes of X_i - x_k */
    double base_v[FVI_STAGES], base_H[FVI_STAGES], own_rate[FVI_STAGES];
    double at[FVI_STAGES], slope[FVI_STAGES]; /* impulses of the past */
    double G[FVI_STAGES], dU[FVI_STAGES][FVI_ESTIMATION_MOST];
    fvi_kernel_impulse initial_impulse;
    fvi_band J;
};

static double rho(const fvi_tangent_run *o)
{
    return o->run->system->damping[0];
}

/* [which = one] */
static int is(const fvi_tangent_run *o, size_t j, fvi_free_parameter one)
{
    return o->which[j] == one;
}

/* ---- what a parameter changes at the start ---- */

/* The velocity at which the memory does not look, and its slope. */
static double line(const fvi_tangent_run *o)
{
    return o->run->alpha > 0.5 ? o->run->p0[0] / o->run->system->mass[0] : 0;
}

static double line_by(const fvi_tangent_run *o, size_t j)
{
    const double m = o->run->system->mass[0];
    return o->run->alpha <= 0.5           ? 0
           : is(o, j, FVI_FREE_PARAMETER_P0)   ? 1 / m
           : is(o, j, FVI_FREE_PARAMETER_MASS) ? -o->run->p0[0] / (m * m)
                                          : 0;
}

/* A of (19.3), which is linear in x0 and v0, and its slope. */
static double amplitude(const fvi_tangent_run *o)
{
    const fvi_run *r = o->run;
    return fvi_initial_history_amplitude(r->past, r->alpha, r->x0[0], line(o));
}

static double amplitude_by(const fvi_tangent_run *o, size_t j)
{
    return fvi_initial_history_amplitude(o->run->past, o->run->alpha,
                              is(o, j, FVI_FREE_PARAMETER_X0), line_by(o, j));
}

/* ---- a step ---- */

/* U'' and d U' at the stages, x being x_k. */
static int potential_at(fvi_tangent_run *o, double x)
{
    fvi_tangent_stages *g = o->staged;
    const fvi_lobatto_stages *stages = o->stepper->method_state;
    const fvi_system *system = o->run->system;
    int status = FVI_SUCCESS;
    for (size_t i = 0; i < g->s && !status; i++) {
        const double X = x + stages->dX[i];
        double H[2] = { 0, 0 };
        status = fvi_potential_hessian(system, &X, H);
        g->G[i] = H[0];
        for (size_t j = 0; j < o->P && !status; j++)
            if (o->which[j] >= FVI_FREE_PARAMETER_CONSTANT)
                status =
                    o->by.column(o->which[j] - FVI_FREE_PARAMETER_CONSTANT, 1, &X,
                                 system->potential.params, &g->dU[i][j]);
    }
    return status;
}

/* What multiplies the slope of X_l - x_k in row i of (24.12). */
static double entry(const fvi_tangent_run *o, size_t i, size_t l)
{
    const fvi_tangent_stages *g = o->staged;
    const double h = o->run->h, b = g->rule->b[i];
    return o->run->system->mass[0] / h * g->K[i][l]
           - b * rho(o) * g->unit * g->WD[i][l]
           - (i == l ? h * b * g->G[i] : 0);
}

/* The rest of row i, of parameter j: what is known before the stages are. v: those of x
 * less the line; Y and Ydot: W v with the history, and its rate. */
static double known(const fvi_tangent_run *o, size_t i, size_t j,
                    const double *dX, const double *Y, const double *Ydot)
{
    const fvi_tangent_stages *g = o->staged;
    const double h = o->run->h, weight = h * g->rule->b[i], log_h = log(h);
    const double A = amplitude(o), by = line_by(o, j);
    double H = g->H[j * g->s + i];
    for (size_t l = 0; l < g->s; l++)
        H -= g->W[i][l] * by;
    double sum = -weight * (g->G[i] * o->s[j] + rho(o) * g->unit * H)
                 - g->pull * g->at[i] * amplitude_by(o, j);
    if (is(o, j, FVI_FREE_PARAMETER_MASS))
        for (size_t l = 0; l < g->s; l++)
            sum += g->K[i][l] * dX[l] / h;
    if (is(o, j, FVI_FREE_PARAMETER_RHO))
        sum -= weight * g->unit * Y[i] + g->pull / rho(o) * A * g->at[i];
    if (is(o, j, FVI_FREE_PARAMETER_ALPHA)) /* beta grows by 2, e falls by it */
        sum += 2 * g->pull * A * (log_h * g->at[i] + g->slope[i])
               - 2 * weight * rho(o) * g->unit * (Ydot[i] - log_h * Y[i]);
    if (o->which[j] >= FVI_FREE_PARAMETER_CONSTANT)
        sum -= weight * g->dU[i][j];
    return sum;
}

static int factorise(fvi_tangent_run *o)
{
    fvi_tangent_stages *g = o->staged;
    fvi_band_clear(&g->J);
    for (size_t i = 0; i + 1 < g->s; i++)
        for (size_t l = 1; l < g->s; l++)
            fvi_band_row(&g->J, i)[l - 1] = entry(o, i, l);
    return fvi_band_factorise(&g->J);
}

//> stages
/* (24.12): the derived equations of the stages are linear, with one matrix for all slopes.
 * Row 1 has -d p_k on the right, the inner rows 0, and the last one d p_{k+1}. */
static void solve(fvi_tangent_run *o, size_t j, const double *dX,
                  const double *Y, const double *Ydot)
{
    fvi_tangent_stages *g = o->staged;
    const size_t end = g->s - 1;
    double *slope = g->dX + j * g->s; /* the first stays 0 */
    for (size_t i = 0; i < end; i++)
        slope[i + 1] = -known(o, i, j, dX, Y, Ydot) - (i == 0 ? o->pi[j] : 0);
    fvi_band_solve(&g->J, slope + 1);
    o->pi[j] = known(o, end, j, dX, Y, Ydot);
    for (size_t l = 1; l <= end; l++)
        o->pi[j] += entry(o, end, l) * slope[l];
    o->s[j] += slope[end];
}
//< stages

/* D dX / h less the line. */
static void velocities(const fvi_tangent_stages *g, double h, const double *dX,
                       double line, double *v)
{
    for (size_t i = 0; i < g->s; i++) {
        v[i] = -line;
        for (size_t l = 1; l < g->s; l++)
            v[i] += g->rule->D[i][l] * dX[l] / h;
    }
}

/* Y = W v + history of x, and Ydot, its derivative by beta. */
static void damping_of(fvi_tangent_stages *g, double *Y, double *Ydot)
{
    for (size_t i = 0; i < g->s; i++) {
        Y[i] = g->base_H[i];
        Ydot[i] = g->own_rate[i];
        for (size_t l = 0; l < g->s; l++) {
            Y[i] += g->W[i][l] * g->base_v[l];
            Ydot[i] += g->rate[i][l] * g->base_v[l];
        }
    }
}

static int update_history(fvi_tangent_run *o)
{
    fvi_tangent_stages *g = o->staged;
    for (size_t j = 0; j < o->P; j++)
        velocities(g, o->run->h, g->dX + j * g->s, line_by(o, j),
                   g->v + j * g->s);
    const int status = fvi_lobatto_history_push(g->memory, g->v, g->H);
    return status ? status
                  : fvi_lobatto_history_push_by_order(g->base_history, g->base_v, g->base_H,
                                                 g->own_rate);
}

int fvi_tangent_stages_step(fvi_tangent_run *o)
{
    fvi_tangent_stages *g = o->staged;
    fvi_stepper *s = o->stepper;
    const size_t k = s->k;
    const double before = s->x[0];
    double Y[FVI_STAGES], Ydot[FVI_STAGES];
    int status = fvi_stepper_step(s);
    if (!status)
        status = potential_at(o, before);
    if (!status)
        status = factorise(o);
    if (status)
        return status;
    const double *dX = ((const fvi_lobatto_stages *)s->method_state)->dX;
    if (g->pull != 0) {
        fvi_kernel_impulses(&g->initial_impulse, k, g->at);
        fvi_kernel_impulses_by_order(&g->initial_impulse, k, g->slope);
    }
    velocities(g, o->run->h, dX, line(o), g->base_v);
    damping_of(g, Y, Ydot);
    for (size_t j = 0; j < o->P; j++)
        solve(o, j, dX, Y, Ydot);
    return update_history(o);
}

/* ---- the whole ---- */

static void matrices(fvi_tangent_stages *g)
{
    const fvi_lobatto_rule *r = g->rule;
    for (size_t i = 0; i < g->s; i++)
        for (size_t j = 0; j < g->s; j++) {
            const size_t at = i * g->s + j;
            g->W[i][j] = fvi_lobatto_history_now(g->base_history)[at];
            g->rate[i][j] = fvi_lobatto_history_now_by_order(g->base_history)[at];
        }
    for (size_t i = 0; i < g->s; i++)
        for (size_t j = 0; j < g->s; j++)
            for (size_t l = 0; l < g->s; l++) {
                g->K[i][j] += r->D[l][i] * r->b[l] * r->D[l][j];
                g->WD[i][j] += g->W[i][l] * r->D[l][j];
            }
}

int fvi_tangent_stages_start(fvi_tangent_run *o, const fvi_method *method)
{
    const fvi_run *r = o->run;
    const double beta = 2 * r->alpha - 1;
    fvi_tangent_stages *g = o->staged = calloc(1, sizeof *g);
    if (r->alpha == 1 || !(rho(o) > 0))
        FVI_FAIL("the tangents of stages are those of a damping below alpha = "
                 "1",
                 FVI_EUNSUP);
    if (!g)
        FVI_FAIL("no memory for the tangents", FVI_ENOMEM);
    g->s = (size_t)method->stages;
    g->rule = fvi_lobatto(g->s);
    g->unit = pow(r->h, -beta);
    g->v = calloc(3 * g->s * o->P, sizeof *g->v);
    if (!g->v || fvi_band_alloc(g->s - 1, g->s - 1, &g->J))
        FVI_FAIL("no memory for the tangents", FVI_ENOMEM);
    g->H = g->v + g->s * o->P;
    g->dX = g->H + g->s * o->P;
    const double finer = fmax(fvi_lobatto_history_tolerance(r), ENOUGH);
    int status = fvi_lobatto_history_alloc(g->s, beta, o->P, r->steps, r->memory,
                                          finer, &g->memory);
    if (!status)
        status = fvi_lobatto_history_alloc_by_order(g->s, beta, 1, r->steps,
                                               r->memory, finer, &g->base_history);
    if (status)
        return status;
    matrices(g);
    if (!fvi_initial_history_acts(r->past, r->alpha))
        return FVI_SUCCESS;
    fvi_kernel_impulse_prepare(r->alpha, g->s, g->rule->c, &g->initial_impulse);
    g->pull = rho(o) * pow(r->h, 1 + g->initial_impulse.e);
    return FVI_SUCCESS;
}

void fvi_tangent_stages_stop(fvi_tangent_stages *g)
{
    if (!g)
        return;
    fvi_lobatto_history_free(g->memory);
    fvi_lobatto_history_free(g->base_history);
    fvi_band_free(&g->J);
    free(g->v);
    free(g);
}
