/* src/methods/lobatto.c -- Variational integrators of order 2, 4, 6.    [Chapter 17] */
#include <fvi/lobatto.h>

#include <fvi/discrete_mechanics.h>
#include "loads.h"
#include "memory/lobatto_memory.h"
#include "system/fail.h"
#include "system/newton.h"

#include <gsl/gsl_linalg.h>
#include <gsl/gsl_machine.h>
#include <gsl/gsl_math.h>
#include <stdlib.h>
#include <string.h>

enum { INNER = FVI_STAGES - 1 };

/* Stage i of coordinate j stands at [i * d + j]; of the l-th damped coordinate,
 * in v, Y and v0, at [l * s + i]. Stages count from 0 here. */
typedef struct {
    const fvi_lobatto_rule *rule;
    size_t s, d;
    double *share;                /* of each coordinate, see (17.17) */
    double (*M)[INNER][INNER];    /* of each: the inverse of L in (17.8) */
    double *dX, *S, *grad;        /* X_i - x_k, S_i but for grad U, grad U */
    double *r;                    /* of the inner stages, see (17.8) */
    size_t damped, *index;        /* the coordinates that have a Y */
    double *v, *Y, *v0;
    double scale, W[FVI_STAGES][FVI_STAGES]; /* h^(-beta), times W_0 */
    fvi_lobatto_memory *memory;              /* NULL: there is no history */
    fvi_past_pull fading;
    double *pull; /* rho A h^(1 + e) of each coordinate, (19.3); NULL: none */
} lobatto;

static void stop_lobatto(fvi_stepper *s)
{
    lobatto *o = s->own;
    if (!o)
        return;
    fvi_lobatto_memory_free(o->memory);
    free(o->share);
    free(o->M);
    free(o->pull);
    free(o->index);
    free(o);
}

/* ---- the equation of a step ---- */

//> linear
/* L = (m/h) K - rho b W D, rows 1, ..., s-1, columns 2, ..., s: what multiplies
 * X_2 - x_k, ..., X_s - x_k in (17.8). M becomes its inverse. */
static int invert(const lobatto *o, double m, double rho, double h,
                  double M[INNER][INNER])
{
    const size_t s = o->s, n = s - 1;
    const fvi_lobatto_rule *r = o->rule;
    double L[INNER * INNER];
    for (size_t i = 0; i < n; i++)
        for (size_t j = 1; j < s; j++) {
            double K = 0, WD = 0; /* K = D^T B D */
            for (size_t l = 0; l < s; l++) {
                K += r->D[l][i] * r->b[l] * r->D[l][j];
                WD += o->W[i][l] * r->D[l][j];
            }
            L[i * n + j - 1] = m / h * K - rho * r->b[i] * WD;
        }
    size_t order[INNER];
    gsl_permutation permutation = { n, order };
    gsl_matrix_view from = gsl_matrix_view_array(L, n, n),
                    to = gsl_matrix_view_array_with_tda(M[0], n, n, INNER);
    int sign;
    gsl_linalg_LU_decomp(&from.matrix, &permutation, &sign);
    for (size_t i = 0; i < n; i++)
        if (L[i * n + i] == 0)
            return FVI_ESING;
    gsl_linalg_LU_invert(&from.matrix, &permutation, &to.matrix);
    return FVI_SUCCESS;
}
//< linear

/* What a force on coordinate j at stage i counts: h b_i, or a share of it. */
static double weight(const fvi_stepper *s, const lobatto *o, size_t i, size_t j)
{
    return s->run.h * o->rule->b[i] * o->share[j];
}

/* grad U at x_k + dX_i */
static int gradient(fvi_stepper *s, lobatto *o, size_t i)
{
    for (size_t j = 0; j < o->d; j++)
        s->dx[j] = s->x[j] + o->dX[i * o->d + j];
    return fvi_gradient(s->run.system, s->dx, o->grad + i * o->d);
}

/* X_i - x_k of (17.8), coordinate j, for the forces in S and grad. */
static double solved(const fvi_stepper *s, const lobatto *o, size_t i, size_t j)
{
    const double *M = o->M[j][i - 1];
    double sum = -M[0] * s->p[j];
    for (size_t l = 0; l < o->s - 1; l++)
        sum +=
            M[l]
            * (o->S[l * o->d + j] + weight(s, o, l, j) * o->grad[l * o->d + j]);
    return sum;
}

//> inner
/* The inner stages: dX - M h b grad U(x + dX) = M (S - p), the first stage's
 * gradient being known. */
