/* src/fvi/events.h -- Events of a run: impacts, stops, marks.             [H 22]
 *
 *     const fvi_event floor = { .value = height, .gradient = upwards, .action = FVI_EVENT_IMPACT,
 *                               .restitution = 0.8 };
 *     run.events = &floor;
 *     run.event_count = 1;
 *     while (s->k < run.steps && !fvi_stepper_is_over(s) && !(status = fvi_stepper_step(s)))
 *         ;
 *
 * An event is a function z(t, x, p) that passes 0. fvi_variable_step, the only method that takes
 * events, shortens its step until z is 0 at its end: the length of the step is the unknown, and the
 * step is solved again for each length that is tried. Then the event acts, between two steps.
 *
 * At an impact the momentum jumps along the normal n = dz/dx, with v = M^-1 p:
 *
 *     p -> p - (1 + e) n (n . v + dz/dt) / (n . M^-1 n)
 *
 * The speed n . v + dz/dt, at which z changes, is then -e times what it was. Positions and memory stay
 * as they are; the memory sees the new velocity in the steps that follow. For alpha = 1 a damped mass
 * is m + rho, as everywhere (19.5). With a Lagrangian v is that of L_v = p, and the factor of n is such
 * that n . v + dz/dt turns round so: with M = L_vv it is the same formula where L is quadratic in v
 * (29.20). Constraints have impulses of their own, so that v keeps to them (29.22). For example a ball with
 * m = 1 that falls with p = -2 onto z = x leaves with p = 1.6 for e = 0.8.
 *
 * An impact ends the run where the body comes to rest. A contact goes on: z = 0 is then a constraint of the system's
 * mechanism (dampers.h), the body may slide along it, and the surface pushes with the multiplier as its force. Where this
 * force would have to pull the body lifts off: a force pulls, or the surface moves away. For example a body with
 * m = g = 1 on z = x, under the force 2 sin t, lifts off at sin t = 1/2. Memories stay as they are. The surface takes
 * an impulse that pushes the body into it. An impulse that pulls the body opens the contact, also one of another wall. A
 * system without dampers and constraints takes contacts with a mechanism that is all zeros. */
#ifndef FVI_EVENTS_H
#define FVI_EVENTS_H

#include "trajectory.h"

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(default)

/* What happens: of a mark nothing but a note of the time; a stop ends the run; at an impact the momentum jumps, and at a
 * contact, too, where a body that comes to rest stays on the surface. */
typedef enum {
    FVI_EVENT_MARK,
    FVI_EVENT_STOP,
    FVI_EVENT_IMPACT,
    FVI_EVENT_CONTACT
} fvi_event_action;

/* fvi_event -- what is watched.
 *
 *   value        z at a time; returns 0, or a code that ends the step
 *   gradient     of an impact or a contact: dz/dx, d numbers, and dz/dt; else NULL
 *   params       handed to the functions
 *   direction    1: z must rise through 0, -1: fall; 0: either
 *   action       as above
 *   restitution  e of an impact or a contact, 0 <= e <= 1
 *   rest         of either: a body that would rise no higher than this, a length of x, is at rest; 0: the tolerance
 *                of a step, or with a tolerance of fvi_solve that one
 *   hessian      of a contact: adds factor times the d * d second derivatives of z by x to H, row by row; or NULL, of a
 *                surface that is flat, or so little bent that Newton's method does without
 *
 * Which side of 0 the motion is on is known from its first time with z != 0: what begins with z = 0 is
 * no event yet. But a wall stands where an impact or a contact begins: the body is where z > 0, or where z < 0 with the
 * direction 1. A body that lies there and would fall is at rest in the first step, and fvi_stepper_start refuses
 * a body that moves into the wall, with FVI_EINVAL. A jump of p by another event at the same time is no passing of 0.
 *
 * z is evaluated at six or eight times of each step, and where |z| is least between them. So a z that passes 0 and turns
 * back is seen if |z| has one such place between two of these times; run.longest makes the steps shorter. A z that
 * comes no farther beyond 0 than the motion may err is seen or not. Cost, seen with one oscillator: a run takes 2 to 4
 * times as long with an event, and each passing of 0 as long as 10 steps more. Of all this a tenth at most is the
 * search for a z that turns back. */
