/* src/variable_step/variable_step_contact.c -- Contacts: a body rests on a surface, slides, and lifts off. [H 29, 22]
 *
 * While a contact is closed, its Z = 0 is a constraint, and the multiplier of the constraint is the force of the
 * surface. The contact opens where the surface would have to pull. */
#include "variable_mechanism.h"
#include "variable_step_events.h"

#include "system/fail.h"
#include "system/larger.h"

#include <math.h>
#include <stdint.h>

int fvi_variable_step_close_contact(fvi_stepper *s, fvi_variable_step_state *o, size_t i)
{
    fvi_event_watch *w = o->watch;
    w->closed[i] = w->side[i] != 0 ? w->side[i] : fvi_variable_step_outside(&s->run.events[i]);
    w->side[i] = w->closed[i];
    int status = fvi_mechanism_close_contact(s, o->t, o->y, i);
    if (!status)
        status = fvi_mesh_jump(s, o, s->p, 0);
    o->first_after_event = 1;
    o->next_exponent = o->first_exponent;
    return status;
}

/* A hop lower than the error of a step counts as z = 0, so `rounding` is set to this height. */
int fvi_variable_step_open_contact(fvi_stepper *s, fvi_variable_step_state *o, size_t i)
{
    fvi_event_watch *w = o->watch;
    const fvi_mechanism_state *of = s->mechanism;
    const double *normal = of->C + fvi_mechanism_row_of_contact(of, i) * of->d;
    const int is_new = w->is_new[i] != 0;
    w->rounding[i] = o->allowed * largest_abs(of->d, normal) / 4;
    w->side[i] = w->closed[i];
    w->closed[i] = w->is_new[i] = 0;
    w->has_hit[i] = 1;
    o->first_after_event = 1;
    o->next_exponent = o->first_exponent;
    const int status = fvi_mechanism_open_contact(s, o->t, o->y, i);
    return status || is_new
               ? status
               : fvi_variable_step_note_event(w, (fvi_event_time){ o->t, i, .lifts_off = 1 });
}

int fvi_variable_step_open_tensile_contacts(fvi_stepper *s, fvi_variable_step_state *o, const double *J,
                                            double factor)
{
    int status = FVI_SUCCESS;
    while (o->watch && o->mechanism && !status) {
        size_t i;
        status = fvi_mesh_find_tensile_contact(s, o, J, factor, o->watch->closed, &i);
        if (status || i == SIZE_MAX)
            break;
        status = fvi_variable_step_open_contact(s, o, i);
    }
    return status;
}

/* Try a step from here that will not be taken, because its stages tell how strongly the closed contacts push. */
static int try_first_step(fvi_stepper *s, fvi_variable_step_state *o)
{
    enum { SHORTER = 20 };
    double h = fmin(exp(fvi_variable_spacing() * o->first_exponent), fvi_variable_step_next_event(o) - o->t), error;
    int status = h > 0 ? FVI_SUCCESS : FVI_EMAXITER;
    for (int i = 0; i < SHORTER && h > 0; i++, h /= 4) {
        status = fvi_variable_step_try(s, o, (fvi_length){ h, FVI_OFF_LATTICE }, &error);
        if (status != FVI_EMAXITER && status != FVI_ESING)
            return status;
    }
    return status;
}

/* Return the contact with the largest tension at the beginning of the tried step; SIZE_MAX if no contact is under
 * tension. */
static size_t find_tensile_contact(const fvi_stepper *s, const fvi_variable_step_state *o)
{
    const fvi_mechanism_state *of = s->mechanism;
    double worst = 0;
    size_t which = SIZE_MAX;
    for (size_t l = of->permanent; l < of->m; l++) {
        const size_t i = of->contact[l - of->permanent];
        const double tension = -fvi_variable_step_normal_force(s, o, i, 0);
        if (tension > worst && tension > fvi_mesh_contact_noise(s, o, l)) {
            worst = tension;
            which = i;
        }
    }
    return which;
}

