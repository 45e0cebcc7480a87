/* src/methods/lobatto_matrices_dampers.c -- The dampers of a structure on Lobatto nodes.  [H 27] */
#include "lobatto_matrices.h"

#include "lobatto_stages.h"
#include "newton/linearised.h"
#include "system/archive_pieces.h"
#include "system/arrays.h"
#include "system/fail.h"
#include "system/vectors.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- start ---- */

/* Allocate the arrays of a damper with zeros. */
static int make_numbers(fvi_stage_damper *a, size_t s, size_t by_order)
{
    const size_t stages = s * a->r;
    if (!FVI_ARRAYS({ &a->drift, a->r }, { &a->z, a->r }, { &a->zero, a->r }, { &a->slope, stages },
                    { &a->Y, stages }, { &a->force, stages }, { &a->Ydot, by_order * stages },
                    { &a->force_by_order, by_order * stages }))
        FVI_FAIL("no memory for a damper", FVI_ENOMEM);
    if (!by_order)
        a->Ydot = a->force_by_order = NULL;
    return FVI_SUCCESS;
}

double fvi_stage_dampers_tolerance(const fvi_run *run)
{
    const double finest = run->tolerance > 0 ? fmax(run->tolerance / 10, 1e-14) : 1e-14;
    return run->system->mechanism ? finest : fvi_lobatto_history_tolerance(run);
}

static int make_history(const fvi_run *run, size_t s, fvi_stage_damper *a)
{
    const int status = fvi_lobatto_history_of_damper(run, &a->of, s, a->r, a->Ydot != NULL,
                                                     fvi_stage_dampers_tolerance(run), &a->scale,
                                                     &a->memory);
    for (size_t i = 0; !status && i < s * s; i++) {
        a->W[i] = a->scale * fvi_lobatto_history_w0(a->memory)[i];
        a->constant[i / s] += a->W[i];
    }
    return status;
}

/* Start a damper. If its kernel grows faster than s, the history does not see the velocity of the start, and the
 * response of the past to this velocity is added exactly. The exception is a law of order 2, which is a mass. */
static int start_damper(fvi_stepper *s, const double *v, fvi_stage_damper *a)
{
    const fvi_lobatto_matrices *o = s->method_state;
    const fvi_damping_matrix *C = &a->of.matrix;
    const int is_mass = a->of.law && a->of.growth == 2;
    const fvi_linearised *linearised = fvi_linearised_of(s->run.system);
    int status = make_numbers(a, o->s, linearised && linearised->by_order && !a->of.law && a->of.rho > 0);
    if (!status && a->of.growth > 1 && !is_mass)
        status = C->select_history(o->d, v, a->zero, C->params, a->drift);
    if (!status && !is_mass)
        status = fvi_initial_history_force_start(s, &a->of, o->s, o->rule->c, &a->past);
    return status ? status : make_history(&s->run, o->s, a);
}

int fvi_stage_dampers_start(fvi_stepper *s, const double *v)
{
    fvi_lobatto_matrices *o = s->method_state;
    const size_t count = fvi_run_damper_count(&s->run);
    int status = FVI_SUCCESS;
    o->each = calloc(count + 1, sizeof *o->each);
    if (!o->each)
        FVI_FAIL("no memory for the dampers", FVI_ENOMEM);
    for (size_t j = 0; !status && j < count; j++) {
        const fvi_run_damper of = fvi_run_damper_of(&s->run, j);
        if (of.matrix.history_size == 0)
            continue;
        fvi_stage_damper *a = o->each + o->dampers++;
        *a = (fvi_stage_damper){ .of = of, .number = j, .r = of.matrix.history_size };
        status = start_damper(s, v, a);
        if (s->run.system->mechanism)
            status = fvi_run_damper_name_refused(&s->run, j, status, s->error);
    }
    return status;
}

/* ---- a step ---- */

/* Write the known force of a damper at stage i, before the factor S: the sums of the history and the effect of a
 * constant velocity. */
static void add_known(const fvi_stage_damper *a, size_t s, size_t i, const double *velocity)
{
    double *force = a->force + i * a->r;
    for (size_t n = 0; n < a->r; n++)
        force[n] = a->scale * a->Y[n * s + i] + a->constant[i] * velocity[n];
}

/* Write the derivative of the known force by 2 alpha for fixed h^(-beta). z holds B^T v_k. */
static void add_known_by_order(const fvi_stage_damper *a, size_t s)
{
    const double *rate = fvi_lobatto_history_w0_by_order(a->memory);
    for (size_t i = 0; i < s; i++) {
        double row = 0;
        for (size_t c = 0; c < s; c++)
            row += rate[i * s + c];
        for (size_t n = 0; n < a->r; n++)
            a->force_by_order[i * a->r + n] = a->scale * (a->Ydot[n * s + i] + row * a->z[n]);
    }
}

