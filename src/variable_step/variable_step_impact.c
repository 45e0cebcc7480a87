/* src/variable_step/variable_step_impact.c -- Carry an event out. [H 22]
 *
 * The last step has ended at the event (variable_step_events.c). Now a momentum jumps, or the run is over. */
#include "variable_mechanism.h"
#include "variable_step_events.h"

#include "run/run_damper.h"
#include "system/dot.h"
#include "system/fail.h"
#include "system/larger.h"

#include <gsl/gsl_machine.h>
#include <math.h>
#include <stdlib.h>

/* ---- impacts ---- */

/* Return the mass of coordinate j in a jump of the velocity. */
static double mass_in_impact(const fvi_stepper *s, size_t j)
{
    const fvi_variable_step_state *o = s->method_state;
    return o->group[o->group_of[j]].mass;
}

static int apply_impulse(fvi_stepper *s, const double *J, double factor)
{
    fvi_variable_step_state *o = s->method_state;
    const int status = fvi_variable_step_jump(s, o, J, factor);
    for (size_t j = 0; j < o->d && !o->mechanism; j++)
        s->p[j] += o->structure ? factor * J[j]
                                : s->run.system->mass[j] * (factor * J[j] / mass_in_impact(s, j));
    o->first_after_event = 1;
    o->next_exponent = o->first_exponent;
    return status;
}

int fvi_variable_step_room_for_times(fvi_event_watch *w, size_t count)
{
    if (count <= w->room)
        return FVI_SUCCESS;
    const size_t room = 2 * count + 16;
    fvi_event_time *more = realloc(w->times, room * sizeof *more);
    if (!more)
        FVI_FAIL("no memory for the events", FVI_ENOMEM);
    w->times = more;
    w->room = room;
    return FVI_SUCCESS;
}

int fvi_variable_step_note_event(fvi_event_watch *w, fvi_event_time at)
{
    const int status = fvi_variable_step_room_for_times(w, w->happened + 1);
    if (status)
        return status;
    w->times[w->happened++] = at;
    return FVI_SUCCESS;
}

int fvi_variable_step_speed_of_event(const fvi_stepper *s, size_t i, double t, const double *x,
                                     const double *p, double *normal, double *speed)
{
    const fvi_event *e = &s->run.events[i];
    const size_t d = s->run.system->d;
    double sum, *v = normal + d;
    int status = e->gradient(t, d, x, e->params, normal, &sum);
    if (!status && s->mechanism)
        status = fvi_mesh_velocity(s, t, x, p, v);
    for (size_t j = 0; j < d && !status; j++)
        sum += s->mechanism ? normal[j] * v[j] : normal[j] * p[j] / s->run.system->mass[j];
    *speed = status ? 0 : sum;
    return status || isfinite(sum) ? status : FVI_EOVRFLW;
}

/* Compute the acceleration of z towards the forbidden side, from the speeds of z at the end of the step and shortly
 * before. This is right for a wall that moves or is curved, too. */
static int fall_of(const fvi_stepper *s, fvi_variable_step_state *o, size_t i,
                   double speed, double *fall)
{
    double *x = o->watch->point, *p = x + o->d, before;
    const double t = s->t - (s->t - o->t0) / 64;
    int status = fvi_variable_step_dense(s, t, x, p);
    if (!status)
        status = fvi_variable_step_speed_of_event(s, i, t, x, p, x + 4 * o->d, &before);
    if (!status)
        *fall = -o->watch->side[i] * (speed - before) / (s->t - t);
    return status;
}

double fvi_variable_step_outside(const fvi_event *e)
{
    return e->direction > 0 ? -1 : 1;
}

int fvi_variable_step_check_walls(fvi_stepper *s, fvi_variable_step_state *o)
{
    for (size_t i = 0; o->watch && i < o->watch->count; i++) {
        const fvi_event *e = &s->run.events[i];
        double z, speed;
        if (!fvi_event_has_wall(e)
            || e->value(s->t, o->d, s->x, s->p, e->params, &z) || z != 0)
            continue; /* a function that fails here fails in the first step, too */
        const int status = fvi_variable_step_speed_of_event(s, i, s->t, s->x, s->p,
                                                            o->watch->point + 2 * o->d, &speed);
        if (status)
            return status;
        if (speed * fvi_variable_step_outside(e) < 0)
            return fvi_at_index(s->error, i,
                                fvi_fail(s->error, FVI_EINVAL, "events", speed,
                                         "event %zu: starts at Z = 0 and moves into the wall", i));
    }
    return FVI_SUCCESS;
}

