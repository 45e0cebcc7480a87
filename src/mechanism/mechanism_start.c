/* src/mechanism/mechanism_start.c -- Start, copy and free a run with a mechanism. [H 29] */
#include "mechanism_state.h"
#include "system/arrays.h"
#include "system/fail.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void fvi_mechanism_free(fvi_mechanism_state *o)
{
    if (!o)
        return;
    fvi_mechanism_free_parts(o);
    free(o->numbers);
    free(o->order);
    free(o->contact);
    free(o->is_massless);
    free(o);
}

static void stop(fvi_stepper *s)
{
    fvi_mechanism_free(s->mechanism);
}

/* Allocate the arrays of doubles in one block. The arrays that one step passes to the next stand before W. There is
 * room for all contacts at the same time. */
static int allocate(fvi_mechanism_state *o)
{
    const size_t d = o->d, r = o->r, m = o->most, s = o->s, q = o->q,
                 n = o->n + (m - o->m) * (o->rule ? s - o->begin : 1);
    o->numbers = FVI_ARRAYS({ &o->impulse, r }, { &o->work, r }, { &o->begun, m }, { &o->ended, m }, { &o->tie, m },
                            { &o->level, m }, { &o->v, d }, { &o->u, n }, { &o->z, r }, { &o->G, r * d },
                            { &o->C, m * d }, { &o->z0, r }, { &o->raw, 4 * d }, { &o->W, r * s * s },
                            { &o->known, r * s }, { &o->lambda, r * s }, { &o->zdot, r * s },
                            { &o->start_impulse, 2 * r }, { &o->X, (q + 1) * d }, { &o->V, q * d }, { &o->f, q * d },
                            { &o->Lv, q * d }, { &o->fx, q * d * d }, { &o->fv, q * d * d }, { &o->Lxv, q * d * d },
                            { &o->Lvv, q * d * d }, { &o->load, (q + 1) * d }, { &o->elongation, q * r },
                            { &o->gradient, q * r * d }, { &o->residual, n }, { &o->matrix, n * n },
                            { &o->change, n }, { &o->trial, n }, { &o->room, 4 * (d + m + 1) * (d + m + 1) });
    o->order = calloc(n + d + m, sizeof *o->order);
    o->is_massless = calloc(d, 1);
    o->contact = calloc(2 * (m - o->permanent) + 1, sizeof *o->contact);
    if (!o->numbers || !o->order || !o->is_massless || !o->contact)
        return FVI_ENOMEM;
    o->last_contact = o->contact + (m - o->permanent);
    o->saved = (size_t)(o->W - o->numbers);
    return FVI_SUCCESS;
}

static int step_stages(fvi_stepper *s)
{
    const int status = fvi_mechanism_step_stages(s);
    return status ? fvi_mechanism_explain(s, status) : status;
}

static int step_nodes(fvi_stepper *s)
{
    const int status = fvi_mechanism_step_nodes(s);
    return status ? fvi_mechanism_explain(s, status) : status;
}

/* Give the stepper a copy of its method with these steps. A mesh has its own steps. */
static void switch_method(fvi_stepper *s, fvi_mechanism_form form)
{
    fvi_mechanism_state *o = s->mechanism;
    if (o->is_on_mesh)
        return;
    o->method = *s->method;
    o->method.step = form == FVI_MECHANISM_FORM_M || form == FVI_MECHANISM_FORM_D ? step_stages : step_nodes;
    o->method.copy = fvi_mechanism_copy;
    o->method.serialize = fvi_mechanism_serialize;
    o->method.stop = stop;
    s->method_state = o;
    s->method = &o->method;
}

