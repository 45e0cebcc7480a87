/* src/observer/observer_read.c -- Read an observer at a time: state, sums, forces, accelerations and balance. */
#include "observer_state.h"

#include "system/fail.h"
#include "variable_step/variable_mechanism.h"

#include <math.h>
#include <string.h>

/* Return nonzero for a mechanism whose steps are chosen. Then the sums of its dampers are known at all times. */
static int is_on_mesh(const fvi_observer *o, const fvi_stepper *s)
{
    return o->has_mechanism && s->method->dense;
}

static int read_state(fvi_observer *o, const fvi_stepper *s, double t,
                      fvi_observation *now)
{
    int status = FVI_SUCCESS;
    now->x = s->x;
    now->p = s->p;
    if (s->t != t) {
        now->x = o->x;
        now->p = o->p;
        status = s->method->dense ? s->method->dense(s, t, o->x, o->p)
                                  : FVI_EDOM;
    }
    if (!status && o->wanted & FVI_OBSERVE_VELOCITY)
        status = is_on_mesh(o, s) ? fvi_mesh_velocity(s, t, now->x, now->p, o->v)
                                  : fvi_observer_velocity(o, s, now->p, o->v);
    if (!status)
        status = fvi_step_force(s, t, o->F);
    return status;
}

/* Write the sums at t to impulse_now, and the work of the force. */
static int read_sums(fvi_observer *o, const fvi_stepper *s, double t,
                     fvi_observation *now)
{
    now->work_of_force = o->scalars[FVI_BY_FORCE];
    if (!s->method->dense) {
        memcpy(o->impulse_now, o->impulse, o->forces * sizeof *o->impulse);
        return FVI_SUCCESS;
    }
    if (is_on_mesh(o, s)) {
        double force;
        for (size_t j = 0; j < o->dampers; j++)
            fvi_mesh_sums(s, j, t, &force, &o->impulse_now[j], &o->work[j]);
        now->work_of_force = fvi_mesh_work_of_forces(s, t);
        return FVI_SUCCESS;
    }
    memcpy(o->change, o->known, o->d * sizeof *o->known);
    int status = fvi_observer_quadrature(o, s, o->scalars[FVI_BEGIN_TIME], t, o->change,
                                         &now->work_of_force);
    if (!status && t == s->t) {
        double *v = o->v; /* v has been read, and stays */
        o->v = o->hit;
        status = fvi_observer_hits(o, s, o->change, &now->work_of_force);
        o->v = v;
    }
    if (o->on_structure)
        return status ? status : fvi_observer_structure_sums(o, s, t);
    for (size_t j = 0; j < o->d; j++)
        o->impulse_now[j] =
            o->is_damped ? o->p0[j] + o->change[j] - now->p[j] : 0;
    return status;
}

/* Turn r = F - grad U - (forces of the dampers) into a = M^-1 r. */
static int solve_motion(fvi_observer *o, const fvi_stepper *s)
{
    if (o->by_velocity) {
        memcpy(o->a, o->force + o->forces, o->d * sizeof *o->a);
        return FVI_SUCCESS;
    }
    const int status = fvi_observer_damping(o, s, o->a);
    for (size_t j = 0; j < o->d && !status; j++) {
        o->a[j] = o->F[j] - o->g[j] - o->a[j];
        if (!o->matrices)
            o->a[j] /= s->run.system->mass[j];
    }
    return status || !o->matrices
               ? status
               : o->matrices->solve(o->d, o->factors, o->a);
}

/* At alpha = 1 the equation of motion is (m + rho) x'' = F - grad U, for all methods. */
static void divide_by_masses(fvi_observer *o, const fvi_system *system)
{
    for (size_t j = 0; j < o->d; j++) {
        o->a[j] = (o->F[j] - o->g[j])
                  / (system->mass[j] + system->damping[j]);
        o->force[j] = system->damping[j] * o->a[j];
    }
}

/* For a method that knows x'': the force of the damping is F - grad U - M x''. */
static int read_chosen_forces(fvi_observer *o, const fvi_stepper *s, double t)
{
    int status = fvi_variable_step_acceleration(s, t, o->a);
    for (size_t j = 0; j < o->d && !o->matrices; j++)
        o->force[j] = s->run.system->mass[j] * o->a[j];
    if (!status && o->matrices)
        status = o->matrices->inertia(o->d, o->a, o->matrices->params, o->force);
    for (size_t j = 0; j < o->d; j++)
        o->force[j] = o->is_damped ? o->F[j] - o->g[j] - o->force[j] : 0;
    return status;
}