struct fvi_event {
    int (*value)(double t, size_t d, const double *x, const double *p,
                 void *params, double *z);
    int (*gradient)(double t, size_t d, const double *x, void *params,
                    double *normal, double *rate);
    void *params;
    int direction;
    fvi_event_action action;
    double restitution;
    double rest;
    int (*hessian)(double t, size_t d, const double *x, double factor,
                   void *params, double *H);
};

/* fvi_event_has_wall -- does the momentum jump there? */
static inline int fvi_event_has_wall(const fvi_event *e)
{
    return e->action == FVI_EVENT_IMPACT || e->action == FVI_EVENT_CONTACT;
}

/* fvi_event_time -- what has happened.
 *
 *   t          when
 *   event      which of run.events
 *   at_rest    nonzero if the body is at rest there
 *   lifts_off  nonzero if the body was in contact and lifts off */
typedef struct {
    double t;
    size_t event;
    int at_rest, lifts_off;
} fvi_event_time;

/* fvi_stepper_events -- all events of a run so far, in their order. They belong to the stepper,
 * until its next step. n may not be NULL; of a run without events it becomes 0. Cost O(1). */
const fvi_event_time *fvi_stepper_events(const fvi_stepper *s, size_t *n);

/* fvi_stepper_is_over -- nonzero once an event has ended the run: a stop; or a body that has come to
 * rest at an impact. A body is at rest if the impact leaves it so slow that it would rise no higher than `rest`, or than
 * the tolerance of a step: a bouncing ball ends so after finitely many impacts. The next fvi_stepper_step then
 * returns FVI_EINVAL. */
int fvi_stepper_is_over(const fvi_stepper *s);

/* fvi_stepper_contact_force -- how strongly event i, a contact, pushes.
 *
 *   t      s->t, or a time within the last step
 *   force  output: f >= 0. The surface pushes with f dz/dx a body on the side z > 0, and with -f dz/dx a body on the
 *          other side: f is minus the multiplier of the constraint z = 0, or plus. 0 while the contact is open. For
 *          example 1 for a body of the weight 1 that lies on z = x
 *
 * Cost O(s^2); at t = 0 that of a first step, which is made on a copy. Returns FVI_SUCCESS; FVI_EFAULT; FVI_EUNSUP of
 * another method or a system without a mechanism; FVI_EINVAL if event i is no contact; FVI_EDOM if t is not within the
 * last step; at t = 0 what a step returns. */
int fvi_stepper_contact_force(const fvi_stepper *s, size_t i, double t, double *force);

/* fvi_stepper_kick -- p += J between two steps of fvi_variable_step, as an impulse of the force does.
 *
 *   J   d finite numbers; of a mechanism v follows from L_v = p, and constraints answer (29.22)
 *
 * For alpha > 1/2 a run must know at its start that velocities will jump, as shorter steps follow
 * then: by an impulse of its force, which may be 0, or by an impact or a contact among its events.
 * Returns FVI_SUCCESS; FVI_EFAULT; FVI_EDOM if a number is not finite; FVI_EINVAL of another
 * method, or within a callback; FVI_EUNSUP if the run did not know, or has a law of damping that
 * grows faster than s, or if J kicks a coordinate without inertia. Cost O(d). */
int fvi_stepper_kick(fvi_stepper *s, const double *J);

/* fvi_events_check -- FVI_SUCCESS; or what is wrong, field "events", the index that of the event:
 * FVI_EUNSUP if the method takes none, if the system has matrices, or if a contact has no mechanism; FVI_EFAULT without
 * an array or a function; FVI_EDOM for a restitution that is not in [0, 1] or a rest that is not in [0, infinity);
 * FVI_EINVAL for an unknown action. fvi_stepper_start asks. */
int fvi_events_check(const fvi_method *method, const fvi_run *run,
                     fvi_error *error);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
