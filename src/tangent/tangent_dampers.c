/* src/tangent/tangent_dampers.c -- The changes that directions make in a damper. [H 24] */
#include "tangent.h"

#include "methods/damping.h"
#include "methods/lobatto_stages.h"
#include "system/all_zero.h"
#include "system/arrays.h"
#include "system/fail.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- what the directions change ---- */

static int is_nonzero(const double *along, size_t first, size_t count)
{
    return along && !fvi_all_zero(count, along + first);
}

/* Find what the directions change in a damper. Returns which numbers of its law they change, as fvi_sensitivities that
 * are not NULL. */
static fvi_sensitivities find_wanted_derivatives(const fvi_tangent_run *o, fvi_tangent_damper *a)
{
    const fvi_kernel *law = a->of.law;
    fvi_sensitivities want = { 0 };
    for (size_t j = 0; j < o->P; j++) {
        const fvi_sensitivities *along = o->along + j;
        for (size_t i = 0; i < o->d; i++)
            a->is_asked |= fvi_tangent_factor(o, a, j, i) != 0;
        a->by_order |= fvi_tangent_order(o, a, j) != 0;
        if (!law)
            continue;
        want.terms = is_nonzero(along->terms, a->first, law->count) ? along->terms : want.terms;
        want.orders = is_nonzero(along->orders, a->first, law->count) ? along->orders : want.orders;
        want.times = is_nonzero(along->times, a->first, law->count) ? along->times : want.times;
        want.ends = is_nonzero(along->ends, a->first, law->count) ? along->ends : want.ends;
    }
    a->is_asked |= a->by_order;
    a->by_terms = fvi_wanted_kernel_numbers(&want);
    return want;
}

/* ---- the start ---- */

static int make_room(const fvi_tangent_run *o, fvi_tangent_damper *a)
{
    const size_t r = a->r, stages = o->s * r;
    a->block = FVI_ARRAYS({ &a->zeros, r }, { &a->z, r }, { &a->mean, r }, { &a->dz, r }, { &a->change, r },
                          { &a->by_theta, r }, { &a->now, o->P * r }, { &a->before, o->P * r }, { &a->v, stages },
                          { &a->Y, stages }, { &a->Ydot, stages }, { &a->sum, stages }, { &a->sumdot, stages },
                          { &a->CA, o->d });
    if (!a->block)
        FVI_FAIL("no memory for the tangents", FVI_ENOMEM);
    return FVI_SUCCESS;
}

/* Prepare the impulses of the past, and write A to a->CA, or C A with a matrix. */
static int start_past(fvi_tangent_run *o, fvi_tangent_damper *a)
{
    static const double ends[] = { 0, 1 };
    const fvi_run *run = o->run;
    const double *c = o->rule ? o->rule->c : ends;
    const int is_mass = o->rule && a->of.law && a->of.growth == 2;
    memset(o->room, 0, o->d * sizeof *o->room);
    if (o->method->paper_convention || is_mass
        || !fvi_initial_history_acts(a->of.law ? FVI_INITIAL_HISTORY_HELD : a->of.past, a->of.growth / 2))
        return FVI_SUCCESS;
    int status = fvi_initial_history_amplitudes(run->system, &a->of, run->x0, run->p0, o->room);
    if (!status)
        status = fvi_initial_history_force_prepare(&a->of, run->h, o->rule ? o->s : 2, c, &a->past,
                                                   &a->impulse_unit);
    if (!a->of.matrix.select_history)
        memcpy(a->CA, o->room, o->d * sizeof *a->CA);
    return status || !a->of.matrix.select_history
               ? status
               : fvi_damping_multiply(&a->of.matrix, o->d, 1, o->room, a->CA);
}

static int start_nodes(fvi_tangent_run *o, const fvi_sensitivities *want, fvi_tangent_damper *a)
{
    const fvi_run *run = o->run;
    int status = FVI_SUCCESS;
    if (a->is_asked)
        status = fvi_constant_history_start(o->method, run, &a->of, a->r, !a->of.law, &a->memory);
    a->unit = a->of.law ? run->h * a->memory.first : pow(run->h, 1 - 2 * a->of.alpha);
    if (status || !a->by_terms)
        return status;
    a->term = calloc(a->of.law->count, sizeof *a->term);
    if (!a->term)
        FVI_FAIL("no memory for the tangents", FVI_ENOMEM);
    for (; !status && a->terms < a->of.law->count; a->terms++) {
        fvi_node_term *t = a->term + a->terms;
        status = fvi_node_term_start(run, want, fvi_damping_quadrature(o->method),
                                     a->of.law->term + a->terms, a->r, NULL, t);
        if (!status && a->impulse_unit != 0)
            status = fvi_node_term_start_impulses(t, run->h, want);
    }
    return status;
}