//> impact
/* Compute the factor -(1 + e) (n v + dz/dt) / (n M^-1 n) of the normal. If a contact is under tension it opens, which
 * changes M^-1, so the factor is computed again. */
static int factor_of_jump(fvi_stepper *s, fvi_variable_step_state *o, const fvi_event *e,
                          double *normal, double speed, double *jump)
{
    double inverse = 0;
    int status = FVI_SUCCESS;
    for (size_t j = 0; j < o->d && !o->mechanism; j++)
        inverse += normal[j] * normal[j] / mass_in_impact(s, j);
    if (o->mechanism)
        status = fvi_mesh_inverse_along(s, normal, normal + o->d, &inverse);
    if (!status && !(fabs(inverse) > 0))
        FVI_FAIL("the normal of an impact is 0", FVI_ESING);
    *jump = -(1 + e->restitution) * speed / inverse;
    if (status || !o->mechanism)
        return status;
    const size_t m = s->mechanism->m;
    status = fvi_mesh_impact(s, normal, normal + o->d, -(1 + e->restitution) * speed, jump);
    if (!status)
        status = fvi_variable_step_open_tensile_contacts(s, o, normal, *jump);
    return status || m == s->mechanism->m ? status
                                          : factor_of_jump(s, o, e, normal, speed, jump);
}

/* Let p jump to p - (1 + e) n (n v + dz/dt) / (n M^-1 n), if the body comes nearer. *at_rest: nonzero if after it the
 * body would rise no higher, in z, than the height of rest or than the step may err, before it falls back. */
static int apply_impact(fvi_stepper *s, fvi_variable_step_state *o, size_t i, int *at_rest)
{
    const fvi_event *e = &s->run.events[i];
    const fvi_event_watch *w = o->watch;
    double *normal = w->point + 2 * o->d, speed, fall = 0, jump = 0;
    int status = fvi_variable_step_speed_of_event(s, i, s->t, s->x, s->p, normal, &speed);
    if (!status)
        status = fall_of(s, o, i, speed, &fall);
    const int comes_nearer = speed * w->side[i] < 0;
    if (!status && (comes_nearer || speed == 0))
        status = factor_of_jump(s, o, e, normal, speed, &jump);
    if (status)
        return status;
    const double size = fvi_dot(o->d, normal, normal);
    if (comes_nearer)
        status = apply_impulse(s, normal, jump);
    const double after = e->restitution * speed,
                 height = e->rest > 0 ? e->rest : w->rest > 0 ? w->rest : o->allowed;
    *at_rest = fall > 0 && after * after <= 2 * fall * height * sqrt(size);
    return status;
}
//< impact

/* The body stays at the wall: end the run, or close the contact. */
static int rest_at_wall(fvi_stepper *s, fvi_variable_step_state *o, size_t i)
{
    if (s->run.events[i].action == FVI_EVENT_CONTACT)
        return fvi_variable_step_close_contact(s, o, i);
    o->watch->is_over = 1;
    return FVI_SUCCESS;
}

/* Carry out event i, at the end of the step. */
static int handle_event(fvi_stepper *s, fvi_variable_step_state *o, size_t i)
{
    fvi_event_watch *w = o->watch;
    const fvi_event *e = &s->run.events[i];
    int at_rest = 0, status = FVI_SUCCESS;
    if (w->closed[i] != 0)
        return fvi_variable_step_open_contact(s, o, i);
    if (fvi_event_has_wall(e))
        status = apply_impact(s, o, i, &at_rest);
    else
        w->side[i] = w->behind[i]; /* z has passed 0 */
    w->is_over |= e->action == FVI_EVENT_STOP;
    const int may_rest = e->action == FVI_EVENT_CONTACT; /* fvi_variable_step_check_contacts decides whether it rests */
    at_rest |= may_rest && e->restitution == 0;
    if (!status)
        status = fvi_variable_step_note_event(w, (fvi_event_time){ s->t, i, at_rest && !may_rest, 0 });
    w->is_new[i] = at_rest && may_rest;
    return status || !at_rest ? status : rest_at_wall(s, o, i);
}

