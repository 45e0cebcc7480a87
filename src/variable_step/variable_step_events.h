/* src/variable_step/variable_step_events.h -- The events of a run with variable steps. [H 22]
 *
 * Internal to the library. variable_step_events.c ends a step at an event, variable_step_places.c finds where z turns
 * back beyond 0, variable_step_impact.c carries an event out, and variable_step_contact.c closes and opens contacts. z
 * is the function of an event, which happens where z passes 0. */
#ifndef FVI_VARIABLE_STEP_EVENTS_H
#define FVI_VARIABLE_STEP_EVENTS_H

#include <fvi/events.h>
#include "variable_step.h"

/* The events of a run, one number of each array for each event:
 *
 *   side      the sign of z before it passes 0, or 0 if it is not known yet
 *   size      the largest |z| so far
 *   rounding  |z| at the last time when a step ended at z = 0
 *   has_hit   nonzero in the step after the impact of the event
 *   theta     where z passes 0 in the step that is tried, in units of the step, or INFINITY
 *   behind    the sign of z behind that place
 *   closed    for a contact: the side on which its body rests, or 0 if the contact is open
 *   is_new    for a contact that has just closed: nonzero until it is known whether it pushes; 1 if its impact has been
 *             recorded, 2 if nothing has been recorded
 *   z         z at each stage of the step that is tried, event after event; for a closed contact the force that pushes
 *   point     room of 6 d numbers: x and p; the normal and v; both shortly before */
typedef struct fvi_event_watch {
    size_t count;
    double *side, *size, *rounding, *has_hit, *theta, *behind, *closed, *is_new, *z, *point;
    int is_ready; /* nonzero once the sides at the start are known */
    int at_rest;  /* nonzero if the step ends where a hop is too short for steps */
    int is_over;
    int is_released; /* nonzero if a contact has opened at the beginning of the step, which must be tried again */
    double rest; /* a body that would rise no higher is at rest; 0: no higher than the tolerance of a step */
    fvi_event_time *times;
    size_t happened, room;
} fvi_event_watch;

/* fvi_variable_step_velocities_jump -- return nonzero if the force has impulses, or an event of the run is an impact or
 * a contact.
 *
 * fvi_variable_step_begin_events, _copy_events -- allocate o->watch; NULL for a run without events. Free it with
 * fvi_variable_step_free_events. Returns FVI_SUCCESS or FVI_ENOMEM.
 *
 * fvi_variable_step_archive_events -- serialise o->watch as fvi_method demands. s->t must be known before. Returns
 * FVI_SUCCESS; FVI_EINVAL if the archive holds no state of this run; FVI_ENOMEM; or the code of the archive.
 *
 * fvi_variable_step_room_for_times -- make room for `count` times in w->times. Returns FVI_SUCCESS or FVI_ENOMEM.
 *
 * fvi_variable_step_end_at_event -- end the step that has been tried at its first event: solve it again with the length
 * up to the event. Returns FVI_SUCCESS; FVI_EINVAL if an event has ended the run; FVI_EOVRFLW if a z is not finite; the
 * codes of fvi_variable_step_try and of the functions of the events.
 *
 * fvi_variable_step_outside -- return the sign of z on the side of a body that starts on the wall: 1, or -1 if the
 * event happens when z rises.
 *
 * fvi_variable_step_check_walls -- return FVI_EINVAL if a body starts on a wall and moves into it; FVI_SUCCESS
 * otherwise; or the codes of fvi_variable_step_speed_of_event.
 *
 * fvi_variable_step_handle_events -- carry out the events at the end of the last step, and prepare the next step.
 * Returns FVI_SUCCESS; FVI_ENOMEM; FVI_ESING if the normal of an impact is 0; FVI_EOVRFLW; the codes of a mechanism and
 * of the functions of the events. */
int fvi_variable_step_velocities_jump(const fvi_run *run);
int fvi_variable_step_begin_events(const fvi_run *run, fvi_variable_step_state *o);
int fvi_variable_step_copy_events(const fvi_event_watch *from, fvi_variable_step_state *o);
int fvi_variable_step_archive_events(const fvi_stepper *s, fvi_variable_step_state *o, fvi_archive *v);
int fvi_variable_step_room_for_times(fvi_event_watch *w, size_t count);
void fvi_variable_step_free_events(fvi_event_watch *w);
int fvi_variable_step_end_at_event(fvi_stepper *s, fvi_variable_step_state *o);
double fvi_variable_step_outside(const fvi_event *e);
int fvi_variable_step_check_walls(fvi_stepper *s, fvi_variable_step_state *o);
int fvi_variable_step_handle_events(fvi_stepper *s, fvi_variable_step_state *o);