static int solve_inner(fvi_stepper *s, lobatto *o)
{
    const size_t d = o->d, inner = o->s - 2;
    memset(o->grad + d, 0, inner * d * sizeof *o->grad);
    for (size_t i = 0; i < inner; i++)
        for (size_t j = 0; j < d; j++) {
            o->r[i * d + j] = solved(s, o, 1 + i, j);
            o->dX[(1 + i) * d + j] = o->rule->c[1 + i] * s->run.h * s->p[j]
                                     / s->run.system->mass[j]; /* a guess */
        }
    return fvi_newton_solve(s->newton, s->x, o->r, o->dX + d, o->grad + d);
}

/* What multiplies grad U there, for the solver. */
static int prepare_inner(fvi_stepper *s, lobatto *o)
{
    const size_t d = o->d, inner = o->s - 2;
    double *coupling = malloc(d * inner * inner * sizeof *coupling);
    if (!coupling)
        FVI_FAIL("no memory for the stages", FVI_ENOMEM);
    double *to = coupling;
    for (size_t j = 0; j < d; j++)
        for (size_t i = 0; i < inner; i++)
            for (size_t l = 1; l <= inner; l++)
                *to++ = -o->M[j][i][l] * weight(s, o, l, j);
    int status = fvi_newton_stages_alloc(s->run.system, inner, coupling,
                                         &s->newton);
    free(coupling);
    return status;
}
//< inner

/* ---- a step ---- */

/* The history of the damped coordinates, as forces: S += h b rho (Y - v0 part).
 * o->v holds the v of the step before. */
static int remember(fvi_stepper *s, lobatto *o)
{
    const size_t n = o->s;
    if (o->memory && s->k > 0) {
        int status = fvi_lobatto_memory_push(o->memory, o->v, o->Y);
        if (status)
            return status;
    }
    for (size_t l = 0; l < o->damped; l++)
        for (size_t i = 0, j = o->index[l]; i < n; i++) {
            double Y = o->memory && s->k > 0 ? o->scale * o->Y[l * n + i] : 0;
            for (size_t c = 0; c < n; c++)
                Y -= o->W[i][c] * o->v0[l];
            o->S[i * o->d + j] +=
                weight(s, o, i, j) * s->run.system->damping[j] * Y;
        }
    return FVI_SUCCESS;
}

/* v = D X / h - v0, and S += h b rho W v: the part of the present. */
static void damp(fvi_stepper *s, lobatto *o)
{
    const size_t n = o->s, d = o->d;
    for (size_t l = 0; l < o->damped; l++) {
        const size_t j = o->index[l];
        double *v = o->v + l * n;
        for (size_t i = 0; i < n; i++) {
            v[i] = 0;
            for (size_t c = 1; c < n; c++)
                v[i] += o->rule->D[i][c] * o->dX[c * d + j];
            v[i] /= s->run.h;
        }
        for (size_t i = 0; i < n; i++) {
            double Y = 0;
            for (size_t c = 0; c < n; c++)
                Y += o->W[i][c] * v[c];
            o->S[i * d + j] +=
                weight(s, o, i, j) * s->run.system->damping[j] * Y;
        }
        for (size_t i = 0; i < n; i++)
            v[i] -= o->v0[l];
    }
}

//> force
/* S = -h b F, from within the step at its ends: a jump at a node t_k belongs to
 * neither side; and the impulses of the past. */
static int drive(fvi_stepper *s, lobatto *o)
{
    const double h = s->run.h, left = (double)s->k * h,
                 right = (double)(s->k + 1) * h, in = 4 * GSL_DBL_EPSILON;
    for (size_t i = 0; i < o->s; i++) {
        double t = left + o->rule->c[i] * h;
        if (i == 0)
            t = left + in * fmax(left, h);
        else if (i + 1 == o->s)
            t = right - in * right;
        int status = fvi_force_at(s, t);
        if (status)
            return status;
        for (size_t j = 0; j < o->d; j++)
            o->S[i * o->d + j] = -weight(s, o, i, j) * s->F[j];
    }
    if (!o->pull)
        return FVI_SUCCESS;
    double impulse[FVI_STAGES];
    fvi_past_impulses(&o->fading, s->k, impulse);
    for (size_t i = 0; i < o->s; i++)
        for (size_t j = 0; j < o->d; j++)
            o->S[i * o->d + j] += o->share[j] * o->pull[j] * impulse[i];
    return FVI_SUCCESS;
}
//< force