/* Take the forces, accelerations and multipliers of row k from the short steps. Returns 0 if there are none. */
static int read_short_row(fvi_observer *o, size_t k)
{
    const double *row = fvi_short_row(&o->short_rows, k);
    const size_t f = o->forces, d = o->d;
    if (!row)
        return 0;
    memcpy(o->force, row, f * sizeof *row);
    memcpy(o->a, row + f + d, d * sizeof *row);
    memcpy(o->force + f + o->slopes, row + f + 2 * d, o->ties * sizeof *row);
    return 1;
}

static int read_forces(fvi_observer *o, const fvi_stepper *s, double t,
                       fvi_observation *now)
{
    const fvi_system *system = s->run.system;
    const int is_chosen = s->method->dense != NULL && t > 0;
    int status = FVI_SUCCESS;
    if (read_short_row(o, s->k))
        return FVI_SUCCESS;
    if (is_chosen && o->has_mechanism) {
        double impulse, work;
        for (size_t j = 0; j < o->dampers; j++)
            fvi_mesh_sums(s, j, t, &o->force[j], &impulse, &work);
        for (size_t i = 0; i < o->ties; i++)
            o->force[o->forces + o->slopes + i] = fvi_mesh_multiplier(s, i, t);
        return fvi_variable_step_acceleration(s, t, o->a);
    }
    if (is_chosen && o->on_structure) {
        status = fvi_observer_structure_forces(o, s, t);
        return status ? status : fvi_variable_step_acceleration(s, t, o->a);
    }
    if (is_chosen || o->is_mass
        || (o->wanted & FVI_OBSERVE_ACCELERATION && !o->by_velocity))
        status = fvi_potential_gradient(system, now->x, o->g);
    if (status)
        return status;
    if (o->is_mass) {
        divide_by_masses(o, system);
        return FVI_SUCCESS;
    }
    if (is_chosen)
        return read_chosen_forces(o, s, t);
    fvi_observer_differences(o, s->k, s->run.h, o->force);
    if (o->has_mechanism && o->tracked > o->forces && s->k > 0 && s->k <= fvi_observer_motion_rows(o))
        status = fvi_observer_motion(o, s, t, now->x);
    if (status == FVI_ENOMEM)
        return status;
    return o->wanted & FVI_OBSERVE_ACCELERATION ? solve_motion(o, s)
                                                : FVI_SUCCESS;
}

static int read_balance(fvi_observer *o, const fvi_stepper *s, double t,
                        fvi_observation *now)
{
    int status = fvi_energy_at(s->run.system, t, now->x, now->p, &now->energy);
    if (!(o->wanted & FVI_OBSERVE_WORK))
        return status;
    for (size_t j = 0; j < o->dampers; j++)
        o->work_now[j] = o->work[j] + o->power[j] * o->lead[j];
    if (o->is_damped && o->by_energy)
        o->work_now[0] = o->E0 - now->energy + now->work_of_force;
    const double *sums = o->work_known ? o->work : o->work_now;
    now->balance = now->energy - now->work_of_force;
    for (size_t j = 0; j < o->dampers; j++)
        now->balance += sums[j];
    return status;
}

/* Return nonzero if all wanted quantities are finite. */
static int is_finite(const fvi_observer *o, const fvi_observation *now)
{
    const unsigned w = o->wanted;
    return fvi_all_finite(o->d, now->x) && fvi_all_finite(o->d, now->p)
           && (!(w & FVI_OBSERVE_VELOCITY) || fvi_all_finite(o->d, now->v))
           && (!(w & FVI_OBSERVE_ACCELERATION) || fvi_all_finite(o->d, now->a))
           && (!(w & FVI_OBSERVE_FORCE) || fvi_all_finite(o->forces, now->force))
           && (!(w & FVI_OBSERVE_IMPULSE)
               || fvi_all_finite(o->forces, now->impulse))
           && (!(w & FVI_OBSERVE_WORK) || isfinite(now->balance))
           && fvi_all_finite(w & FVI_OBSERVE_MULTIPLIER ? o->ties : 0,
                             now->multiplier);
}

