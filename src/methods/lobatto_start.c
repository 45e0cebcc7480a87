/* src/methods/lobatto_start.c -- Start the variational integrators on Lobatto nodes.    [H 17] */
#include <fvi/lobatto.h> /* which exports the methods */
#include <fvi/stability.h>

#include "mechanism/mechanism.h"
#include "stability_number.h"
#include "lobatto_matrices.h"
#include "lobatto_stages.h"
#include "system/arrays.h"
#include "system/fail.h"
#include "system/larger.h"
#include "newton/linearised.h"
#include "system/lu.h"

#include <gsl/gsl_linalg.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static void stop_lobatto(fvi_stepper *s)
{
    fvi_lobatto_stages *o = s->method_state;
    if (!o)
        return;
    fvi_lobatto_history_free(o->memory);
    free(o->share);
    free(o->M);
    fvi_initial_history_force_stop(&o->history_force);
    free(o->index);
    free(o);
}

//> linear
/* Compute M, the inverse of L = (m/h) K - rho b W D. L has the rows 1, ..., s-1 and the columns 2, ..., s, and it
 * multiplies X_2 - x_k, ..., X_s - x_k in (17.8). */
static int invert(const fvi_lobatto_stages *o, double m, double rho, double h,
                  double *M)
{
    const size_t s = o->s, n = s - 1;
    const fvi_lobatto_rule *r = o->rule;
    double L[FVI_STAGES * FVI_STAGES];
    for (size_t i = 0; i < n; i++)
        for (size_t j = 1; j < s; j++) {
            double K = 0, WD = 0; /* K = D^T B D */
            for (size_t l = 0; l < s; l++) {
                K += r->D[l][i] * r->b[l] * r->D[l][j];
                WD += o->W[i][l] * r->D[l][j];
            }
            L[i * n + j - 1] = m / h * K - rho * r->b[i] * WD;
        }
    size_t order[FVI_STAGES];
    gsl_permutation permutation = { n, order };
    gsl_matrix_view from = gsl_matrix_view_array(L, n, n),
                    to = gsl_matrix_view_array(M, n, n);
    fvi_lu_factorise(&from.matrix, &permutation);
    for (size_t i = 0; i < n; i++)
        if (L[i * n + i] == 0)
            return FVI_ESING;
    gsl_linalg_LU_invert(&from.matrix, &permutation, &to.matrix);
    return FVI_SUCCESS;
}
//< linear

/* Compute M for coordinate j. If its mass and damping are those of coordinate j - 1, copy M from there. */
static int invert_for(const fvi_stepper *s, fvi_lobatto_stages *o, size_t j)
{
    const double *m = s->run.system->mass, *rho = s->run.system->damping;
    const size_t size = o->unknowns * o->unknowns;
    double *M = o->M + j * size;
    if (j == 0 || m[j] != m[j - 1] || rho[j] != rho[j - 1])
        return invert(o, m[j], rho[j], s->run.h, M);
    memcpy(M, M - size, size * sizeof *M);
    return FVI_SUCCESS;
}

/* Allocate the stages; `unknowns` is the number of stages that a step solves for. */
static int allocate(fvi_stepper *s, size_t stages, size_t unknowns)
{
    const size_t d = s->run.system->d;
    fvi_lobatto_stages *o = s->method_state = calloc(1, sizeof *o);
    if (!o)
        FVI_FAIL("no memory for the stages", FVI_ENOMEM);
    o->rule = fvi_lobatto(stages);
    o->s = stages;
    o->d = d;
    o->unknowns = unknowns;
    o->M = calloc(d * unknowns * unknowns, sizeof *o->M);
    o->index = calloc(d, sizeof *o->index);
    const fvi_linearised *linearised = fvi_linearised_of(s->run.system);
    const size_t by_order = linearised && linearised->by_order;
    o->share = FVI_ARRAYS({ &o->share, d }, { &o->v0, d }, { &o->dX, stages * d }, { &o->S, stages * d },
                          { &o->grad, stages * d }, { &o->v, stages * d }, { &o->Y, stages * d },
                          { &o->r, stages * d }, { &o->Ydot, by_order * stages * d });
    if (!o->M || !o->index || !o->share)
        FVI_FAIL("no memory for the stages", FVI_ENOMEM);
    if (!by_order)
        o->Ydot = NULL;
    return FVI_SUCCESS;
}

