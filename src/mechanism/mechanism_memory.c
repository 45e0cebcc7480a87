/* src/mechanism/mechanism_memory.c -- The histories of the dampers and the forces of their pasts.  [H 29] */
#include "mechanism_state.h"
#include "memory/history_kinds.h"
#include "memory/history_parts.h"
#include "run/run_damper.h"
#include "run/solution.h"
#include "system/fail.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- terms of a kernel ---- */

static int is_active(const fvi_kernel *kernel)
{
    for (size_t i = 0; i < kernel->count; i++)
        if (kernel->term[i].rho > 0)
            return 1;
    return 0;
}

/* ---- pasts ---- */

static int add_start_force(fvi_stepper *s, size_t j, const fvi_kernel_term *t,
                           double amplitude)
{
    static const double ends[] = { 0, 1 };
    fvi_mechanism_state *o = s->mechanism;
    fvi_mechanism_start_force *force = &o->start_force[o->start_forces++];
    force->damper = j;
    force->size = amplitude;
    const fvi_kernel *kernel = s->run.system->mechanism->damper[j].kernel;
    if (!t)
        return o->rule ? fvi_impulses_of_kernel_at_stages(
                             kernel, s->run.h, o->s, o->rule->c, &force->of_kernel)
                       : fvi_impulses_of_kernel_alloc(kernel, s->run.h,
                                                      &force->of_kernel);
    fvi_kernel_impulse_prepare(t->alpha, o->rule ? o->s : 2,
                               o->rule ? o->rule->c : ends, &force->impulse);
    force->size *= t->rho * pow(s->run.h, 1 + force->impulse.e);
    return FVI_SUCCESS;
}

int fvi_mechanism_check_stretch(const fvi_kernel *kernel, size_t j, fvi_error *error)
{
    for (size_t i = 0; i < kernel->count; i++) {
        const fvi_kernel_term *t = &kernel->term[i];
        if (t->rho != 0 && (!fvi_kernel_term_is_power(t) || t->alpha > 0.5))
            return fvi_at_index(error, j,
                                fvi_fail(error, fvi_kernel_term_is_power(t) ? FVI_EDOM : FVI_EUNSUP, "damper",
                                         (double)j + 1, "the past rl of damper %zu wants powers of order 1 at most, "
                                         "or an elongation of 0", j + 1));
    }
    return FVI_SUCCESS;
}

int fvi_mechanism_is_stretched(const fvi_stepper *s, size_t j)
{
    const fvi_mechanism_state *o = s->mechanism;
    double size = 0;
    for (size_t i = 0; i < o->d; i++)
        size += fabs(o->G[j * o->d + i] * s->x[i]);
    return !(fabs(o->z[j]) <= FVI_ROUNDING_SHARE * size);
}

/* Add the start forces of the past rl, in which the damper was stretched to z at t = 0. For powers of order 1 at most
 * these forces are known, and a motion exists. */
static int add_start_forces_of_position(fvi_stepper *s, size_t j, fvi_error *error)
{
    const fvi_mechanism_state *o = s->mechanism;
    const fvi_kernel *kernel = s->run.system->mechanism->damper[j].kernel;
    if (!fvi_mechanism_is_stretched(s, j))
        return FVI_SUCCESS;
    int status = fvi_mechanism_check_stretch(kernel, j, error);
    for (size_t i = 0; i < kernel->count && !status; i++) {
        const fvi_kernel_term *t = &kernel->term[i];
        if (t->rho != 0 && t->alpha < 0.5)
            status = add_start_force(s, j, t, o->z[j]);
    }
    return status;
}

/* Add the start force of a damper that needs the slope zdot of its start. t zdot is subtracted from its elongation, and
 * the response of the kernel to t zdot is added exactly. For Caputo's past this response is zero. */
static int add_start_force_of_slope(fvi_stepper *s, size_t j, double zdot)
{
    const fvi_damper *damper = &s->run.system->mechanism->damper[j];
    const fvi_kernel *kernel = damper->kernel;
    const int is_one = kernel->count == 1 && fvi_kernel_term_is_power(kernel->term);
    return damper->past == FVI_INITIAL_HISTORY_CAPUTO
               ? FVI_SUCCESS
               : add_start_force(s, j, is_one ? kernel->term : NULL, zdot);
}

int fvi_mechanism_slope(const fvi_stepper *s, size_t j, const double *v, double *zdot)
{
    const fvi_mechanism_state *o = s->mechanism;
    const fvi_elongation *of = &s->run.system->mechanism->damper[j].of;
    int status = FVI_SUCCESS;
    *zdot = 0;
    if (!of->row && of->rate)
        status = of->rate(0, o->d, s->x, of->params, zdot);
    for (size_t i = 0; i < o->d; i++)
        *zdot += o->G[j * o->d + i] * v[i];
    return status;
}

