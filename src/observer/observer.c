/* src/observer/observer.c -- Add up impulses and work along a run.
 *
 * In steps of one length each step is added when it has been taken. In steps that the method chooses, the last step is
 * added before the next one, because a row may lie within it. An impulse of the force at a node is called a hit. */
#include "observer_state.h"

#include "mechanism/mechanism_state.h"
#include "run/impulses.h"
#include "system/fail.h"
#include "variable_step/variable_step.h"

#include <string.h>

/* ---- parts ---- */

int fvi_observer_velocity(const fvi_observer *o, const fvi_stepper *s,
                          const double *p, double *v)
{
    const fvi_system *system = s->run.system;
    if (o->has_mechanism)
        return fvi_stepper_velocity(s, v);
    for (size_t j = 0; j < o->d; j++)
        v[j] = o->matrices ? p[j] : p[j] / system->mass[j];
    return o->matrices ? o->matrices->solve(o->d, o->factors, v) : FVI_SUCCESS;
}

/* Add the work of an impulse J on the momenta to *work: J times the mean of the velocities before and after it. s->p is
 * p after it, so the mean belongs to the momentum p - J/2. o->a and o->v are used as room. */
static int add_work_of_impulse(fvi_observer *o, const fvi_stepper *s, const double *J,
                               double *work)
{
    int status = FVI_SUCCESS;
    for (size_t j = 0; j < o->d; j++)
        o->a[j] = s->p[j] - J[j] / 2;
    status = fvi_observer_velocity(o, s, o->a, o->v);
    for (size_t j = 0; j < o->d && !status; j++)
        *work += J[j] * o->v[j];
    return status;
}

/* ---- steps of one length ---- */

/* Add the increments of one step to the tracked sums, and keep them as the latest ones. */
static void record_increments(fvi_observer *o, const double *change)
{
    memmove(o->latest + o->tracked, o->latest,
            (o->degree - 1) * o->tracked * sizeof *o->latest);
    memcpy(o->latest, change, o->tracked * sizeof *change);
    for (size_t j = 0; j < o->tracked; j++)
        o->impulse[j] += change[j];
}

/* Compute the increments of all tracked sums in the last step of a mechanism, to o->change: forces of dampers, then
 * velocities, then multipliers of constraints. The stepper keeps these sums itself, so an increment is its sum minus
 * the observer's sum. */
static int compute_increments_of_mechanism(fvi_observer *o, const fvi_stepper *s)
{
    int status = o->ramp ? fvi_observer_step_ramps(o, o->change) : FVI_SUCCESS;
    for (size_t j = 0; j < o->dampers && !status; j++) {
        double impulse;
        status = fvi_stepper_damper(s, j, &impulse, &o->work[j]);
        o->change[j] = impulse + o->rate[j] * o->lead[j] - o->impulse[j];
    }
    if (!status && o->by_velocity)
        status = fvi_observer_velocity(o, s, s->p, o->v);
    const size_t ties_begin = o->forces + o->slopes;
    for (size_t i = o->forces; i < ties_begin; i++)
        o->change[i] = o->v[i - o->forces] - o->impulse[i];
    for (size_t i = 0; i < o->ties && !status; i++) {
        double impulse;
        status = fvi_stepper_tie(s, i, &impulse);
        o->change[ties_begin + i] = impulse - o->impulse[ties_begin + i];
    }
    return status;
}

/* Add the last step of a mechanism. */
static int add_step_of_mechanism(fvi_observer *o, const fvi_stepper *s)
{
    int status = compute_increments_of_mechanism(o, s);
    if (!status && o->wanted & FVI_OBSERVE_WORK)
        status = fvi_observer_mechanism_work(o, s, &o->scalars[FVI_BY_FORCE]);
    if (!status && o->wanted & FVI_OBSERVE_WORK && s->run.system->force.impulse_count)
        status = fvi_mechanism_work_of_impulse(s, s->t, s->x, s->p, o->hit,
                                               &o->scalars[FVI_BY_FORCE]);
    if (!status)
        record_increments(o, o->change);
    if (!status && o->ramp && o->bends > 0 && s->k <= fvi_observer_first_rows(o)
        && fvi_observer_bend(o, s) == FVI_ENOMEM) /* after any other code the correction is left out */
        status = FVI_ENOMEM;
    return status;
}