static int begin_damper(const fvi_stepper *s, const fvi_lobatto_matrices *o, fvi_stage_damper *a)
{
    const double h = s->run.h;
    for (size_t i = 0; i < o->s; i++)
        add_known(a, o->s, i, a->z);
    const int status = fvi_run_damper_stages(&a->of, o->d, o->s, a->force, o->load);
    if (!status && a->Ydot)
        add_known_by_order(a, o->s);
    if (status || !a->past.size)
        return status;
    for (size_t i = 0; i < o->s; i++)
        for (size_t j = 0; j < o->d; j++)
            o->load[i * o->d + j] -= a->past.size[j] * a->impulse[i] / (h * o->rule->b[i]);
    return FVI_SUCCESS;
}

int fvi_stage_dampers_read(const fvi_stepper *s, fvi_lobatto_matrices *o)
{
    int status = FVI_SUCCESS;
    for (size_t j = 0; !status && j < o->dampers; j++) {
        fvi_stage_damper *a = o->each + j;
        status = a->of.matrix.select_history(o->d, o->v, a->drift, a->of.matrix.params, a->z);
        if (a->past.size)
            fvi_initial_history_force_impulses(&a->past, s->k, a->impulse);
    }
    return status;
}

int fvi_stage_dampers_begin_step(const fvi_stepper *s, fvi_lobatto_matrices *o)
{
    int status = FVI_SUCCESS;
    for (size_t j = 0; !status && j < o->dampers; j++)
        status = begin_damper(s, o, o->each + j);
    return status;
}

/* Compute force_i += sum_c W_ic change_c. */
static void add_weights_to_one(size_t s, const double *W, const double *change, double *force)
{
    for (size_t i = 0; i < s; i++)
        for (size_t c = 0; c < s; c++)
            force[i] += W[i * s + c] * change[c];
}

/* Do the same with r numbers for each stage. */
FVI_VECTORS static void add_weights(size_t s, size_t r, const double *W, const double *restrict change,
                                    double *restrict force)
{
    for (size_t i = 0; i < s; i++)
        for (size_t c = 0; c < s; c++)
#pragma omp simd
            for (size_t n = 0; n < r; n++)
                force[i * r + n] += W[i * s + c] * change[c * r + n];
}

/* Add the effect of V_i - v_k to the force of a damper, and compute its slopes. z holds B^T v_k - drift. */
static int end_damper(const fvi_lobatto_matrices *o, fvi_stage_damper *a)
{
    const fvi_damping_matrix *C = &a->of.matrix;
    const size_t s = o->s, r = a->r;
    double *change = a->Y; /* the sums of this step are no longer needed */
    int status = FVI_SUCCESS;
    for (size_t i = 0; !status && i < s; i++)
        status = C->select_history(o->d, o->V + i * o->d, a->zero, C->params, change + i * r);
    for (size_t i = 0; !status && i < s; i++)
        for (size_t n = 0; n < r; n++)
            a->slope[n * s + i] = change[i * r + n];
    if (!status && r == 1)
        add_weights_to_one(s, a->W, change, a->force);
    else if (!status)
        add_weights(s, r, a->W, change, a->force);
    for (size_t n = 0; !status && a->Ydot && n < r; n++)
        for (size_t i = 0; i < s; i++)
            for (size_t c = 0; c < s; c++)
                a->force_by_order[i * r + n] += a->scale * fvi_lobatto_history_w0_by_order(a->memory)[i * s + c]
                                                * a->slope[n * s + c];
    for (size_t n = 0; !status && n < r; n++)
        for (size_t i = 0; i < s; i++)
            a->slope[n * s + i] += a->z[n];
    return status;
}

int fvi_stage_dampers_end_step(fvi_lobatto_matrices *o)
{
    int status = FVI_SUCCESS;
    for (size_t j = 0; !status && j < o->dampers; j++)
        status = end_damper(o, o->each + j);
    return status;
}

int fvi_stage_dampers_push(fvi_lobatto_matrices *o)
{
    int status = FVI_SUCCESS;
    for (size_t j = 0; !status && j < o->dampers; j++) {
        fvi_stage_damper *a = o->each + j;
        status = fvi_lobatto_history_push(a->memory, a->slope, a->Y, a->Ydot);
    }
    return status;
}

/* ---- impulses and work of the dampers ---- */