/* For a structure's damper along a row, f = lambda row, keep lambda alone; the forces of other dampers move up. */
static void reduce_to_multipliers(const fvi_observer *o, double *forces)
{
    double *to = forces;
    for (size_t j = 0; o->mechanism && !o->has_mechanism && j < o->dampers; j++) {
        const double *from = forces + j * o->d, *row = fvi_observer_row(o, j);
        double sum = 0, square = 0;
        for (size_t i = 0; row && i < o->d; i++) {
            sum += row[i] * from[i];
            square += row[i] * row[i];
        }
        if (row)
            *to++ = square > 0 ? sum / square : 0;
        else
            for (size_t i = 0; i < o->d; i++)
                *to++ = from[i];
    }
}

static int read_contacts(fvi_observer *o, const fvi_stepper *s, double t)
{
    int status = FVI_SUCCESS;
    for (size_t i = 0; i < s->run.event_count && !status; i++)
        if (s->run.events[i].action == FVI_EVENT_CONTACT)
            status = fvi_stepper_contact_force(s, i, t, &o->contact[i]);
    return status;
}

/* The mean of the acceleration over the first row, from a stepper at t = 0. */
static int read_mean_acceleration(fvi_observer *o, fvi_stepper *fork)
{
    double end = 0;
    double *before = o->change;
    int status = fvi_observer_velocity(o, fork, fork->p, before);
    if (!status)
        status = fvi_observer_take_first_row(fork, NULL, &end);
    if (!status)
        status = fork->method->dense(fork, end, o->x, o->p);
    if (!status)
        status = fvi_mesh_velocity(fork, end, o->x, o->p, o->a);
    for (size_t j = 0; j < o->d && !status; j++)
        o->a[j] = (o->a[j] - before[j]) / end;
    return status;
}

/* If a body lies on a surface at t = 0, the forces alone do not say how it moves. A first step does, or, if the force
 * of a damper is infinite, the first row. */
static int read_start_at_contact(fvi_observer *o, const fvi_stepper *s)
{
    fvi_stepper *fork = NULL;
    int status = fvi_stepper_copy(s, &fork);
    if (!status && o->has_infinite_force) {
        status = read_mean_acceleration(o, fork);
    } else if (!status) {
        status = fvi_stepper_step(fork);
        if (!status)
            status = fvi_variable_step_acceleration(fork, 0, o->a);
    }
    fvi_stepper_free(fork);
    return status;
}

int fvi_observer_read_all(fvi_observer *o, const fvi_stepper *s, double t, fvi_observation *now)
{
    *now = (fvi_observation){ .t = t,
                              .v = o->v,
                              .a = o->a,
                              .F = o->F,
                              .force = o->force,
                              .impulse = o->impulse_now,
                              .work = o->work_now,
                              .multiplier = o->force + o->forces + o->slopes,
                              .contact = o->contact,
                              .is_mean = o->is_infinite && t == 0 };
    now->event = fvi_stepper_events(s, &now->events);
    while (now->events > 0 && now->event[now->events - 1].t > t)
        now->events--;
    int status = read_state(o, s, t, now);
    if (!status && o->is_summed)
        status = read_sums(o, s, t, now);
    if (!status
        && o->wanted & (FVI_OBSERVE_FORCE | FVI_OBSERVE_ACCELERATION
                        | FVI_OBSERVE_MULTIPLIER))
        status = read_forces(o, s, t, now);
    if (!status && t == 0 && o->has_mechanism && o->wanted & FVI_OBSERVE_ACCELERATION
        && s->mechanism->m > s->mechanism->permanent)
        status = read_start_at_contact(o, s);
    if (!status && o->wanted & (FVI_OBSERVE_WORK | FVI_OBSERVE_ENERGY))
        status = read_balance(o, s, t, now);
    if (!status && o->contact)
        status = read_contacts(o, s, t);
    if (o->has_massless && fvi_short_row(&o->short_rows, s->k))
        memcpy(o->v, fvi_short_row(&o->short_rows, s->k) + o->forces, o->d * sizeof *o->v);
    if (o->has_massless && t == 0)
        fvi_observer_put_massless(o, s, o->v);
    return status || is_finite(o, now) ? status : FVI_EOVRFLW;
}

int fvi_observer_read(fvi_observer *o, const fvi_stepper *s, double t,
                      fvi_observation *now)
{
    if (!o || !s || !now)
        FVI_FAIL("null pointer", FVI_EFAULT);
    const int status = fvi_observer_read_all(o, s, t, now);
    reduce_to_multipliers(o, o->force);
    reduce_to_multipliers(o, o->impulse_now);
    return status;
}
