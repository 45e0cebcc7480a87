/* src/observer/observer_start.c -- Start, copy, serialise and free an observer. */
#include "observer_state.h"

#include "mechanism/mechanism_state.h"
#include "system/arrays.h"
#include "system/fail.h"
#include "variable_step/variable_mechanism.h"

#include <fvi/events.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The quantities that need the sums over the steps. */
enum {
    SUMMED = FVI_OBSERVE_ACCELERATION | FVI_OBSERVE_FORCE
             | FVI_OBSERVE_IMPULSE | FVI_OBSERVE_WORK | FVI_OBSERVE_MULTIPLIER
};

/* ---- memory ---- */

/* Allocate all arrays in one block, first those that steps change. The sizes are set before. Each of the others, but
 * for the contacts, has room for d numbers and for the tracked sums, because several of them hold both in turn. */
static int allocate(fvi_observer *o)
{
    const size_t d = o->d, f = o->tracked, dampers = o->dampers, room = d > f ? d : f;
    o->numbers = FVI_ARRAYS(
        { &o->impulse, f }, { &o->latest, o->degree * f }, { &o->work, dampers }, { &o->lead, dampers },
        { &o->known, d }, { &o->bend, o->bends }, { &o->bend_rate, dampers }, { &o->scalars, FVI_SCALARS },
        { &o->begun_work, o->on_structure }, { &o->stage_power, FVI_LANES * o->on_structure },
        { &o->p0, room }, { &o->start, room }, { &o->begin_v, room }, { &o->exponent, room }, { &o->rate, room },
        { &o->power, room }, { &o->jump, room }, { &o->line, room }, { &o->growth, room }, { &o->is_jumping, room },
        { &o->is_moving, room }, { &o->begin.x, room }, { &o->begin.p, room }, { &o->begin.F, FVI_STAGES * room },
        { &o->begin.dampers, room }, { &o->hit, room }, { &o->change, room }, { &o->x, room }, { &o->p, room },
        { &o->v, room }, { &o->a, room }, { &o->F, room }, { &o->g, room }, { &o->force, room },
        { &o->impulse_now, room }, { &o->work_now, room }, { &o->contact, o->contacts });
    if (!o->numbers)
        return FVI_ENOMEM;
    o->saved = (size_t)(o->p0 - o->numbers);
    o->count = (size_t)(o->contact - o->numbers) + o->contacts;
    if (o->contacts == 0)
        o->contact = NULL;
    return FVI_SUCCESS;
}

/* ---- which sums are needed ---- */

/* The degree of the differences. For methods of order 1, such as Algorithm 3, it is 1, because the differences of their
 * impulses are their own forces. For other methods it is one more than their highest order. */
static size_t degree_of(const fvi_method *method)
{
    const size_t more = (size_t)method->highest + 1;
    return method->highest == 1          ? 1
           : more > FVI_MOST_DIFFERENCES ? FVI_MOST_DIFFERENCES
                                         : more;
}

static int is_damped(const fvi_system *system)
{
    if (system->matrices)
        return system->matrices->damping.history_size > 0;
    for (size_t j = 0; j < system->d; j++)
        if (system->damping[j] > 0)
            return 1;
    return 0;
}

/* Return nonzero if an acceleration may differ from (F - grad U - the forces of the dampers) / m. */
static int needs_slope(const fvi_system *system)
{
    const fvi_mechanism *m = system->mechanism;
    int massless = 0;
    for (size_t j = 0; !m->lagrangian && j < system->d; j++)
        massless |= system->mass[j] == 0;
    return m->lagrangian || m->force_on || massless
           || (m->constraints && m->constraints->count > 0);
}

static void describe_forces(fvi_observer *o, const fvi_stepper *s, unsigned wanted)
{
    const fvi_system *system = s->run.system;
    o->d = system->d;
    o->wanted = wanted;
    o->matrices = system->matrices;
    o->is_summed = (wanted & SUMMED) != 0;
    o->mechanism = system->mechanism;
    o->has_mechanism = system->mechanism && !system->matrices;
    o->dampers = o->has_mechanism ? system->mechanism->damper_count
                                  : fvi_step_dampers(system);
    o->forces = o->has_mechanism ? o->dampers : o->dampers * o->d;
    o->by_velocity = o->has_mechanism && wanted & FVI_OBSERVE_ACCELERATION
                     && needs_slope(system);
    o->slopes = o->by_velocity ? o->d : 0;
    o->ties = o->has_mechanism && wanted & FVI_OBSERVE_MULTIPLIER
                      && system->mechanism->constraints
                  ? system->mechanism->constraints->count
                  : 0;
    o->tracked = o->forces + o->slopes + o->ties;
    o->contacts = o->has_mechanism && wanted & FVI_OBSERVE_CONTACT ? s->run.event_count : 0;
    for (size_t i = 0; o->has_mechanism && s->mechanism && i < o->d; i++)
        o->has_massless |= s->mechanism->is_massless[i];
    o->is_damped = system->mechanism || is_damped(system);
    o->is_mass = !system->mechanism && !o->matrices && s->run.alpha == 1;
    o->work_known = system->mechanism || fvi_step_work_is_known(s);
    o->by_energy =
        !system->mechanism && (s->method->stages || !o->work_known);
    o->on_structure = fvi_observer_is_on_structure(o, s) ? o->dampers : 0;
    o->degree = degree_of(s->method);
    o->bends = fvi_ramp_method(s) && o->has_mechanism && o->tracked > o->forces
                   ? o->dampers * fvi_observer_first_rows(o)
                   : 0;
}