/* ---- variable_step_contact.c ---- */

/* fvi_variable_step_close_contact -- close contact i at the end of the last step: from now on Z = 0 is a constraint,
 * and the part of the momentum that violates it is removed.
 *
 * fvi_variable_step_open_contact -- open contact i there. Record the time unless is_new[i] is nonzero.
 *
 * fvi_variable_step_open_tensile_contacts -- open the contacts that would be under tension after p += factor J. Call it
 * before p changes.
 *
 * fvi_variable_step_start_contacts -- close each contact of a body that starts at Z = 0 while Z has no speed.
 *
 * fvi_variable_step_check_contacts -- after a jump of forces or velocities: open the contacts that would be under
 * tension in the next step, and record a rest at the other new ones. It tries one or several steps.
 *
 * fvi_variable_step_normal_force -- return the force of a closed contact at theta of the step that has been tried; > 0
 * if it pushes.
 *
 * The functions with a code return FVI_SUCCESS, or the codes of fvi_variable_step_handle_events. */
int fvi_variable_step_close_contact(fvi_stepper *s, fvi_variable_step_state *o, size_t i);
int fvi_variable_step_open_contact(fvi_stepper *s, fvi_variable_step_state *o, size_t i);
int fvi_variable_step_open_tensile_contacts(fvi_stepper *s, fvi_variable_step_state *o, const double *J,
                                            double factor);
int fvi_variable_step_start_contacts(fvi_stepper *s, fvi_variable_step_state *o);
int fvi_variable_step_check_contacts(fvi_stepper *s, fvi_variable_step_state *o);
double fvi_variable_step_normal_force(const fvi_stepper *s, const fvi_variable_step_state *o, size_t i,
                                      double theta);

/* fvi_variable_step_note_event -- record an event. Returns FVI_SUCCESS or FVI_ENOMEM.
 *
 * fvi_variable_step_speed_of_event -- compute the speed n . v + dz/dt of z.
 *
 *   normal  output of d numbers, n = dz/dx; with a mechanism v stands behind it. So it needs room for 2 d numbers
 *   speed   output
 *
 * Returns FVI_SUCCESS; the codes of the functions; FVI_EOVRFLW if the speed is not finite. */
int fvi_variable_step_note_event(fvi_event_watch *w, fvi_event_time at);
int fvi_variable_step_speed_of_event(const fvi_stepper *s, size_t i, double t, const double *x,
                                     const double *p, double *normal, double *speed);

/* fvi_variable_step_sides -- evaluate all z at the stepper's time. A side that is not known becomes the sign of z.
 * anew: nonzero if p has jumped. Then every side becomes the sign of its z, except the sides of impacts at this time.
 * Returns FVI_SUCCESS; FVI_EOVRFLW if a z is not finite; the code of a function of an event. */
int fvi_variable_step_sides(const fvi_stepper *s, fvi_event_watch *w, int anew);

/* fvi_event_sign -- return the sign of a value z of event i, or 0 if z may be a rounding error.
 *
 * fvi_event_within -- compute z of event i at t + theta h of the step that has been tried. Returns the codes of
 * fvi_variable_step_sides. */
double fvi_event_sign(const fvi_event_watch *w, size_t i, double z);
int fvi_event_within(const fvi_stepper *s, const fvi_variable_step_state *o, size_t i, double theta,
                     double *z);

/* fvi_event_places_of -- list the places in the step that has been tried at which z of event i is known, in the order
 * of theta: all stages but the first, and each place between two stages where z is beyond 0 before it turns back.
 * Returns the codes of fvi_variable_step_sides. */
enum { FVI_EVENT_PLACES = 2 * FVI_LANES + 2 };
typedef struct {
    size_t count;
    double theta[FVI_EVENT_PLACES], z[FVI_EVENT_PLACES];
} fvi_event_places;
int fvi_event_places_of(const fvi_stepper *s, const fvi_variable_step_state *o, size_t i,
                        fvi_event_places *places);

#endif
