/* src/methods/convolution_quadrature_methods.c -- fvi-shifted, fvi-bdf2 and fvi-stable, of order 2.  [H 13] */
#include <fvi/convolution_quadrature_methods.h>
#include "convolution_quadrature_dampers.h"
#include "mechanism/mechanism.h"
#include "stability_number.h"
#include "newton/newton.h"
#include "run/step_times.h"
#include "system/vectors.h"

#include <math.h>
#include <string.h>

/* ---- parts of a step ---- */

//> force
/* Write the limit of F at t_k from below, or from above, to s->F. (13.12) */
static int force_before(fvi_stepper *s, size_t k)
{
    return fvi_force_value(s, fvi_just_before((double)k * s->run.h));
}

static int force_after(fvi_stepper *s, size_t k)
{
    return fvi_force_value(s, fvi_just_after((double)k * s->run.h));
}
//< force

/* Filter the coordinates in groups of eight. The sum of each coordinate keeps its order, and eight
 * sums run side by side. */
FVI_VECTORS static void apply_factor_by_eights(const fvi_cq_damper *o, size_t count, const double *past, double *term)
{
    enum { EIGHT = 8 };
    for (size_t j = 0; j + EIGHT <= count; j += EIGHT) {
        double sum[EIGHT] = { 0 };
        for (size_t n = 0; n < o->taps; n++)
            for (size_t l = 0; l < EIGHT; l++)
                sum[l] += o->g[n] * past[n * count + j + l];
        memcpy(term + j, sum, sizeof sum);
    }
}

//> filter
/* Apply the factor g to the newest term: ((3 - z)/2)^beta or g_0 + g_1 z. (13.11), (13.16) */
static void apply_factor(fvi_cq_damper *o, size_t count, double *term)
{
    if (o->taps == 0)
        return;
    o->place = (o->place + o->taps - 1) % o->taps;
    double *past = o->past + o->place * count;
#pragma omp simd
    for (size_t j = 0; j < count; j++)
        past[j] = past[o->taps * count + j] = term[j];
    if (count >= 8)
        apply_factor_by_eights(o, count, past, term);
    for (size_t j = count / 8 * 8; j < count; j++) {
        double sum = 0;
        for (size_t n = 0; n < o->taps; n++)
            sum += o->g[n] * past[n * count + j];
        term[j] = sum;
    }
}
//< filter

/* Push the term of x_{k+1} and compute H of step k + 1. */
static int update_history(fvi_stepper *s, fvi_cq_damper *o)
{
    fvi_damping *d = o->damping;
    int status = fvi_damping_set_terms(d, s);
    if (status)
        return status;
    apply_factor(o, d->count, d->sums_increments ? d->dz : d->z);
    return fvi_damping_update_history(d, o->H);
}

/* Apply the impulse of the initial history at the left (end = 0) or the right end of this step. */
static void apply_initial_history(fvi_stepper *s, fvi_cq_damper *o, size_t end)
{
    if (!o->history_force.size)
        return;
    if (end == 0)
        fvi_initial_history_force_impulses(&o->history_force, s->k, o->impulse);
    for (size_t i = 0; i < s->run.system->d; i++)
        s->p[i] -= o->history_force.size[i] * o->impulse[end];
}

/* Compute H of step k + 1 for the case x_{k+1} = x_k. */
static int predict_history(const fvi_stepper *s, const fvi_cq_damper *o)
{
    const fvi_damping *d = o->damping;
    int status = fvi_damping_gather(d, s->x, d->origin, d->z);
    if (!status)
        status = fvi_history_ahead(d->memory, d->z, o->ahead);
    const double first = fvi_cq_first_weight(o);
#pragma omp simd
    for (size_t j = 0; j < d->count; j++)
        o->ahead[j] -= first * d->drift[j];
    if (o->taps && d->sums_increments) { /* g_1 times the last increment */
        const double *last = o->past + o->place * d->count;
#pragma omp simd
        for (size_t j = 0; j < d->count; j++)
            o->ahead[j] += o->g[1] * last[j];
    }
    return status;
}

/* First line of (13.10). Add half of the force and of the damping to p = p_k. Write to r the rest of the right-hand
 * side: p minus the part of D_{k+1} that does not contain dx. */
