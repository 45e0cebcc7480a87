/* src/methods/lobatto_start.c -- Variational integrators of order 2, 4, 6: the start.
 *                                                                 [Chapter 17] */
#include <fvi/lobatto.h>

#include "loads.h"
#include "lobatto_stages.h"
#include "system/fail.h"

#include <gsl/gsl_linalg.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static void stop_lobatto(fvi_stepper *s)
{
    fvi_lobatto_stages *o = s->own;
    if (!o)
        return;
    fvi_lobatto_memory_free(o->memory);
    free(o->share);
    free(o->M);
    free(o->pull.size);
    free(o->index);
    free(o);
}

//> linear
/* L = (m/h) K - rho b W D, rows 1, ..., s-1, columns 2, ..., s: what multiplies
 * X_2 - x_k, ..., X_s - x_k in (17.8). M becomes its inverse. */
static int invert(const fvi_lobatto_stages *o, double m, double rho, double h,
                  double M[FVI_INNER][FVI_INNER])
{
    const size_t s = o->s, n = s - 1;
    const fvi_lobatto_rule *r = o->rule;
    double L[FVI_INNER * FVI_INNER];
    for (size_t i = 0; i < n; i++)
        for (size_t j = 1; j < s; j++) {
            double K = 0, WD = 0; /* K = D^T B D */
            for (size_t l = 0; l < s; l++) {
                K += r->D[l][i] * r->b[l] * r->D[l][j];
                WD += o->W[i][l] * r->D[l][j];
            }
            L[i * n + j - 1] = m / h * K - rho * r->b[i] * WD;
        }
    size_t order[FVI_INNER];
    gsl_permutation permutation = { n, order };
    gsl_matrix_view from = gsl_matrix_view_array(L, n, n),
                    to = gsl_matrix_view_array_with_tda(M[0], n, n, FVI_INNER);
    int sign;
    gsl_linalg_LU_decomp(&from.matrix, &permutation, &sign);
    for (size_t i = 0; i < n; i++)
        if (L[i * n + i] == 0)
            return FVI_ESING;
    gsl_linalg_LU_invert(&from.matrix, &permutation, &to.matrix);
    return FVI_SUCCESS;
}
//< linear

static int allocate(fvi_stepper *s, size_t stages)
{
    const size_t d = s->run.system->d;
    fvi_lobatto_stages *o = s->own = calloc(1, sizeof *o);
    if (!o)
        FVI_FAIL("no memory for the stages", FVI_ENOMEM);
    o->rule = fvi_lobatto(stages);
    o->s = stages;
    o->d = d;
    o->M = calloc(d, sizeof *o->M);
    o->index = calloc(d, sizeof *o->index);
    o->share = calloc(2 * d + 6 * stages * d, sizeof *o->share);
    if (!o->M || !o->index || !o->share)
        FVI_FAIL("no memory for the stages", FVI_ENOMEM);
    o->v0 = o->share + d;
    o->dX = o->v0 + d;
    o->S = o->dX + stages * d;
    o->grad = o->S + stages * d;
    o->v = o->grad + stages * d;
    o->Y = o->v + stages * d;
    o->r = o->Y + stages * d;
    return FVI_SUCCESS;
}

//> finer
/* What the memory has to keep, so that the impulse of its error, over the whole time
 * T, is no more than the tolerance of m max|v|. (17.21) */
static double finer(const fvi_stepper *s, double beta)
{
    const fvi_system *system = s->run.system;
    const double T = s->run.h * (double)s->run.steps,
                 Y = pow(beta > 0 ? s->run.h : T, -beta),
                 wish = s->run.tolerance > 0 ? s->run.tolerance : 1e-13;
    double worst = 1;
    for (size_t j = 0; j < system->d; j++)
        worst = fmax(worst, T * system->damping[j] * Y / system->mass[j]);
    return fmin(wish, fmax(wish / worst, 1e-14)); /* the finest there is */
}
//< finer

/* W_0 and the memory for the order beta = 2 alpha - 1; W = 0 if none is damped. */
static int prepare(fvi_stepper *s, fvi_lobatto_stages *o)
{
    const double beta = 2 * s->run.alpha - 1;
    o->scale = pow(s->run.h, -beta);
    if (o->damped == 0 || beta == 0) {
        for (size_t i = 0; i < o->s; i++)
            o->W[i][i] = o->damped > 0;
        return FVI_SUCCESS;
    }
    int status =
        fvi_lobatto_memory_alloc(o->s, beta, o->damped, s->run.steps,
                                 s->run.memory, finer(s, beta), &o->memory);
    for (size_t i = 0; !status && i < o->s; i++)
        for (size_t j = 0; j < o->s; j++)
            o->W[i][j] =
                o->scale * fvi_lobatto_memory_now(o->memory)[i * o->s + j];
    return status;
}

static int start(fvi_stepper *s, size_t stages)
{
    const fvi_system *system = s->run.system;
    int status = allocate(s, stages);
    if (status)
        return status;
    fvi_lobatto_stages *o = s->own;
    for (size_t j = 0; j < o->d; j++) {
        const double m = system->mass[j], rho = system->damping[j];
        o->share[j] = s->run.alpha == 1 ? m / (m + rho) : 1; /* (17.17) */
        if (rho == 0 || s->run.alpha == 1)
            continue;
        o->v0[o->damped] = s->run.alpha > 0.5 ? s->p[j] / m : 0;
        o->index[o->damped++] = j;
    }
    status = fvi_pull_start(s, stages, o->rule->c, &o->pull);
    if (!status)
        status = prepare(s, o);
    for (size_t j = 0; !status && j < o->d; j++)
        status =
            invert(o, system->mass[j], system->damping[j], s->run.h, o->M[j]);
    return status ? status : fvi_lobatto_prepare(s, o);
}

static int copy_lobatto(const fvi_stepper *from, fvi_stepper *to)
{
    const fvi_lobatto_stages *old = from->own;
    int status = allocate(to, old->s);
    if (status)
        return status;
    fvi_lobatto_stages *o = to->own;
    const size_t d = o->d;
    o->damped = old->damped;
    o->scale = old->scale;
    memcpy(o->W, old->W, sizeof o->W);
    memcpy(o->M, old->M, d * sizeof *o->M);
    memcpy(o->index, old->index, d * sizeof *o->index);
    memcpy(o->share, old->share, (2 + 6 * o->s) * d * sizeof *o->share);
    status = fvi_pull_copy(&old->pull, d, &o->pull);
    return status || !old->memory
               ? status
               : fvi_lobatto_memory_copy(old->memory, &o->memory);
}

static int start2(fvi_stepper *s)
{
    return start(s, 2);
}

static int start3(fvi_stepper *s)
{
    return start(s, 3);
}

static int start4(fvi_stepper *s)
{
    return start(s, 4);
}

#define METHOD(s, orders, from, to)                                            \
    {                                                                          \
        .name = "fvi-lobatto" #s, .order = orders, .memory = "full",           \
        .lowest = from, .highest = to, .stages = s, .alpha_most = 1,           \
        .memories = FVI_ALL_MEMORIES & ~(1u << FVI_MEMORY_FFT),                \
        .implicit = s > 2, .load = fvi_load_lobatto##s, .load_grows = s == 2,  \
        .start = start##s, .step = fvi_lobatto_step, .copy = copy_lobatto,     \
        .stop = stop_lobatto                                                   \
    }

const fvi_method fvi_lobatto2 = METHOD(2, "2", 2, 2),
                 fvi_lobatto3 = METHOD(3, "3 to 4", 3, 4),
                 fvi_lobatto4 = METHOD(4, "4 to 6", 4, 6);