//> step
static int step_lobatto(fvi_stepper *s)
{
    lobatto *o = s->own;
    const size_t d = o->d, end = o->s - 1;
    int status = drive(s, o);
    if (!status)
        status = remember(s, o);
    if (!status && end > 1 && s->run.system->potential.gradient)
        status = solve_inner(s, o);
    for (size_t i = 1; !status && i < end; i++)
        status = gradient(s, o, i);
    if (status)
        return status;
    for (size_t i = 1; i <= end; i++)
        for (size_t j = 0; j < d; j++)
            o->dX[i * d + j] = solved(s, o, i, j);
    status = gradient(s, o, end);
    if (status)
        return status;
    damp(s, o);
    for (size_t j = 0; j < d; j++) {
        for (size_t i = 0; i <= end; i++) /* (17.8) */
            s->p[j] -=
                o->S[i * d + j] + weight(s, o, i, j) * o->grad[i * d + j];
        s->x[j] += o->dX[end * d + j];
    }
    memcpy(o->grad, o->grad + end * d, d * sizeof *o->grad); /* at x_{k+1} */
    return FVI_SUCCESS;
}
//< step

/* ---- the start ---- */

static int allocate(fvi_stepper *s, size_t stages)
{
    const size_t d = s->run.system->d;
    lobatto *o = s->own = calloc(1, sizeof *o);
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
static int prepare(fvi_stepper *s, lobatto *o)
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

/* What a past that is not Caputo's adds, (19.3). */
static int start_pull(fvi_stepper *s, lobatto *o)
{
    const fvi_system *system = s->run.system;
    const double alpha = s->run.alpha;
    for (size_t j = 0; j < o->d; j++) {
        const double A = fvi_past_amplitude(s->run.past, alpha, s->x[j],
                                            s->p[j] / system->mass[j]);
        if (A == 0 || system->damping[j] == 0)
            continue;
        if (!o->pull) {
            o->pull = calloc(o->d, sizeof *o->pull);
            if (!o->pull)
                FVI_FAIL("no memory for the past", FVI_ENOMEM);
            fvi_past_prepare(alpha, o->s, o->rule->c, &o->fading);
        }
        o->pull[j] = system->damping[j] * A * pow(s->run.h, 1 + o->fading.e);
    }
    return FVI_SUCCESS;
}

static int start(fvi_stepper *s, size_t stages)
{
    const fvi_system *system = s->run.system;
    int status = allocate(s, stages);
    if (status)
        return status;
    lobatto *o = s->own;
    for (size_t j = 0; j < o->d; j++) {
        const double m = system->mass[j], rho = system->damping[j];
        o->share[j] = s->run.alpha == 1 ? m / (m + rho) : 1; /* (17.17) */
        if (rho == 0 || s->run.alpha == 1)
            continue;
        o->v0[o->damped] = s->run.alpha > 0.5 ? s->p[j] / m : 0;
        o->index[o->damped++] = j;
    }
    status = start_pull(s, o);
    if (!status)
        status = prepare(s, o);
    for (size_t j = 0; !status && j < o->d; j++)
        status =
            invert(o, system->mass[j], system->damping[j], s->run.h, o->M[j]);
    if (!status)
        status = gradient(s, o, 0); /* dX is zero */
    if (status)
        return status;
    return stages > 2 && system->potential.gradient ? prepare_inner(s, o)
                                                    : FVI_SUCCESS;
}

static int copy_lobatto(const fvi_stepper *from, fvi_stepper *to)
{
    const lobatto *old = from->own;
    int status = allocate(to, old->s);
    if (status)
        return status;
    lobatto *o = to->own;
    const size_t d = o->d;
    o->damped = old->damped;
    o->scale = old->scale;
    o->fading = old->fading;
    memcpy(o->W, old->W, sizeof o->W);
    memcpy(o->M, old->M, d * sizeof *o->M);
    memcpy(o->index, old->index, d * sizeof *o->index);
    memcpy(o->share, old->share, (2 + 6 * o->s) * d * sizeof *o->share);
    if (old->pull) {
        o->pull = malloc(d * sizeof *o->pull);
        if (!o->pull)
            FVI_FAIL("no memory for the past", FVI_ENOMEM);
        memcpy(o->pull, old->pull, d * sizeof *o->pull);
    }
    return old->memory ? fvi_lobatto_memory_copy(old->memory, &o->memory)
                       : FVI_SUCCESS;
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
        .start = start##s, .step = step_lobatto, .copy = copy_lobatto,         \
        .stop = stop_lobatto                                                   \
    }

const fvi_method fvi_lobatto2 = METHOD(2, "2", 2, 2),
                 fvi_lobatto3 = METHOD(3, "3 to 4", 3, 4),
                 fvi_lobatto4 = METHOD(4, "4 to 6", 4, 6);