/* Record a rest at each new contact, because it is closed and pushes. */
static int mark_resting_contacts(const fvi_stepper *s, fvi_event_watch *w)
{
    int status = FVI_SUCCESS;
    for (size_t i = 0; i < w->count && !status; i++) {
        if (w->is_new[i] == 2)
            status = fvi_variable_step_note_event(w, (fvi_event_time){ s->t, i, .at_rest = 1 });
        for (size_t n = w->happened; n-- > 0 && w->is_new[i] == 1;)
            if (w->times[n].event == i) {
                w->times[n].at_rest = 1;
                break;
            }
        w->is_new[i] = 0;
    }
    return status;
}

int fvi_variable_step_check_contacts(fvi_stepper *s, fvi_variable_step_state *o)
{
    const fvi_length length = o->length;
    int status = FVI_SUCCESS;
    while (o->mechanism && s->mechanism->m > s->mechanism->permanent && !status) {
        status = try_first_step(s, o);
        if (status == FVI_EMAXITER || status == FVI_ESING) { /* the next step will report why */
            status = FVI_SUCCESS;
            break;
        }
        const size_t i = status ? SIZE_MAX : find_tensile_contact(s, o);
        if (i == SIZE_MAX)
            break;
        status = fvi_variable_step_open_contact(s, o, i);
    }
    o->length = length;
    o->powers_known = 0; /* the trial has overwritten the powers */
    return status ? status : mark_resting_contacts(s, o->watch);
}

int fvi_variable_step_start_contacts(fvi_stepper *s, fvi_variable_step_state *o)
{
    fvi_event_watch *w = o->watch;
    int status = FVI_SUCCESS;
    for (size_t i = 0; w && i < w->count && !status; i++) {
        const fvi_event *e = &s->run.events[i];
        double z, speed, *normal = w->point + 2 * o->d;
        if (e->action != FVI_EVENT_CONTACT
            || e->value(s->t, o->d, s->x, s->p, e->params, &z) || z != 0)
            continue;
        status = fvi_variable_step_speed_of_event(s, i, s->t, s->x, s->p, normal, &speed);
        const double size = largest_abs(o->d, normal) * largest_abs(o->d, o->v);
        if (status || fabs(speed) > 1e-12 * size)
            continue;
        status = fvi_variable_step_close_contact(s, o, i);
        w->is_new[i] = 2;
    }
    return status || !w ? status : fvi_variable_step_check_contacts(s, o);
}

double fvi_variable_step_normal_force(const fvi_stepper *s, const fvi_variable_step_state *o, size_t i,
                                      double theta)
{
    const size_t row = fvi_mechanism_row_of_contact(s->mechanism, i);
    return -o->watch->closed[i] * fvi_mesh_contact_force(s, o, row, theta);
}

/* Compute the force at t = 0, where no step has been made yet, by a first step of a copy. */
static int force_of_first_step(const fvi_stepper *s, size_t i, double *force)
{
    fvi_stepper *fork = NULL;
    int status = fvi_stepper_copy(s, &fork);
    if (!status)
        status = fvi_stepper_step(fork);
    if (!status)
        status = fvi_stepper_contact_force(fork, i, 0, force);
    fvi_stepper_free(fork);
    return status;
}

int fvi_stepper_contact_force(const fvi_stepper *s, size_t i, double t, double *force)
{
    if (!s || !force)
        FVI_FAIL("null pointer", FVI_EFAULT);
    const fvi_mechanism_state *of = s->mechanism;
    if (s->method->scheme != FVI_SCHEME_VARIABLE_STEP || !of)
        FVI_FAIL("not a stepper of fvi_variable_step with a mechanism", FVI_EUNSUP);
    if (i >= s->run.event_count || s->run.events[i].action != FVI_EVENT_CONTACT)
        FVI_FAIL("there is no such contact", FVI_EINVAL);
    const fvi_variable_step_state *o = s->method_state;
    if (!(t >= (s->t == 0 ? 0 : o->t0) && t <= s->t))
        FVI_FAIL("the time is not within the last step", FVI_EDOM);
    *force = 0;
    if (s->t == 0)
        return o->watch->closed[i] != 0 ? force_of_first_step(s, i, force) : FVI_SUCCESS;
    for (size_t l = of->permanent; l < of->last_m; l++)
        if (of->last_contact[l - of->permanent] == i)
            *force = fabs(fvi_mesh_multiplier(s, l, t));
    return FVI_SUCCESS;
}