/* ---- the start ---- */

/* The multipliers at t = 0: the slope of the parabola through their impulses at 0, h and 2 h; or their mean over the
 * first step, if no second step can be made. fork: a stepper at the first node. */
static int start_ties(fvi_observer *o, fvi_stepper *fork, double h)
{
    double *start = o->start + o->forces + o->slopes;
    int status = FVI_SUCCESS;
    for (size_t i = 0; i < o->ties && !status; i++) {
        status = fvi_stepper_tie(fork, i, &start[i]);
        start[i] /= h;
    }
    if (status || fork->k >= fork->run.steps || fvi_stepper_step(fork))
        return status;
    for (size_t i = 0; i < o->ties && !status; i++) {
        double J;
        status = fvi_stepper_tie(fork, i, &J);
        start[i] = 2 * start[i] - J / (2 * h);
    }
    return status;
}

/* The same for chosen steps: from the polynomial of the first step. */
static int start_ties_on_mesh(fvi_observer *o, const fvi_stepper *s)
{
    fvi_stepper *fork = NULL;
    int status = fvi_stepper_copy(s, &fork);
    if (!status)
        status = fvi_stepper_step(fork);
    for (size_t i = 0; i < o->ties && !status; i++)
        o->start[o->forces + o->slopes + i] = fvi_mesh_multiplier(fork, i, 0);
    fvi_stepper_free(fork);
    return status;
}

int fvi_observer_take_first_row(fvi_stepper *fork, fvi_observer *sums, double *end)
{
    const double h = fork->run.h;
    int status = FVI_SUCCESS;
    while (!status && fork->t < h && !fvi_stepper_is_over(fork))
        status = sums ? fvi_observer_step(sums, fork) : fvi_stepper_step(fork);
    *end = fork->t < h ? fork->t : h;
    return status || *end > 0 ? status : FVI_EINVAL;
}

/* Replace infinite forces at t = 0 by their means over the first row. Accelerations and multipliers follow from these
 * means by the equation of motion; or, if the equation of a mechanism cannot be solved, they are means themselves. */
static int set_mean_start(fvi_observer *o, const fvi_stepper *s)
{
    fvi_stepper *fork = NULL;
    fvi_observer *sums = NULL;
    fvi_observation now = { 0 };
    double end = 0;
    int status = fvi_stepper_copy(s, &fork);
    if (!status)
        status = fvi_observer_start(
            fork, FVI_OBSERVE_IMPULSE | FVI_OBSERVE_VELOCITY | FVI_OBSERVE_OWN_STEPS, &sums, NULL);
    if (!status)
        status = fvi_observer_take_first_row(fork, sums, &end);
    if (!status)
        status = fvi_observer_read_all(sums, fork, end, &now);
    const double *first = o->has_massless ? fvi_short_row(&o->short_rows, 1) : NULL;
    const double *v = first ? first + o->forces : now.v;
    for (size_t j = 0; j < o->forces && !status; j++)
        if (isinf(o->start[j]))
            o->start[j] = now.impulse[j] / end;
    if (!status && o->has_mechanism)
        status = fvi_observer_begin_motion(o, s);
    const int is_known = o->tracked > o->forces && isfinite(o->start[o->forces]);
    for (size_t i = o->forces; i < o->forces + o->slopes && !is_known && !status; i++)
        o->start[i] = (v[i - o->forces] - o->impulse[i]) / end;
    if (!status && o->begin_v_known)
        status = fvi_observer_begin_accelerations(o, s);
    if (!status && !is_known && o->ties > 0)
        status = s->method->dense ? start_ties_on_mesh(o, s) : start_ties(o, fork, end);
    fvi_observer_free(sums);
    fvi_stepper_free(fork);
    return status;
}