static int start_stages(fvi_tangent_run *o, const fvi_sensitivities *want, double keep,
                        fvi_tangent_damper *a)
{
    const fvi_run *run = o->run;
    fvi_run_damper one = a->of;
    int status = FVI_SUCCESS;
    one.rho = 1;
    if (a->is_asked)
        status = fvi_lobatto_history_of_damper(run, &one, o->s, a->r, !one.law, keep, &a->unit, &a->of_stages);
    return status || !a->by_terms
               ? status
               : fvi_stage_terms_start(run, want, o->s, a->r, keep, a->of.law, &a->terms_of_stages);
}

int fvi_tangent_damper_start(fvi_tangent_run *o, double keep, fvi_tangent_damper *a)
{
    const int is_paper = o->method->paper_convention;
    const fvi_sensitivities want = find_wanted_derivatives(o, a);
    a->r = a->of.matrix.select_history ? a->of.matrix.history_size : o->d;
    if (!a->is_asked && !a->by_terms)
        return FVI_SUCCESS;
    a->is_liouville = is_paper && a->of.past == FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE;
    a->has_line = a->of.growth > 1
                  && (o->rule ? (o->run->system->matrices ? !a->of.law || a->of.growth != 2 : !a->of.law)
                              : a->of.past == FVI_INITIAL_HISTORY_CAPUTO || !is_paper);
    a->theta = o->method->scheme == FVI_SCHEME_CQ2_SHIFTED    ? a->of.alpha
               : o->method->scheme == FVI_SCHEME_CQ2_MIDPOINT ? 0.5
                                                              : 0;
    int status = make_room(o, a);
    if (!status)
        status = start_past(o, a);
    if (!status)
        status = o->rule ? start_stages(o, &want, keep, a) : start_nodes(o, &want, a);
    return status || o->rule ? status : fvi_tangent_damper_next(o, 0, a);
}

void fvi_tangent_damper_stop(fvi_tangent_damper *a)
{
    for (size_t l = 0; l < a->terms; l++)
        fvi_node_term_stop(a->term + l);
    fvi_constant_history_stop(&a->memory);
    fvi_lobatto_history_free(a->of_stages);
    if (a->terms_of_stages.each)
        fvi_stage_terms_stop(&a->terms_of_stages);
    fvi_initial_history_force_stop(&a->past);
    free(a->term);
    free(a->block);
}

/* ---- a node ---- */

/* Write z, the numbers that the history of a damper gets of x, and their increments dz. */
static int find_elongation(fvi_tangent_run *o, size_t k, fvi_tangent_damper *a)
{
    const fvi_run *run = o->run;
    const fvi_stepper *s = o->stepper;
    const fvi_damping_matrix *C = &a->of.matrix;
    double *z = C->select_history ? o->room : a->z, *dz = C->select_history ? o->V : a->dz;
    for (size_t i = 0; i < o->d; i++) {
        const double line = a->has_line && k > 0 ? o->v0[i] : 0;
        z[i] = s->x[i] - (a->is_liouville ? 0 : run->x0[i]);
        dz[i] = k > 0 ? s->x[i] - o->x_k[i] : z[i];
        z[i] -= s->t * line;
        dz[i] -= run->h * line;
    }
    int status = C->select_history ? C->select_history(o->d, z, a->zeros, C->params, a->z) : FVI_SUCCESS;
    if (!status && C->select_history)
        status = C->select_history(o->d, dz, a->zeros, C->params, a->dz);
    return status;
}

/* Write the input of the histories of the terms: z, or for fvi-stable the mean of z at two nodes; and its increment. */
static void find_mean(const fvi_tangent_run *o, fvi_tangent_damper *a)
{
    const int is_mean = o->method->scheme == FVI_SCHEME_CQ2_MIDPOINT;
    for (size_t n = 0; n < a->r; n++) {
        const double mean = is_mean ? a->z[n] - a->dz[n] / 2 : a->z[n];
        a->change[n] = mean - a->mean[n];
        a->mean[n] = mean;
    }
}

void fvi_tangent_numbers(const fvi_tangent_run *o, const fvi_tangent_damper *a, size_t j, size_t l,
                          double number[4])
{
    const fvi_sensitivities *along = o->along + j;
    const double *const of[] = { along->terms, along->orders, along->times, along->ends };
    for (size_t i = 0; i < 4; i++)
        number[i] = of[i] ? of[i][a->first + l] : 0;
}

double fvi_tangent_rho(const fvi_tangent_run *o, const fvi_tangent_damper *a, size_t i)
{
    return a->of.matrix.select_history ? a->of.rho : o->run->system->damping[i];
}

static void fill_impulses(const fvi_tangent_run *o, fvi_tangent_damper *a)
{
    const double log_h = log(o->run->h), *H = a->memory.sum, *rate = a->memory.sum_by_order;
    memcpy(a->before, a->now, o->P * a->r * sizeof *a->now);
    for (size_t j = 0; j < o->P; j++) {
        double *y = a->now + j * a->r;
        const double order = fvi_tangent_order(o, a, j);
        for (size_t n = 0; n < a->r; n++) {
            y[n] = a->memory.memory ? a->unit * H[n] * fvi_tangent_factor(o, a, j, n) : 0;
            if (order != 0)
                y[n] += 2 * (fvi_tangent_rho(o, a, n) * a->unit) * (rate[n] - log_h * H[n]) * order;
        }
        for (size_t l = 0; l < a->terms; l++) {
            const fvi_node_term *t = a->term + l;
            double number[4];
            fvi_tangent_numbers(o, a, j, l, number);
            for (size_t by = 0; by < 4; by++)
                for (size_t n = 0; t->by[by] && number[by] != 0 && n < a->r; n++)
                    y[n] += o->run->h * fvi_tangent_rho(o, a, n) * number[by] * t->factor[by] * t->by[by][n];
        }
    }
}