static int make_state(fvi_stepper *s, fvi_mechanism_form form, size_t stages)
{
    const fvi_mechanism *mechanism = s->run.system->mechanism;
    fvi_mechanism_state *o = s->mechanism = calloc(1, sizeof *o);
    if (!o)
        return FVI_ENOMEM;
    o->is_on_mesh = s->method->scheme == FVI_SCHEME_VARIABLE_STEP;
    o->form = form;
    o->h = s->run.h;
    switch_method(s, form);
    const int has_stages =
        form == FVI_MECHANISM_FORM_M || form == FVI_MECHANISM_FORM_D;
    o->d = s->run.system->d;
    o->r = mechanism->damper_count;
    o->m = o->permanent = o->last_m = mechanism->constraints ? mechanism->constraints->count : 0;
    o->most = o->permanent + fvi_mechanism_contact_count(&s->run);
    o->s = o->q = has_stages ? stages : 1;
    o->begin = form == FVI_MECHANISM_FORM_M;
    o->n = has_stages ? (o->s - o->begin) * (o->d + o->m) : o->d + o->m;
    if (has_stages) {
        o->rule = fvi_lobatto(stages);
        fvi_mechanism_tables(o);
    }
    return allocate(o);
}

/* Check that the elongations and their gradients are finite. For example, sqrt(x - 1) has no slope at x = 1, so the
 * force of its damper does not exist there. */
static int check_elongations(const fvi_stepper *s, fvi_error *error)
{
    const fvi_mechanism_state *o = s->mechanism;
    for (size_t j = 0; j < o->r; j++)
        if (!isfinite(o->z[j]) || !fvi_all_finite(o->d, o->G + j * o->d)) {
            const char *name = s->run.system->mechanism->damper[j].name;
            char place[24];
            snprintf(place, sizeof place, "d%zu", j + 1);
            return fvi_at_index(error, j,
                                fvi_fail(error, FVI_EDOM, "damper", o->z[j],
                                         "the elongation of %.40s, or its slope, is not finite at x0",
                                         name ? name : place));
        }
    return FVI_SUCCESS;
}

/* Check the coordinates without inertia. The scheme of order 1 cannot take one. Form M can if a damper of an order
 * above 1 acts on it; with orders of 1 and below the step has no solution (29.16). */
static int check_massless(const fvi_stepper *s, fvi_error *error)
{
    const fvi_mechanism_state *o = s->mechanism;
    const fvi_mechanism *mechanism = s->run.system->mechanism;
    for (size_t i = 0; i < o->d; i++) {
        if (!o->is_massless[i] || o->form == FVI_MECHANISM_NODES
            || o->form == FVI_MECHANISM_FORM_D)
            continue;
        int is_held = 0;
        for (size_t j = 0; j < o->r && o->form == FVI_MECHANISM_FORM_M; j++)
            is_held |= o->G[j * o->d + i] != 0
                       && fvi_kernel_growth(mechanism->damper[j].kernel) > 1;
        if (!is_held)
            return fvi_at_index(error, i,
                                fvi_fail(error, FVI_EUNSUP, "mass", 0, "coordinate %zu has no inertia, and no damper "
                                         "of an order above 1 that this method could take: fvi-stable and "
                                         "fvi-lobatto2d to 8d take it", i + 1));
    }
    return FVI_SUCCESS;
}

/* Check the impulses. An impulse on a coordinate without inertia makes its position infinite at once, unless a damper
 * of order 1 or above acts on it. Stages of a fixed length do not resolve this. Nodes evaluate the position at that
 * time, and a mesh would need ever shorter steps. */
static int check_impulses(const fvi_stepper *s, fvi_error *error)
{
    const fvi_mechanism_state *o = s->mechanism;
    const fvi_force *force = &s->run.system->force;
    if (o->form != FVI_MECHANISM_NODES && !o->is_on_mesh)
        return FVI_SUCCESS;
    for (size_t n = 0; n < force->impulse_count; n++)
        for (size_t i = 0; i < o->d; i++)
            if (o->is_massless[i] && force->impulses[n].J[i] != 0)
                return fvi_at_index(error, i,
                                    fvi_fail(error, FVI_EUNSUP, "force", force->impulses[n].J[i],
                                             "an impulse on coordinate %zu, which has no inertia, moves it at once: "
                                             "fvi-lobatto2d to 8d take it", i + 1));
    return FVI_SUCCESS;
}

