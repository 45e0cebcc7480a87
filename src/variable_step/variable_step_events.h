/* src/variable_step/variable_step_events.h -- What a run with variable steps keeps of its events.     [H 22]
 *
 * Internal. variable_step_events.c ends a step at an event, and variable_step_impact.c has what the event does. */
#ifndef FVI_VARIABLE_STEP_EVENTS_H
#define FVI_VARIABLE_STEP_EVENTS_H

#include <fvi/events.h>
#include "variable_step.h"

/* What a run with events knows of them, one number of each event:
 *
 *   side      the sign of z before it passes 0, or 0: not yet known
 *   size      the largest |z| so far
 *   rounding  |z| where it was last made 0
 *   has_hit   nonzero in the step after its impact
 *   theta     where in the step that is tried it passes 0, or INFINITY
 *   behind    on which side of 0 it is behind that
 *   closed    of a contact the side on which its body rests, or 0: it is open
 *   is_new    nonzero of a contact that has just closed, until it is known whether it pushes: 1 where an impact
 *             has been noted, 2 where nothing has
 *   z         of each stage of that step, event by event; of a closed contact the force that pushes
 *   point     6 d numbers: x, p; the normal and v; both shortly before */
typedef struct fvi_event_watch {
    size_t count;
    double *side, *size, *rounding, *has_hit, *theta, *behind, *closed, *is_new, *z, *point;
    int is_ready; /* nonzero once the sides at the start are known */
    int at_rest;  /* nonzero if the step ends where a hop is too short for steps */
    int is_over;
    int is_released; /* nonzero if a contact has opened where the step begins, which is to be tried anew */
    double rest; /* a hop no higher than this ends at rest; 0: than the tolerance of a step */
    fvi_event_time *times;
    size_t happened, room;
} fvi_event_watch;

/* fvi_variable_step_velocities_jump -- are there impulses of the force, or impacts among the events of the run?
 * fvi_variable_step_begin_events, _copy_events, _free_events -- o->watch, NULL where nothing is watched.
 * FVI_ENOMEM.
 * fvi_variable_step_archive_events -- as fvi_method has it, of o->watch; s->t is read already. FVI_EINVAL if what
 * comes back is no watch of this run.
 * fvi_variable_step_room_for_times -- room for so many times in w->times. FVI_ENOMEM.
 * fvi_variable_step_end_at_event -- the step that has been tried ends at its first event: it is solved
 * again with such a length. Returns what fvi_variable_step_solve or a function of an event does, and
 * FVI_EOVRFLW where a z is not finite.
 * fvi_variable_step_outside -- the sign of z where a body is that starts on the wall: 1, or -1 if z acts as it rises.
 * fvi_variable_step_check_walls -- FVI_EINVAL if a body starts on a wall and moves into it; what a gradient returns.
 * fvi_variable_step_act -- behind that step, what its events do; how the next one begins. */
int fvi_variable_step_velocities_jump(const fvi_run *run);
int fvi_variable_step_begin_events(const fvi_run *run, fvi_variable_step_state *o);
int fvi_variable_step_copy_events(const fvi_event_watch *from, fvi_variable_step_state *o);
int fvi_variable_step_archive_events(const fvi_stepper *s, fvi_variable_step_state *o, fvi_archive *v);
int fvi_variable_step_room_for_times(fvi_event_watch *w, size_t count);
void fvi_variable_step_free_events(fvi_event_watch *w);
int fvi_variable_step_end_at_event(fvi_stepper *s, fvi_variable_step_state *o);
double fvi_variable_step_outside(const fvi_event *e);
int fvi_variable_step_check_walls(fvi_stepper *s, fvi_variable_step_state *o);
int fvi_variable_step_act(fvi_stepper *s, fvi_variable_step_state *o);

/* ---- variable_step_contact.c ---- */

/* fvi_variable_step_close_contact -- contact i closes at the end of the last step: from here on Z = 0, and the
 * momentum that is against it goes. fvi_variable_step_open_contact -- it opens there; noted unless it is_new.
 * fvi_variable_step_open_tensile_contacts -- before p += factor J: contacts under tension open.
 * fvi_variable_step_start_contacts -- where a body starts at Z = 0 without a speed of Z the contact is closed.
 * fvi_variable_step_check_contacts -- where forces or velocities have jumped: contacts under tension in the
 * next step open, and others that are new are noted as at rest. It tries a step, or several.
 * fvi_variable_step_normal_force -- the force of a closed contact at theta of the step that has been tried; > 0 pushes.
 * fvi_variable_step_find_lift_off -- where in that step it passes 0, to theta: 0 if it never pushes there. */
int fvi_variable_step_close_contact(fvi_stepper *s, fvi_variable_step_state *o, size_t i);
int fvi_variable_step_open_contact(fvi_stepper *s, fvi_variable_step_state *o, size_t i);
int fvi_variable_step_open_tensile_contacts(fvi_stepper *s, fvi_variable_step_state *o, const double *J,
                                            double factor);
int fvi_variable_step_start_contacts(fvi_stepper *s, fvi_variable_step_state *o);
int fvi_variable_step_check_contacts(fvi_stepper *s, fvi_variable_step_state *o);
double fvi_variable_step_normal_force(const fvi_stepper *s, const fvi_variable_step_state *o, size_t i,
                                      double theta);
void fvi_variable_step_find_lift_off(const fvi_stepper *s, const fvi_variable_step_state *o, size_t i);

/* fvi_variable_step_note_event -- the time is noted. FVI_ENOMEM.
 * fvi_variable_step_speed_of_event -- n . v + dz/dt, at which z changes; to normal n, and of a mechanism v behind
 * it. Returns what the functions do; FVI_EOVRFLW. */
int fvi_variable_step_note_event(fvi_event_watch *w, fvi_event_time at);
int fvi_variable_step_speed_of_event(const fvi_stepper *s, size_t i, double t, const double *x,
                                     const double *p, double *normal, double *speed);

/* fvi_variable_step_sides -- all z where the stepper stands. A side that is not known is that of its z;
 * with `anew`, as p has jumped, so are those of events that are no impact of this moment. Returns what
 * a function of an event does, and FVI_EOVRFLW where a z is not finite. */
int fvi_variable_step_sides(const fvi_stepper *s, fvi_event_watch *w, int anew);

/* fvi_event_sign -- the sign of a z of event i, or 0 where rounding may have made it.
 * fvi_event_within -- z of event i at t + theta h of the step that has been tried. Returns as _sides. */
double fvi_event_sign(const fvi_event_watch *w, size_t i, double z);
int fvi_event_within(const fvi_stepper *s, const fvi_variable_step_state *o, size_t i, double theta,
                     double *z);

/* fvi_event_places_of -- where z of event i is known in the step that has been tried, in the order of theta: at each
 * stage but the first, and where between two of them it has come through 0 and turned back. Returns as _sides. */
enum { FVI_EVENT_PLACES = 2 * FVI_LANES + 2 };
typedef struct {
    size_t count;
    double theta[FVI_EVENT_PLACES], z[FVI_EVENT_PLACES];
} fvi_event_places;
int fvi_event_places_of(const fvi_stepper *s, const fvi_variable_step_state *o, size_t i,
                        fvi_event_places *places);

#endif