int fvi_stage_damper_sums(const fvi_stepper *s, size_t index, double *impulse, double *work)
{
    const fvi_lobatto_matrices *o = fvi_lobatto_matrices_of(s);
    const fvi_stage_damper *a = o->each + index;
    const fvi_damping_matrix *C = &a->of.matrix;
    double *J = o->room;
    int status = FVI_SUCCESS;
    for (size_t i = 0; !status && i < o->s; i++) {
        memset(J, 0, o->d * sizeof *J);
        status = C->apply_damping(o->d, -s->run.h * o->rule->b[i], a->force + i * a->r, C->params, J);
        for (size_t j = 0; j < o->d; j++) {
            if (a->past.size)
                J[j] += a->past.size[j] * a->impulse[i];
            impulse[j] += J[j];
            *work += J[j] * o->V[i * o->d + j];
        }
    }
    return status;
}

int fvi_stage_dampers_keep(fvi_stepper *s)
{
    fvi_lobatto_matrices *o = s->method_state;
    for (size_t j = 0; j < o->dampers; j++) {
        free(o->each[j].kept);
        o->each[j].work = 0;
        o->each[j].kept = calloc(o->d, sizeof *o->each[j].kept);
        if (!o->each[j].kept)
            FVI_FAIL("no memory for the sums of the dampers", FVI_ENOMEM);
    }
    return FVI_SUCCESS;
}

int fvi_stage_dampers_told(const fvi_stepper *s, size_t j, double *impulse, double *work)
{
    const fvi_lobatto_matrices *o = s->method_state;
    const fvi_mechanism *mechanism = s->run.system->mechanism;
    const fvi_stage_damper *a = o->each, *end = o->each + o->dampers;
    if (!mechanism)
        return FVI_EUNSUP;
    if (j >= mechanism->damper_count)
        return FVI_EINVAL;
    while (a < end && a->number != j)
        a++;
    if (a < end && !a->kept)
        return FVI_EUNSUP;
    if (work)
        *work = a < end ? a->work : 0;
    if (impulse)
        fvi_damping_impulse(mechanism->damper + j, o->d, a < end ? a->kept : NULL, impulse);
    return FVI_SUCCESS;
}

/* ---- copies ---- */

static size_t numbers_of(const fvi_lobatto_matrices *o, const fvi_stage_damper *a)
{
    return 3 * a->r + 3 * o->s * a->r;
}

static int copy_damper(const fvi_lobatto_matrices *o, const fvi_stage_damper *from,
                       fvi_stage_damper *to)
{
    *to = *from;
    to->drift = to->kept = NULL;
    to->memory = NULL;
    to->past = (fvi_initial_history_force){ 0 };
    int status = make_numbers(to, o->s, 0); /* linearised runs are never copied */
    if (!status)
        memcpy(to->drift, from->drift, numbers_of(o, from) * sizeof *to->drift);
    if (!status && from->kept) {
        to->kept = malloc(o->d * sizeof *to->kept);
        if (!to->kept)
            FVI_FAIL("no memory for the sums of the dampers", FVI_ENOMEM);
        memcpy(to->kept, from->kept, o->d * sizeof *to->kept);
    }
    if (!status)
        status = fvi_initial_history_force_copy(&from->past, o->d, &to->past);
    return status ? status : fvi_lobatto_history_copy(from->memory, &to->memory);
}

int fvi_stage_dampers_copy(const fvi_stepper *from, fvi_stepper *to)
{
    const fvi_lobatto_matrices *old = from->method_state;
    fvi_lobatto_matrices *o = to->method_state;
    int status = FVI_SUCCESS;
    o->each = calloc(old->dampers + 1, sizeof *o->each);
    if (!o->each)
        FVI_FAIL("no memory for the dampers", FVI_ENOMEM);
    for (size_t j = 0; !status && j < old->dampers; j++)
        status = copy_damper(old, old->each + j, o->each + o->dampers++);
    return status;
}

int fvi_stage_dampers_serialize(fvi_stepper *s, fvi_archive *v)
{
    fvi_lobatto_matrices *o = s->method_state;
    int status = FVI_SUCCESS;
    for (size_t j = 0; !status && j < o->dampers; j++) {
        fvi_stage_damper *a = o->each + j;
        status = v->serialize(v, a->drift, numbers_of(o, a) * sizeof *a->drift, 0);
        if (!status)
            status = fvi_lobatto_history_archive(a->memory, s->k, v);
        if (!status && a->kept)
            status = FVI_SERIALIZE(v, FVI_STATES(a->kept, o->d), FVI_STATE(a->work));
    }
    return status;
}

void fvi_stage_dampers_stop(fvi_lobatto_matrices *o)
{
    for (size_t j = 0; o->each && j < o->dampers; j++) {
        fvi_stage_damper *a = o->each + j;
        fvi_lobatto_history_free(a->memory);
        fvi_initial_history_force_stop(&a->past);
        free(a->drift);
        free(a->kept);
    }
    free(o->each);
}