/* Set the initial guess of the first step to a constant velocity. */
static void guess_first_increment(fvi_stepper *s)
{
    fvi_mechanism_state *o = s->mechanism;
    for (size_t i = o->begin; i < o->s; i++)
        for (size_t j = 0; j < o->d; j++)
            o->u[(i - o->begin) * o->d + j] =
                (o->rule ? o->rule->c[i] : 1) * s->run.h * o->v[j];
    if (!o->rule)
        memset(o->u + o->d, 0, o->m * sizeof *o->u);
}

int fvi_mechanism_start(fvi_stepper *s, fvi_mechanism_form form, size_t stages)
{
    fvi_error *error = s->error;
    int status = fvi_mechanism_check(s->method, &s->run, error);
    if (!status)
        status = make_state(s, form, stages);
    if (status)
        return status;
    fvi_mechanism_state *o = s->mechanism;
    status = fvi_mechanism_check_start(s, error);
    if (!status)
        status = fvi_mechanism_elongations(s, 0, s->x, o->z, o->G);
    if (!status)
        status = check_elongations(s, error);
    if (!status)
        status = check_massless(s, error);
    if (!status)
        status = check_impulses(s, error);
    if (status || o->is_on_mesh)
        return status;
    status = fvi_mechanism_begin_histories(s, o->v, error);
    if (status)
        return status;
    guess_first_increment(s);
    memcpy(o->raw, s->x, o->d * sizeof *s->x);
    for (size_t i = 0; i < o->d && form == FVI_MECHANISM_NODES; i++)
        o->any_massless |= o->is_massless[i];
    return status;
}

/* Return the memory of one damper. On a mesh it has at least 24 modes with six stages each, and two
 * matrices of the stages. */
static double bytes_of_damper(const fvi_method *method, const fvi_run *run)
{
    enum { MODES = 24, NUMBERS = 12, SQUARES = 2 * FVI_STAGES * FVI_STAGES };
    if (method->dense)
        return 8. * (MODES * NUMBERS + SQUARES);
    return method->stages ? fvi_lobatto_history_bytes((size_t)method->stages, -0.5, 1, run->steps,
                                                      run->memory, 0)
                          : (double)fvi_history_bytes(0.5, 1, run->steps, run->memory, 0);
}

/* q is the number of points of a step: its stages, on a mesh at least six. The matrix of Newton's method has q d rows,
 * in form M (q - 1) d. In addition, there are four matrices of d rows at each point. */
double fvi_mechanism_bytes(const fvi_method *method, const fvi_run *run)
{
    const double r = (double)run->system->mechanism->damper_count,
                 d = (double)run->system->d,
                 q = method->dense    ? FVI_MESH_STAGES
                     : method->stages ? (double)method->stages
                                      : 1,
                 n = method->stages && !method->damped_inertia ? (q - 1) * d : q * d;
    return 8 * (n * n + 4 * (q + 1) * d * d + (q + 1) * d * r) + r * bytes_of_damper(method, run);
}

/* ---- copies ---- */

int fvi_mechanism_copy(const fvi_stepper *from, fvi_stepper *to)
{
    const fvi_mechanism_state *old = from->mechanism;
    int status = make_state(to, old->form, old->s);
    if (status)
        return status;
    fvi_mechanism_state *o = to->mechanism;
    memcpy(o->numbers, old->numbers, o->saved * sizeof *o->numbers);
    memcpy(o->W, old->W, o->r * o->s * o->s * sizeof *o->W);
    memcpy(o->is_massless, old->is_massless, o->d);
    o->any_massless = old->any_massless;
    memcpy(o->contact, old->contact, 2 * (o->most - o->permanent) * sizeof *o->contact);
    o->m = old->m;
    o->n = old->n;
    o->last_m = old->last_m;
    return fvi_mechanism_copy_parts(old, o);
}

int fvi_mechanism_serialize(fvi_stepper *s, fvi_archive *v)
{
    fvi_mechanism_state *o = s->mechanism;
    int status = v->serialize(v, o->numbers, o->saved * sizeof *o->numbers, 0);
    if (!status && o->most > o->permanent)
        status = fvi_mechanism_serialize_contacts(s, v);
    return status ? status : fvi_mechanism_serialize_parts(s, v);
}