int fvi_mechanism_needs_start_slope(const fvi_mechanism_state *o, const fvi_damper *damper)
{
    const double growth = fvi_kernel_growth(damper->kernel);
    return growth > 1 && !(o->rule && growth == 2)
           && (o->form != FVI_MECHANISM_FIRST_ORDER
               || damper->past == FVI_INITIAL_HISTORY_CAPUTO);
}

static int begin_damper(fvi_stepper *s, size_t j, const double *v,
                        fvi_error *error)
{
    fvi_mechanism_state *o = s->mechanism;
    const fvi_damper *damper = &s->run.system->mechanism->damper[j];
    const int first = o->form == FVI_MECHANISM_FIRST_ORDER,
              is_rl = damper->past == FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE;
    double zdot;
    int status = fvi_mechanism_slope(s, j, v, &zdot);
    o->z0[j] = first && is_rl ? 0 : o->z[j];
    if (!status && is_rl && !first)
        status = add_start_forces_of_position(s, j, error);
    const int subtracts = zdot != 0 && fvi_mechanism_needs_start_slope(o, damper);
    if (!status && subtracts)
        status = add_start_force_of_slope(s, j, zdot);
    if (!status && is_active(damper->kernel))
        o->part[o->parts++] = (fvi_mechanism_part){ .damper = j,
                                                    .kernel = *damper->kernel,
                                                    .drift = subtracts ? zdot : 0 };
    return status;
}

/* ---- histories ---- */

static int begin_nodes(fvi_stepper *s, fvi_mechanism_part *part)
{
    fvi_mechanism_state *o = s->mechanism;
    const int first = o->form == FVI_MECHANISM_FIRST_ORDER;
    int status = fvi_kernel_history(
        &part->kernel, first ? FVI_DELTA_EULER : FVI_DELTA_BDF2, s->run.h, 1,
        s->run.steps, s->run.memory, s->run.tolerance, &part->first,
        &part->history);
    o->W[part->damper] += part->first;
    double z = o->z[part->damper] - o->z0[part->damper], H;
    if (!status && first) { /* the term k = 0 */
        status = fvi_history_push(part->history, &z, &z, &H);
        *part->last = z;
    }
    return status;
}

double fvi_mechanism_tolerance(const fvi_run *run)
{
    return run->tolerance > 0 ? fmax(run->tolerance / 10, 1e-14) : 1e-14;
}

static int begin_stages(fvi_stepper *s, fvi_mechanism_part *part)
{
    fvi_mechanism_state *o = s->mechanism;
    const size_t n = o->s;
    const double keep = fvi_mechanism_tolerance(&s->run);
    const int status = fvi_lobatto_history_of_kernel(
        n, &part->kernel, s->run.h, 1, s->run.steps, s->run.memory, keep,
        &part->stages);
    for (size_t i = 0; i < n * n && !status; i++)
        o->W[part->damper * n * n + i] +=
            fvi_lobatto_history_w0(part->stages)[i];
    return status;
}

int fvi_mechanism_begin_histories(fvi_stepper *s, const double *v,
                                  fvi_error *error)
{
    fvi_mechanism_state *o = s->mechanism;
    const fvi_mechanism *mechanism = s->run.system->mechanism;
    size_t terms = 0;
    for (size_t j = 0; j < o->r; j++)
        terms += mechanism->damper[j].kernel->count;
    o->part = calloc(o->r + 1, sizeof *o->part);
    o->start_force = calloc(terms + o->r + 1, sizeof *o->start_force);
    if (!o->part || !o->start_force)
        return FVI_ENOMEM;
    int status = FVI_SUCCESS;
    for (size_t j = 0; j < o->r && !status; j++)
        status = begin_damper(s, j, v, error);
    for (size_t i = 0; i < o->parts && !status; i++) {
        o->part[i].last = calloc(FVI_STAGES, sizeof(double));
        if (!o->part[i].last)
            return FVI_ENOMEM;
        status = (o->rule ? begin_stages : begin_nodes)(s, &o->part[i]);
        status = fvi_run_damper_name_refused(&s->run, o->part[i].damper, status, error);
    }
    return status;
}

/* ---- a step ---- */

/* Compute the impulses of the start forces at both ends of the step, or their forces at each stage. */
static void predict_start_forces(fvi_stepper *s)
{
    fvi_mechanism_state *o = s->mechanism;
    double impulse[FVI_KERNEL_IMPULSE_NODES];
    memset(o->start_impulse, 0, 2 * o->r * sizeof *o->start_impulse);
    const fvi_mechanism_start_force *end = o->start_force + o->start_forces;
    for (const fvi_mechanism_start_force *p = o->start_force; p < end; p++) {
        if (p->of_kernel)
            fvi_impulses_of_kernel_at(p->of_kernel, s->k, impulse);
        else
            fvi_kernel_impulses(&p->impulse, s->k, impulse);
        for (size_t i = 0; !o->rule && i < 2; i++)
            o->start_impulse[2 * p->damper + i] += p->size * impulse[i];
        for (size_t i = 0; o->rule && i < o->s; i++)
            o->known[p->damper * o->s + i] +=
                p->size / s->run.h * impulse[i] / o->rule->b[i];
    }
}

