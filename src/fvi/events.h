/* src/fvi/events.h -- Events of a run: marks, stops, impacts and contacts.             [H 22]
 *
 *     static int height(double t, size_t d, const double *x, const double *p, void *params, double *z)
 *     {
 *         (void)t, (void)d, (void)p, (void)params;   // not used
 *         *z = x[0];
 *         return 0;
 *     }
 *     static int upwards(double t, size_t d, const double *x, void *params, double *normal, double *rate)
 *     {
 *         (void)t, (void)d, (void)x, (void)params;   // not used
 *         normal[0] = 1;   // dz/dx, one number for each coordinate
 *         *rate = 0;       // dz/dt: the floor does not move
 *         return 0;
 *     }
 *     const fvi_event floor = { .value = height, .gradient = upwards, .action = FVI_EVENT_IMPACT,
 *                               .restitution = 0.8 };
 *     run.events = &floor;
 *     run.event_count = 1;
 *     while (s->k < run.steps && !fvi_stepper_is_over(s) && !(status = fvi_stepper_step(s)))
 *         ;
 *
 * An event happens when a function z(t, x, p) passes 0. fvi_variable_step, the only method that takes events, shortens
 * its step until z is 0 at the end of the step. The length of the step is the unknown, and the method solves the step
 * again for each length that it tries. Then, between two steps, the event acts.
 *
 * A **mark** notes the time, and a **stop** ends the run.
 *
 * At an **impact** with the restitution e the momentum jumps along the normal n = dz/dx. With v = M^-1 p, M the masses,
 *
 *     p -> p - (1 + e) n (n . v + dz/dt) / (n . M^-1 n)
 *
 * The speed n . v + dz/dt, at which z changes, is then -e times what it was. For example, a ball with m = 1 that falls
 * with p = -2 onto z = x leaves with p = 1.6 for e = 0.8. Positions and memory stay as they are, and the memory sees
 * the new velocity in the steps that follow. For alpha = 1 the mass of a damped coordinate is m + rho, as everywhere
 * (19.5). With a Lagrangian v follows from L_v = p, and the factor of n is such that n . v + dz/dt becomes -e times
 * what it was; for L quadratic in v this is the formula above with M = L_vv (29.20). Constraints answer with impulses
 * of their own, so that v keeps to them (29.22). An impact after which the body is at rest ends the run.
 *
 * A **contact** is an impact after which the run goes on. Where the body comes to rest, z = 0 becomes a constraint of
 * the system's mechanism (dampers.h). The body may slide along the surface, and the surface pushes with the multiplier
 * of the constraint as its force. The body lifts off when this force would have to pull, because another force pulls
 * the body away, or because the surface moves away. For example, a body with m = g = 1 on z = x, under the force
 * 2 sin t, lifts off at sin t = 1/2. Memories stay as they are. An impulse that pushes the body into the surface is
 * taken by the surface. An impulse that pulls the body off opens the contact, also if it comes from another wall. A
 * system without dampers and constraints takes contacts if it has a mechanism that is all zeros. */
#ifndef FVI_EVENTS_H
#define FVI_EVENTS_H

#include "trajectory.h"

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(default)

/* What happens. MARK: the time is noted. STOP: the run ends. IMPACT: the momentum jumps. CONTACT: the momentum jumps,
 * and a body that comes to rest stays on the surface. */
typedef enum {
    FVI_EVENT_MARK,
    FVI_EVENT_STOP,
    FVI_EVENT_IMPACT,
    FVI_EVENT_CONTACT
} fvi_event_action;

/* fvi_event -- what is watched, and what happens.
 *
 *   value        writes z at (t, x, p) to *z; returns 0, or a code that ends the step
 *   gradient     for an impact or a contact: writes dz/dx, d numbers, to normal and dz/dt to *rate; else NULL
 *   params       handed to the functions, owned by the caller, may be NULL
 *   direction    1: the event happens when z rises through 0; -1: when z falls; 0: both
 *   action       what happens
 *   restitution  e of an impact or a contact, 0 <= e <= 1
 *   rest         for an impact or a contact: a body that would rise no higher than this after the impact is at rest. It
 *                has the unit of x, finite, >= 0; 0 means the tolerance of a step, or in fvi_solve its tolerance
 *   hessian      for a contact: adds factor times the d * d second derivatives of z by x to H, row by row. NULL for a
 *                surface that is flat, or so little bent that Newton's method converges without it
 *
 * The method learns from the first time with z != 0 on which side of 0 the motion is. So a run that begins with z = 0
 * has no event there.
 *
 * An impact or a contact is a wall. With the direction 0 it keeps a body on the side on which the body begins. With the
 * direction -1 or 1 it stops bodies from one side only. A body that begins on the other side passes the wall once,
 * without an event. If z = 0 at the start, the body is taken to be on the side z > 0, or z < 0 if the direction is 1.
 * If this body would fall into the wall, it is at rest in the first step. If it moves into the wall, fvi_stepper_start
 * refuses it (FVI_EINVAL).
 *
 * If another event at the same time makes p jump, a jump of z through 0 is no event.
 *
 * The method evaluates z at six or eight times in each step, and where |z| is least between them. So it sees a z that
 * passes 0 and turns back, if |z| has only one minimum between two of these times. run.longest makes the steps shorter.
 * A z that goes no farther beyond 0 than the error of the motion may be missed.
 *
 * Cost, seen with one oscillator: a run that watches for an event takes 2 to 4 times as long, and each event that
 * happens costs as much as 10 steps. At most a tenth of this is the search for a z that turns back. */
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