//> finer
/* Return the tolerance of the history. It is chosen so that the impulse of the error over the whole time T is at most
 * the run's tolerance times m max|v|. (17.21) */
double fvi_lobatto_history_tolerance(const fvi_run *run)
{
    const fvi_system *system = run->system;
    const double beta = 2 * run->alpha - 1, T = run->h * (double)run->steps,
                 wish = run->tolerance > 0 ? run->tolerance : 1e-13;
    double Y = pow(beta > 0 ? run->h : T, -beta);
    double worst = 1;
    if (run->law) /* C(s)/s at s = 1/t, the response to a velocity of 1 */
        Y = fmax(run->h * fvi_kernel_symbol(run->law, 1 / run->h),
                 T * fvi_kernel_symbol(run->law, 1 / T));
    for (size_t j = 0; j < system->d; j++)
        worst = larger(worst, T * system->damping[j] * Y / system->mass[j]);
    return fmin(wish, fmax(wish / worst, 1e-14)); /* the smallest possible tolerance */
}
//< finer

int fvi_lobatto_history_of_damper(const fvi_run *run, const fvi_run_damper *of, size_t s,
                                  size_t d, int by_order, double keep, double *scale,
                                  fvi_lobatto_history **memory)
{
    const double beta = 2 * of->alpha - 1;
    *scale = of->law ? 1 : of->rho * pow(run->h, -beta);
    if (of->law)
        return fvi_lobatto_history_of_kernel(s, of->law, run->h, d, run->steps,
                                             run->memory, keep, memory);
    return fvi_lobatto_history_alloc(s, beta, d, run->steps, run->memory, by_order, keep, memory);
}

/* Compute W_0 and the history for the order beta = 2 alpha - 1. If no coordinate is damped, W = 0. */
static int prepare(fvi_stepper *s, fvi_lobatto_stages *o)
{
    const fvi_run *run = &s->run;
    const fvi_run_damper of = fvi_run_damper_of(run, 0);
    o->scale = 1;
    if (o->damped == 0 || (of.alpha == 0.5 && !o->Ydot)) {
        for (size_t i = 0; i < o->s; i++)
            o->W[i][i] = o->damped > 0;
        return FVI_SUCCESS;
    }
    const double keep = fvi_lobatto_history_tolerance(run);
    const int status = fvi_lobatto_history_of_damper(
        run, &of, o->s, o->damped, o->Ydot != NULL, keep, &o->scale, &o->memory);
    for (size_t i = 0; !status && i < o->s; i++)
        for (size_t j = 0; j < o->s; j++)
            o->W[i][j] =
                o->scale * fvi_lobatto_history_w0(o->memory)[i * o->s + j];
    return status;
}

/* Find the coordinates that have a history, and set their share of the inertia for alpha = 1 (17.17). There a damping
 * is a mass and needs no history, except in a run in dual variables, whose history is read. */
static void find_damped(const fvi_stepper *s, fvi_lobatto_stages *o)
{
    const fvi_system *system = s->run.system;
    const fvi_linearised *linearised = fvi_linearised_of(system);
    const int is_dual = linearised && linearised->is_dual,
              all = linearised && linearised->history_includes_undamped,
              is_mass = s->run.alpha == 1 && !is_dual;
    o->from_zero = linearised && linearised->from_zero;
    for (size_t j = 0; j < o->d; j++) {
        const double m = system->mass[j], rho = system->damping[j];
        o->share[j] = is_mass ? m / (m + rho) : 1;
        if ((rho == 0 && !all) || is_mass)
            continue;
        o->v0[o->damped] = s->run.alpha > 0.5 ? s->p[j] / m : 0;
        o->index[o->damped++] = j;
    }
}

static int start(fvi_stepper *s, size_t stages, int damped)
{
    if (s->run.system->matrices)
        return fvi_lobatto_matrices_start(s, stages);
    if (fvi_has_mechanism_steps(s->run.system))
        return fvi_mechanism_start(
            s, damped ? FVI_MECHANISM_FORM_D : FVI_MECHANISM_FORM_M, stages);
    int status = allocate(s, stages, damped ? stages : stages - 1);
    if (status)
        return status;
    fvi_lobatto_stages *o = s->method_state;
    find_damped(s, o);
    const fvi_run_damper damper = fvi_run_damper_of(&s->run, 0);
    if (!damper.law) /* a law acts on V itself */
        status = fvi_initial_history_force_start(s, &damper, stages, o->rule->c,
                                                 &o->history_force);
    if (!status)
        status = prepare(s, o);
    if (!status && damped)
        return fvi_lobatto_damped_prepare(s, o);
    for (size_t j = 0; !status && j < o->d; j++)
        status = invert_for(s, o, j);
    return status ? status : fvi_lobatto_prepare(s, o);
}