//> predict
int fvi_mechanism_predict_forces(fvi_stepper *s)
{
    fvi_mechanism_state *o = s->mechanism;
    const size_t n = o->s;
    const double t = ((double)s->k + 0.5) * s->run.h;
    int status = FVI_SUCCESS;
    if (o->form == FVI_MECHANISM_FIRST_ORDER)
        return status;
    memset(o->known, 0, o->r * n * sizeof *o->known);
    for (fvi_mechanism_part *p = o->part; p < o->part + o->parts && !status;
         p++) {
        double *known = o->known + p->damper * n, ahead;
        if (o->rule) {
            const double *W = fvi_lobatto_history_w0(p->stages);
            for (size_t i = 0; i < n; i++) {
                known[i] += p->last[i];
                for (size_t l = 0; l < n; l++)
                    known[i] -= W[i * n + l] * p->drift;
            }
            continue;
        }
        status = fvi_history_ahead(p->history, p->last, &ahead);
        *known += p->first * (ahead - *p->last - p->drift * t);
    }
    predict_start_forces(s);
    return status;
}
//< predict

int fvi_mechanism_update_histories(fvi_stepper *s, double t, const double *z)
{
    fvi_mechanism_state *o = s->mechanism;
    const size_t n = o->s;
    int status = FVI_SUCCESS;
    memset(o->lambda, 0, o->r * n * sizeof *o->lambda);
    for (fvi_mechanism_part *p = o->part; p < o->part + o->parts && !status;
         p++) {
        if (o->rule) {
            double v[FVI_STAGES];
            for (size_t i = 0; i < n; i++)
                v[i] = z[p->damper * n + i] - p->drift;
            status = fvi_lobatto_history_push(p->stages, v, p->last, NULL);
            continue;
        }
        double now = z[p->damper] - p->drift * t, H;
        const double more = now - *p->last;
        status = fvi_history_push(p->history, &now, &more, &H);
        *p->last = now;
        o->lambda[p->damper] += p->first * H;
    }
    return status;
}

/* ---- copies ---- */

static int copy_part(const fvi_mechanism_part *from, fvi_mechanism_part *to)
{
    *to = *from;
    to->history = NULL;
    to->stages = NULL;
    to->last = malloc(FVI_STAGES * sizeof *to->last);
    if (!to->last)
        return FVI_ENOMEM;
    memcpy(to->last, from->last, FVI_STAGES * sizeof *to->last);
    return from->stages
               ? fvi_lobatto_history_copy(from->stages, &to->stages)
               : fvi_history_copy(from->history, &to->history);
}

int fvi_mechanism_copy_parts(const fvi_mechanism_state *from,
                             fvi_mechanism_state *to)
{
    to->part = calloc(from->parts + 1, sizeof *to->part);
    to->start_force = calloc(from->start_forces + 1, sizeof *to->start_force);
    if (!to->part || !to->start_force)
        return FVI_ENOMEM;
    int status = FVI_SUCCESS;
    for (size_t i = 0; i < from->start_forces && !status; i++, to->start_forces++) {
        to->start_force[i] = from->start_force[i];
        to->start_force[i].of_kernel = NULL;
        if (from->start_force[i].of_kernel)
            status = fvi_impulses_of_kernel_copy(from->start_force[i].of_kernel,
                                                 &to->start_force[i].of_kernel);
    }
    for (size_t i = 0; i < from->parts && !status; i++, to->parts++)
        status = copy_part(&from->part[i], &to->part[i]);
    return status;
}

/* In the scheme of order 1 the history has one term more, from the start. */
int fvi_mechanism_serialize_parts(fvi_stepper *s, fvi_archive *v)
{
    fvi_mechanism_state *o = s->mechanism;
    const size_t first = o->form == FVI_MECHANISM_FIRST_ORDER;
    int status = FVI_SUCCESS;
    for (fvi_mechanism_part *p = o->part; p < o->part + o->parts && !status;
         p++) {
        status = v->serialize(v, p->last, FVI_STAGES * sizeof *p->last, 0);
        if (!status && p->stages)
            status = fvi_lobatto_history_archive(p->stages, s->k, v);
        else if (!status) {
            status = fvi_history_archive(p->history, v);
            if (!status)
                status = fvi_check_count(fvi_history_terms(p->history),
                                         s->k + first);
        }
    }
    return status;
}

void fvi_mechanism_free_parts(fvi_mechanism_state *o)
{
    for (size_t i = 0; o->part && i < o->parts; i++) {
        fvi_history_free(o->part[i].history);
        fvi_lobatto_history_free(o->part[i].stages);
        free(o->part[i].last);
    }
    for (size_t i = 0; o->start_force && i < o->start_forces; i++)
        fvi_impulses_of_kernel_free(o->start_force[i].of_kernel);
    free(o->part);
    free(o->start_force);
}