/* fvi_event_has_wall -- return nonzero for an impact or a contact, where the momentum jumps. */
static inline int fvi_event_has_wall(const fvi_event *e)
{
    return e->action == FVI_EVENT_IMPACT || e->action == FVI_EVENT_CONTACT;
}

/* fvi_event_time -- an event that has happened.
 *
 *   t          when
 *   event      which one: its place in run.events
 *   at_rest    nonzero if the body is at rest there
 *   lifts_off  nonzero if the body was in contact and lifts off */
typedef struct {
    double t;
    size_t event;
    int at_rest, lifts_off;
} fvi_event_time;

/* fvi_stepper_events -- return all events of a run so far, in the order of time.
 *
 *   n  output, must not be NULL: how many; 0 for a run without events
 *
 *     size_t n;
 *     const fvi_event_time *event = fvi_stepper_events(s, &n);
 *     for (size_t i = 0; i < n; i++)
 *         printf("%g\n", event[i].t);
 *
 * The array belongs to the stepper, and is valid until its next step. Cost O(1). */
const fvi_event_time *fvi_stepper_events(const fvi_stepper *s, size_t *n);

/* fvi_stepper_is_over -- return nonzero once an event has ended the run: a stop, or an impact that leaves the body at
 * rest.
 *
 * A body is at rest if after the impact it would rise no higher than `rest`, or than the tolerance of a step. So a
 * bouncing ball ends its run after finitely many impacts. The next fvi_stepper_step returns FVI_EINVAL. */
int fvi_stepper_is_over(const fvi_stepper *s);

/* fvi_stepper_contact_force -- compute how strongly the surface of event i, a contact, pushes.
 *
 *   i      the place of the event in run.events
 *   t      s->t, or a time within the last step
 *   force  output, f >= 0: the surface pushes a body on the side z > 0 with f dz/dx, and a body on the other side with
 *          -f dz/dx. So on the side z > 0 the multiplier of the constraint z = 0 is -f, and on the other side f. While
 *          the contact is open, f = 0. For example, f = 1 for a body with the weight 1 that lies on z = x
 *
 *     double force;
 *     status = fvi_stepper_contact_force(s, 0, s->t, &force);
 *
 * Cost O(s^2) for s stages; at t = 0 the cost of a first step, which is made on a copy. Returns FVI_SUCCESS; FVI_EFAULT
 * if s or force is NULL; FVI_EUNSUP for another method or a system without a mechanism; FVI_EINVAL if event i is no
 * contact; FVI_EDOM if t is not within the last step; at t = 0 what fvi_stepper_copy and fvi_stepper_step return. */
int fvi_stepper_contact_force(const fvi_stepper *s, size_t i, double t, double *force);

/* fvi_stepper_kick -- add J to p between two steps of fvi_variable_step, as an impulse of the force does.
 *
 *   J   d finite numbers. With a mechanism v follows from L_v = p, and constraints answer (29.22)
 *
 *     const double J[] = { 0.5 };
 *     status = fvi_stepper_kick(s, J);
 *
 * A run with 1/2 < alpha < 1 must know at its start that velocities will jump, because it then takes shorter steps. It
 * knows so if its force has an impulse, which may be 0, or if one of its events is an impact or a contact.
 * Cost O(d). Returns FVI_SUCCESS; FVI_EFAULT if a pointer is NULL; FVI_EDOM if a number is not finite; FVI_EINVAL for
 * another method, and within a callback of this stepper; FVI_EUNSUP if the run did not know that velocities would jump,
 * if it has a law of damping that grows faster than s, or if J kicks a coordinate without inertia; what the functions
 * of the events, of a mechanism and of matrices return. */
int fvi_stepper_kick(fvi_stepper *s, const double *J);

/* fvi_events_check -- check the events of a run. fvi_stepper_start does so; nobody else needs to.
 *
 *   method, run  as for fvi_stepper_start
 *   error  output, or NULL. Its field is "events", and its index is the place of the event
 *
 * Returns FVI_SUCCESS; FVI_EUNSUP if the method takes no events, if the system has matrices, or if a contact has no
 * mechanism; FVI_EFAULT without an array, a value, or a gradient of an impact or a contact; FVI_EDOM for a restitution
 * outside [0, 1] or a rest that is negative or not finite; FVI_EINVAL for an unknown action. */
int fvi_events_check(const fvi_method *method, const fvi_run *run,
                     fvi_error *error);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