static int begin(fvi_observer *o, const fvi_stepper *s)
{
    const unsigned forces = FVI_OBSERVE_FORCE | FVI_OBSERVE_ACCELERATION
                            | FVI_OBSERVE_MULTIPLIER;
    int status = FVI_SUCCESS;
    if (o->matrices)
        status = o->matrices->factorise(o->d, 1, NULL, 0, o->matrices->params,
                                        &o->factors);
    if (!status)
        status = allocate(o);
    if (status)
        return status;
    memcpy(o->p0, s->p, o->d * sizeof *s->p);
    if (s->method->dense)
        o->scalars[FVI_HITS] =
            (double)((const fvi_variable_step_state *)s->method_state)->hits;
    if (o->wanted & FVI_OBSERVE_WORK)
        status = fvi_energy_at(s->run.system, 0, s->x, s->p, &o->E0);
    if (!status && o->has_massless)
        status = fvi_observer_begin_massless(o, s);
    if (!status && o->wanted & forces)
        status = fvi_observer_begin_forces(o, s);
    for (size_t i = o->forces; i < o->forces + o->slopes; i++)
        o->impulse[i] = o->v[i - o->forces];
    if (!status && o->is_summed)
        status = fvi_observer_begin_ramps(o, s);
    if (!status)
        status = fvi_short_rows_start(o, s);
    if (!status && o->has_massless && !o->begin_v_known && !(o->wanted & FVI_OBSERVE_OWN_STEPS))
        status = fvi_observer_mean_massless(o, s);
    return !status && o->is_infinite ? set_mean_start(o, s) : status;
}

int fvi_observer_start(const fvi_stepper *s, unsigned wanted, fvi_observer **to,
                       fvi_error *error)
{
    if (!s || !to)
        return fvi_fail(error, FVI_EFAULT, "observer", NAN, "null pointer");
    if (s->k != 0 || s->t != 0)
        return fvi_fail(error, FVI_EINVAL, "observer", (double)s->k,
                        "an observer goes with a run from its start");
    if (s->run.event_count && !s->mechanism
        && wanted & (FVI_OBSERVE_FORCE | FVI_OBSERVE_IMPULSE | FVI_OBSERVE_WORK))
        return fvi_fail(error, FVI_EUNSUP, "observer", NAN,
                        "forces, impulses and work are not known with events");
    fvi_observer *o = calloc(1, sizeof *o);
    if (!o)
        return fvi_no_memory(error, NULL);
    describe_forces(o, s, wanted);
    const int status = begin(o, s);
    if (status) {
        fvi_observer_free(o);
        return fvi_fail(error, status, NULL, NAN, "%s",
                        fvi_error_name(status));
    }
    *to = o;
    return FVI_SUCCESS;
}

/* ---- sizes, copy, archive, end ---- */

size_t fvi_observer_dampers(const fvi_observer *o)
{
    return o->dampers;
}

size_t fvi_observer_short_rows(const fvi_observer *o)
{
    return o->short_rows.rows;
}

size_t fvi_observer_width(const fvi_observer *o, size_t j)
{
    return j >= o->dampers ? 0
           : o->mechanism && !o->mechanism->damper[j].matrix ? 1
                                                             : o->d;
}

const double *fvi_observer_row(const fvi_observer *o, size_t j)
{
    return !o->mechanism || o->has_mechanism || o->mechanism->damper[j].matrix ? NULL : o->mechanism->damper[j].of.row;
}

int fvi_observer_copy(const fvi_observer *from, fvi_observer **to)
{
    fvi_observer *o = from ? malloc(sizeof *o) : NULL;
    if (!o)
        return FVI_ENOMEM;
    *o = *from;
    o->factors = NULL;
    o->numbers = NULL;
    o->ramp = NULL;
    int status = fvi_law_rows_copy(&from->law_rows, &o->law_rows);
    if (fvi_short_rows_copy(&from->short_rows, &o->short_rows))
        status = FVI_ENOMEM;
    if (!status)
        status = allocate(o);
    if (!status)
        memcpy(o->numbers, from->numbers, o->count * sizeof *o->numbers);
    if (!status && o->matrices)
        status = o->matrices->factorise(o->d, 1, NULL, 0, o->matrices->params,
                                        &o->factors);
    if (!status && from->ramp)
        status = fvi_observer_copy_ramps(from, o);
    if (status)
        fvi_observer_free(o);
    else
        *to = o;
    return status;
}

int fvi_observer_archive(fvi_observer *o, fvi_archive *archive)
{
    int status = archive->serialize(archive, o->numbers,
                                    o->saved * sizeof *o->numbers, 0);
    for (size_t j = 0; o->ramp && j < o->dampers && !status; j++)
        if (o->ramp[j])
            status = fvi_ramp_archive(o->ramp[j], archive);
    return status;
}

void fvi_observer_free(fvi_observer *o)
{
    if (!o)
        return;
    if (o->factors)
        o->matrices->free_factors(o->factors);
    fvi_observer_free_ramps(o);
    fvi_law_rows_free(&o->law_rows);
    fvi_short_rows_free(&o->short_rows);
    free(o->numbers);
    free(o);
}