/* Add what the leads of the dampers changed in the last step to o->change (observer_ramp.h). */
static int add_leads(fvi_observer *o)
{
    double *const lead_change = o->force; /* room, a number for each damper */
    const int status = o->ramp ? fvi_observer_step_ramps(o, lead_change) : FVI_SUCCESS;
    for (size_t j = 0; o->ramp && j < o->dampers && !status; j++)
        for (size_t i = j * o->d; i < (j + 1) * o->d; i++)
            o->change[i] += o->rate[i] * lead_change[j];
    return status;
}

/* Add the last step, of a run with steps of one length. */
static int add_step(fvi_observer *o, const fvi_stepper *s)
{
    fvi_step_sums sums = { .damper = o->change, .work = o->work_now };
    const fvi_force *force = &s->run.system->force;
    memset(o->hit, 0, o->d * sizeof *o->hit);
    if (force->impulse_count)
        fvi_impulses_add(force, s->run.h, s->k, o->d, o->hit);
    if (o->has_mechanism)
        return add_step_of_mechanism(o, s);
    int status = fvi_step_ends(s, &o->begin, o->hit, &sums);
    if (!status && force->impulse_count)
        status = add_work_of_impulse(o, s, o->hit, &sums.by_force);
    if (status)
        return status;
    if (!o->is_damped) {
        memset(o->change, 0, o->forces * sizeof *o->change);
        *sums.work = 0;
    }
    status = add_leads(o);
    if (status)
        return status;
    record_increments(o, o->change);
    for (size_t j = 0; j < o->dampers; j++)
        o->work[j] += sums.work[j];
    o->scalars[FVI_BY_FORCE] += sums.by_force;
    return FVI_SUCCESS;
}

/* ---- steps that the method chooses ---- */

int fvi_observer_hits(fvi_observer *o, const fvi_stepper *s, double *known,
                      double *by_force)
{
    const fvi_variable_step_state *state = s->method_state;
    int status = FVI_SUCCESS;
    for (size_t i = (size_t)o->scalars[FVI_HITS]; i < state->hits && !status; i++) {
        const double *J = s->run.system->force.impulses[i].J;
        for (size_t j = 0; j < o->d; j++)
            known[j] += J[j];
        status = add_work_of_impulse(o, s, J, by_force);
    }
    return status;
}

/* Add the last step to o->known and to the work of the force: the quadrature over the step, then the hits at its
 * end. */
static int add_last_chosen_step(fvi_observer *o, const fvi_stepper *s)
{
    const fvi_variable_step_state *state = s->method_state;
    int status =
        fvi_observer_quadrature(o, s, o->scalars[FVI_BEGIN_TIME], s->t, o->known,
                                &o->scalars[FVI_BY_FORCE]);
    if (!status)
        status = fvi_observer_hits(o, s, o->known, &o->scalars[FVI_BY_FORCE]);
    o->scalars[FVI_BEGIN_TIME] = s->t;
    o->scalars[FVI_HITS] = (double)state->hits;
    return status;
}

int fvi_observer_step(fvi_observer *o, fvi_stepper *s)
{
    if (!o || !s)
        FVI_FAIL("null pointer", FVI_EFAULT);
    if (!o->is_summed)
        return fvi_stepper_step(s);
    if (s->method->dense && o->has_mechanism) /* the stepper keeps all sums */
        return fvi_stepper_step(s);
    const int chooses_steps = s->method->dense != NULL;
    int status = chooses_steps ? add_last_chosen_step(o, s) : fvi_step_begins(s, &o->begin);
    if (!status && o->on_structure)
        status = fvi_observer_close_structure(o, s);
    if (!status)
        status = fvi_stepper_step(s);
    if (!status && o->on_structure)
        status = fvi_observer_keep_structure(o, s);
    if (!status && !chooses_steps)
        status = add_step(o, s);
    return status;
}