//> right-hand-side
static int assemble_right_hand_side(fvi_stepper *s, fvi_cq_state *o)
{
    const size_t dim = s->run.system->d;
    const double half = s->run.h / 2;
    int status = force_after(s, s->k);
    if (status)
        return status;
#pragma omp simd
    for (size_t i = 0; i < dim; i++)
        s->p[i] += half * s->F[i];
    for (size_t j = 0; j < o->count && !status; j++) {
        fvi_cq_damper *a = o->each + j;
        fvi_damping_note_momentum(a->damping, s->p);
        if (a->theta != 0.5)
            status = fvi_damping_apply_force(a->damping, 0.5 - a->theta, a->H, s->p);
        apply_initial_history(s, a, 0);
        fvi_damping_add_impulse(a->damping, s->p);
    }
    memcpy(o->r, s->p, dim * sizeof *o->r);
    for (size_t j = 0; j < o->count && !status; j++) {
        const fvi_cq_damper *a = o->each + j;
        if (a->theta == 0)
            continue;
        status = predict_history(s, a);
        if (!status)
            status = fvi_damping_apply_force(a->damping, a->theta, a->ahead, o->r);
    }
    return status;
}
//< right-hand-side

//> step
/* Apply h (1/2 + theta) D_{k+1} of a damper at the end of the step. The rest of h D_{k+1} is applied at the beginning
 * of the next step. */
static int apply_damping(fvi_stepper *s, fvi_cq_damper *o)
{
    int status = update_history(s, o);
    fvi_damping_note_momentum(o->damping, s->p);
    if (!status)
        status = fvi_damping_apply_force(o->damping, 0.5 + o->theta, o->H, s->p);
    apply_initial_history(s, o, 1);
    fvi_damping_add_impulse(o->damping, s->p);
    fvi_damping_add_work(o->damping, s->run.h, s->dx);
    return status;
}

//> second-order
static int step_second_order(fvi_stepper *s)
{
    fvi_cq_state *o = s->method_state;
    const double h = s->run.h;
    int status = assemble_right_hand_side(s, o);
    if (!status)
        status = fvi_newton_solve(s->newton, s->x, o->r, s->dx, s->g);
    if (!status)
        status = force_before(s, s->k + 1);
    if (status)
        return status;
#pragma omp simd
    for (size_t i = 0; i < s->run.system->d; i++) {
        s->x[i] += s->dx[i];
        s->p[i] += h / 2 * s->F[i] - h * s->g[i];
    }
    for (size_t j = 0; j < o->count && !status; j++)
        status = apply_damping(s, o->each + j);
    return status;
}
//< second-order
//< step

static int start_stable(fvi_stepper *s)
{
    return fvi_has_mechanism_steps(s->run.system)
               ? fvi_mechanism_start(s, FVI_MECHANISM_NODES, 0)
               : fvi_cq_start(s);
}

/* the members that the three methods have in common */
#define OF_ORDER_2                                                                                              \
    .order = "2", .lowest = 2, .highest = 2, .memory = "full", .alpha_most = 1, .memories = FVI_ALL_MEMORIES,   \
    .takes_laws = 1, .takes_matrices = 1, .implicit = 1, .stability_number_grows = 1, .step = step_second_order, \
    .copy = fvi_cq_copy, .serialize = fvi_cq_serialize, .damper = fvi_damping_sums,                             \
    .keep_dampers = fvi_damping_keep_sums, .stop = fvi_cq_stop

const fvi_method fvi_cq2_shifted = { .name = "fvi-shifted",
                                     .scheme = FVI_SCHEME_CQ2_SHIFTED,
                                     .takes_kappa = 1,
                                     .stability_number = fvi_stability_number_shifted,
                                     .start = fvi_cq_start,
                                     OF_ORDER_2 };
const fvi_method fvi_cq_bdf2 = { .name = "fvi-bdf2",
                                 .quadrature = FVI_DELTA_BDF2,
                                 .scheme = FVI_SCHEME_CQ_BDF2,
                                 .takes_kappa = 1,
                                 .stability_number = fvi_stability_number_bdf2,
                                 .start = fvi_cq_start,
                                 OF_ORDER_2 };
const fvi_method fvi_cq2_midpoint = { .name = "fvi-stable",
                                      .scheme = FVI_SCHEME_CQ2_MIDPOINT,
                                      .takes_mechanism = 1,
                                      .stability_number = fvi_stability_number_none,
                                      .start = start_stable,
                                      OF_ORDER_2 };