int fvi_tangent_damper_next(fvi_tangent_run *o, size_t k, fvi_tangent_damper *a)
{
    if (!a->block)
        return FVI_SUCCESS;
    int status = find_elongation(o, k, a);
    if (!status && a->memory.memory)
        status = fvi_constant_history_next(&a->memory, a->z, a->dz);
    find_mean(o, a);
    for (size_t l = 0; !status && l < a->terms; l++)
        status = fvi_node_term_next(a->term + l, a->mean, a->change);
    fill_impulses(o, a);
    return status;
}

/* ---- a step ---- */

int fvi_tangent_multiply(const fvi_tangent_run *o, const fvi_tangent_damper *a, double share, const double *y,
                         double *to)
{
    const fvi_damping_matrix *C = &a->of.matrix;
    if (C->select_history)
        return C->apply_damping(o->d, -share, y, C->params, to);
    for (size_t i = 0; i < o->d; i++)
        to[i] += share * y[i];
    return FVI_SUCCESS;
}

void fvi_tangent_past_along(const fvi_tangent_run *o, const fvi_tangent_damper *a, size_t k, size_t j, size_t i,
                       const double *at, const double *slope, size_t n, double *change)
{
    const double factor = fvi_tangent_factor(o, a, j, i), order = fvi_tangent_order(o, a, j),
                 log_h = log(o->run->h);
    for (size_t e = 0; e < n; e++)
        change[e] = a->impulse_unit
                    * (factor * at[e] - 2 * fvi_tangent_rho(o, a, i) * order * (log_h * at[e] + slope[e]));
    for (size_t l = 0; l < a->terms; l++) {
        const fvi_node_term *t = a->term + l;
        double number[4];
        fvi_tangent_numbers(o, a, j, l, number);
        for (size_t by = 0; by < 4; by++) {
            double ends[2];
            if (!t->impulses[by] || number[by] == 0)
                continue;
            fvi_impulses_of_kernel_at(t->impulses[by], k, ends);
            for (size_t e = 0; e < 2; e++)
                change[e] += fvi_tangent_rho(o, a, i) * number[by] * (by == 0 ? 1 : t->rho) * ends[e];
        }
    }
}

void fvi_tangent_past(const fvi_tangent_damper *a, size_t k, double *at, double *slope)
{
    fvi_initial_history_force_impulses(&a->past, k, at);
    if (!a->of.law && a->by_order)
        fvi_kernel_impulses_by_order(&a->past.initial_impulse, k, slope);
}

static void add_past(fvi_tangent_run *o, size_t k, const fvi_tangent_damper *a)
{
    double at[2], slope[2] = { 0 }, change[2];
    if (a->impulse_unit == 0)
        return;
    fvi_tangent_past(a, k, at, slope);
    for (size_t j = 0, n = 0; j < o->P; j++)
        for (size_t i = 0; i < o->d; i++, n++) {
            fvi_tangent_past_along(o, a, k, j, i, at, slope, 2, change);
            o->left[n] += a->CA[i] * change[0];
            o->right[n] += a->CA[i] * change[1];
        }
}

int fvi_tangent_damper_impulses(fvi_tangent_run *o, size_t k, fvi_tangent_damper *a)
{
    const int is_first_order = o->method->paper_convention,
              is_shifted = o->method->scheme == FVI_SCHEME_CQ2_SHIFTED;
    int status = FVI_SUCCESS;
    if (!a->block)
        return status;
    for (size_t j = 0; !status && j < o->P; j++) {
        const double *now = a->now + j * a->r, *before = a->before + j * a->r,
                     order = fvi_tangent_order(o, a, j);
        double *left = o->left + j * o->d, *right = o->right + j * o->d;
        status = fvi_tangent_multiply(o, a, is_first_order ? 1 : 0.5, now, right);
        if (!status && !is_first_order)
            status = fvi_tangent_multiply(o, a, 0.5 - a->theta, before, left);
        if (!status && a->theta != 0)
            status = fvi_tangent_multiply(o, a, a->theta, now, left);
        if (status || !is_shifted || order == 0)
            continue;
        for (size_t n = 0; n < a->r; n++)
            a->by_theta[n] = order * a->unit * fvi_tangent_rho(o, a, n) * a->memory.by_theta[n];
        status = fvi_tangent_multiply(o, a, 1, a->by_theta, left);
    }
    add_past(o, k, a);
    return status;
}