static int copy_lobatto(const fvi_stepper *from, fvi_stepper *to)
{
    const fvi_lobatto_stages *old = from->method_state;
    int status = allocate(to, old->s, old->unknowns);
    if (status)
        return status;
    fvi_lobatto_stages *o = to->method_state;
    const size_t d = o->d;
    o->damped = old->damped;
    o->scale = old->scale;
    memcpy(o->W, old->W, sizeof o->W);
    memcpy(o->A, old->A, sizeof o->A);
    memcpy(o->M, old->M, d * o->unknowns * o->unknowns * sizeof *o->M);
    memcpy(o->index, old->index, d * sizeof *o->index);
    memcpy(o->share, old->share, (2 + 6 * o->s) * d * sizeof *o->share);
    status = fvi_initial_history_force_copy(&old->history_force, d, &o->history_force);
    return status || !old->memory
               ? status
               : fvi_lobatto_history_copy(old->memory, &o->memory);
}

/* The stages of the last step are saved, because the next step begins by pushing them into the history. */
static int serialize_lobatto(fvi_stepper *s, fvi_archive *v)
{
    fvi_lobatto_stages *o = s->method_state;
    int status =
        v->serialize(v, o->share, (2 + 6 * o->s) * o->d * sizeof *o->share, 0);
    return status || !o->memory ? status
                                : fvi_lobatto_history_archive(
                                    o->memory, s->k > 0 ? s->k - 1 : 0, v);
}

/* ---- the methods ---- */

#define BOTH(s, orders, symbol, form, damped, is_implicit, its_load)                   \
    static int start_##form(fvi_stepper *stepper)                              \
    {                                                                          \
        return start(stepper, s, damped);                                      \
    }                                                                          \
    const fvi_method fvi_lobatto_##symbol = {                                     \
        .name = "fvi-lobatto" #form,                                           \
        .order = orders,                                                       \
        .memory = "full",                                                      \
        .lowest = s, /* near alpha = 1: (17.13); form D, held: (20.11) */      \
        .highest = 2 * s - 2,                                                  \
        .stages = s,                                                           \
        .damped_inertia = damped,                                              \
        .scheme = FVI_SCHEME_LOBATTO,                                           \
        .alpha_most = 1,                                                       \
        .takes_laws = 1,                                                       \
        .takes_mechanism = 1,                                                  \
        .takes_matrices = damped,                                              \
        .memories = FVI_ALL_MEMORIES,                                          \
        .implicit = is_implicit,                                               \
        .stability_number = its_load,                                                      \
        .stability_number_grows = s == 2 || damped,                                        \
        .start = start_##form,                                                 \
        .step = damped ? fvi_lobatto_damped_step : fvi_lobatto_step,           \
        .copy = copy_lobatto,                                                  \
        .serialize = serialize_lobatto,                                                \
        .stop = stop_lobatto                                                   \
    }

#define FORM_M(s, orders)                                                              \
    static int stability_number_##s(const fvi_run *run, double *load)                  \
    {                                                                                  \
        return fvi_stability_lobatto(s, run, load); /* (17.18) */                      \
    }                                                                                  \
    BOTH(s, orders, m##s, s, 0, s > 2, stability_number_##s)
#define FORM_D(s, orders) BOTH(s, orders, d##s, s##d, 1, 1, fvi_stability_number_none)

FORM_M(2, "2");
FORM_M(3, "3 to 4");
FORM_M(4, "4 to 6");
FORM_M(5, "5 to 8");
FORM_M(6, "6 to 10");
FORM_M(7, "7 to 12");
FORM_M(8, "8 to 14");
FORM_D(2, "2");
FORM_D(3, "3 to 4");
FORM_D(4, "4 to 6");
FORM_D(5, "5 to 8");
FORM_D(6, "6 to 10");
FORM_D(7, "7 to 12");
FORM_D(8, "8 to 14");