int fvi_variable_step_handle_events(fvi_stepper *s, fvi_variable_step_state *o)
{
    fvi_event_watch *w = o->watch;
    double first = INFINITY;
    int status = FVI_SUCCESS, jumped = 0;
    for (size_t i = 0; i < w->count; i++)
        first = smaller(first, w->theta[i]);
    for (size_t i = 0; i < w->count && !status; i++) {
        const int is_stuck = w->at_rest && w->has_hit[i] != 0;
        const int happens = first < INFINITY && w->theta[i] - first <= 8 * GSL_DBL_EPSILON;
        w->has_hit[i] = 0;
        if (is_stuck) {
            w->is_new[i] = s->run.events[i].action == FVI_EVENT_CONTACT ? 2 : 0;
            if (w->is_new[i] == 0)
                status = fvi_variable_step_note_event(w, (fvi_event_time){ s->t, i, 1, 0 });
            if (!status)
                status = rest_at_wall(s, o, i);
        } else if (happens) {
            status = handle_event(s, o, i);
            w->has_hit[i] = fvi_event_has_wall(&s->run.events[i]);
            jumped |= w->has_hit[i] != 0;
        }
    }
    for (size_t i = 0; i < w->count; i++) {
        if (jumped && w->theta[i] < INFINITY && w->has_hit[i] == 0)
            w->side[i] = 0; /* the impact at the same time may have changed the side */
        w->theta[i] = INFINITY;
    }
    if (!status && o->first_after_event)
        status = fvi_variable_step_check_contacts(s, o);
    return status ? status : fvi_variable_step_sides(s, w, jumped);
}

/* ---- public functions ---- */

static const fvi_event_watch *watch_of(const fvi_stepper *s)
{
    return s && s->method->scheme == FVI_SCHEME_VARIABLE_STEP && s->method_state
               ? ((const fvi_variable_step_state *)s->method_state)->watch
               : NULL;
}

const fvi_event_time *fvi_stepper_events(const fvi_stepper *s, size_t *n)
{
    const fvi_event_watch *w = watch_of(s);
    *n = w ? w->happened : 0;
    return w ? w->times : NULL;
}

void fvi_variable_step_rest_below(fvi_stepper *s, double height)
{
    fvi_event_watch *w = ((fvi_variable_step_state *)s->method_state)->watch;
    if (w)
        w->rest = height;
}

int fvi_stepper_is_over(const fvi_stepper *s)
{
    const fvi_event_watch *w = watch_of(s);
    return w && w->is_over;
}

/* Return nonzero if the steps and the modes are short enough for a velocity that jumps. They are, if the run knew of
 * jumps when it started. Otherwise no damper may grow faster than s. An exception is the order 2, a mass of each
 * coordinate. */
static int can_apply_impulses(const fvi_stepper *s, const fvi_variable_step_state *o)
{
    int can = 1;
    for (size_t j = 0; j < fvi_run_damper_count(&s->run); j++) {
        const fvi_run_damper of = fvi_run_damper_of(&s->run, j);
        const int acts = o->structure ? of.matrix.history_size > 0 : o->mechanism || o->damped > 0,
                  is_mass = !of.law && of.alpha == 1;
        can = can && (!acts || of.growth <= 1 || is_mass);
    }
    return can || fvi_variable_step_velocities_jump(&s->run);
}

int fvi_stepper_kick(fvi_stepper *s, const double *J)
{
    if (!s || !J)
        FVI_FAIL("null pointer", FVI_EFAULT);
    if (s->is_busy)
        FVI_FAIL("called by a callback of this stepper", FVI_EINVAL);
    if (s->method->scheme != FVI_SCHEME_VARIABLE_STEP)
        FVI_FAIL("not a stepper of fvi_variable_step", FVI_EINVAL);
    if (!fvi_all_finite(s->run.system->d, J))
        FVI_FAIL("J must be finite", FVI_EDOM);
    fvi_variable_step_state *o = s->method_state;
    if (!can_apply_impulses(s, o))
        FVI_FAIL("the run did not know that a velocity would jump", FVI_EUNSUP);
    for (size_t j = 0; j < o->d && s->mechanism; j++)
        if (s->mechanism->is_massless[j] && J[j] != 0)
            FVI_FAIL("a coordinate without inertia takes no kick", FVI_EUNSUP);
    int status = fvi_variable_step_open_tensile_contacts(s, o, J, 1);
    if (!status)
        status = apply_impulse(s, J, 1);
    return !status && o->watch ? fvi_variable_step_sides(s, o->watch, 1) : status;
}
