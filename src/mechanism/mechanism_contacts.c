/* src/mechanism/mechanism_contacts.c -- The ties of a run: its constraints and its closed contacts.   [H 29]
 *
 * A body that rests on a surface Z = 0 is held there by a constraint. Z keeps the value at which the contact has
 * closed, which is 0 up to rounding errors, or smaller than the error of a step. This constraint is one more row behind
 * the constraints of the run. */
#include "mechanism_state.h"

#include "system/archive_pieces.h"
#include "system/fail.h"

#include <float.h>
#include <math.h>
#include <string.h>

static const fvi_constraints *constraints_of(const fvi_stepper *s)
{
    return s->run.system->mechanism->constraints;
}

/* Return the contact of row l. */
static const fvi_event *contact_of(const fvi_stepper *s, size_t l)
{
    const fvi_mechanism_state *o = s->mechanism;
    return &s->run.events[o->contact[l - o->permanent]];
}

size_t fvi_mechanism_contact_count(const fvi_run *run)
{
    size_t n = 0;
    for (size_t i = 0; i < run->event_count; i++)
        n += run->events[i].action == FVI_EVENT_CONTACT;
    return n;
}

int fvi_mechanism_tie_values(const fvi_stepper *s, double t, const double *x, double *c)
{
    const fvi_mechanism_state *o = s->mechanism;
    const fvi_constraints *own = constraints_of(s);
    int status = o->permanent ? own->value(t, o->d, x, own->params, c) : FVI_SUCCESS;
    for (size_t l = o->permanent; l < o->m && !status; l++) {
        const fvi_event *e = contact_of(s, l);
        status = e->value(t, o->d, x, s->p, e->params, &c[l]);
        c[l] -= o->level[l];
    }
    return status;
}

int fvi_mechanism_contact_increments(const fvi_stepper *s, const double *u, size_t i, const double *C,
                                     double *c)
{
    const fvi_mechanism_state *o = s->mechanism;
    const double t = fvi_mechanism_stage_time(s, i);
    int status = FVI_SUCCESS;
    for (size_t l = o->permanent; l < o->m && !status; l++) {
        const fvi_event *e = contact_of(s, l);
        const double *first = o->C + l * o->d, *last = C + l * o->d;
        double *unused = o->room + o->m * o->d, before, behind, sum, first_order, bend, size = 0;
        status = e->gradient(o->t, o->d, s->x, e->params, unused, &before);
        if (!status)
            status = e->gradient(t, o->d, o->X + i * o->d, e->params, unused, &behind);
        if (status)
            return status;
        const double step = o->rule->c[i] * o->h;
        sum = step * (before + behind) / 2;
        first_order = fabs(step * before);
        bend = fabs(step * (behind - before));
        for (size_t j = 0; j < o->d; j++) {
            const double more = fvi_mechanism_increment(o, u, i, j);
            sum += more * (first[j] + last[j]) / 2;
            first_order += fabs(more * first[j]);
            bend += fabs(more * (last[j] - first[j]));
            size += fabs(first[j] * s->x[j]);
        }
        const double least = DBL_EPSILON * size;
        if (fabs(sum - c[l]) <= 8 * least && bend * bend <= least * first_order / 64)
            c[l] = sum;
    }
    return status;
}

int fvi_mechanism_tie_gradients(const fvi_stepper *s, double t, const double *x, double *C,
                                double *ct)
{
    const fvi_mechanism_state *o = s->mechanism;
    const fvi_constraints *own = constraints_of(s);
    int status = o->permanent ? own->gradient(t, o->d, x, own->params, C, ct) : FVI_SUCCESS;
    for (size_t l = o->permanent; l < o->m && !status; l++) {
        const fvi_event *e = contact_of(s, l);
        double rate;
        status = e->gradient(t, o->d, x, e->params, C + l * o->d, &rate);
        if (ct)
            ct[l] = rate;
    }
    return status;
}

int fvi_mechanism_tie_hessians(const fvi_stepper *s, double t, const double *x,
                               const double *factor, double *H)
{
    const fvi_mechanism_state *o = s->mechanism;
    const fvi_constraints *own = constraints_of(s);
    int status = o->permanent ? own->hessian(t, o->d, x, factor, own->params, H) : FVI_SUCCESS;
    for (size_t l = o->permanent; l < o->m && !status; l++) {
        const fvi_event *e = contact_of(s, l);
        if (e->hessian)
            status = e->hessian(t, o->d, x, factor[l], e->params, H);
    }
    return status;
}

/* ---- closed contacts ---- */

void fvi_mechanism_keep_contacts(fvi_mechanism_state *o)
{
    o->last_m = o->m;
    memcpy(o->last_contact, o->contact, (o->most - o->permanent) * sizeof *o->contact);
}

void fvi_mechanism_swap_contacts(fvi_mechanism_state *o)
{
    const size_t m = o->m;
    o->m = o->last_m;
    o->last_m = m;
    for (size_t i = 0; i < o->most - o->permanent; i++) {
        const size_t contact = o->contact[i];
        o->contact[i] = o->last_contact[i];
        o->last_contact[i] = contact;
    }
}

size_t fvi_mechanism_row_of_contact(const fvi_mechanism_state *o, size_t event)
{
    size_t l = o->permanent;
    while (l < o->m && o->contact[l - o->permanent] != event)
        l++;
    return l;
}

/* Set the number of unknowns and the rows of C after the number of ties has changed. */
static int follow_contacts(fvi_stepper *s, double t, const double *x)
{
    fvi_mechanism_state *o = s->mechanism;
    o->n = o->s * (o->d + o->m);
    for (size_t l = o->permanent; l < o->most; l++)
        o->begun[l] = o->ended[l] = o->tie[l] = 0;
    return fvi_mechanism_tie_gradients(s, t, x, o->C, NULL);
}

int fvi_mechanism_close_contact(fvi_stepper *s, double t, const double *x, size_t event)
{
    fvi_mechanism_state *o = s->mechanism;
    const fvi_event *e = &s->run.events[event];
    const int status = e->value(t, o->d, x, s->p, e->params, &o->level[o->m]);
    o->contact[o->m++ - o->permanent] = event;
    return status ? status : follow_contacts(s, t, x);
}

int fvi_mechanism_open_contact(fvi_stepper *s, double t, const double *x, size_t event)
{
    fvi_mechanism_state *o = s->mechanism;
    size_t l = fvi_mechanism_row_of_contact(o, event);
    for (o->m--; l < o->m; l++) {
        o->contact[l - o->permanent] = o->contact[l + 1 - o->permanent];
        o->level[l] = o->level[l + 1];
    }
    return follow_contacts(s, t, x);
}

/* Return 1 if these contacts can be closed at the same time. */
static int has_possible_contacts(const fvi_stepper *s, size_t m, const size_t *contact)
{
    const fvi_mechanism_state *o = s->mechanism;
    if (m < o->permanent || m > o->most)
        return 0;
    for (size_t i = 0; i < m - o->permanent; i++) {
        if (contact[i] >= s->run.event_count
            || s->run.events[contact[i]].action != FVI_EVENT_CONTACT)
            return 0;
        for (size_t j = 0; j < i; j++)
            if (contact[i] == contact[j])
                return 0;
    }
    return 1;
}

int fvi_mechanism_serialize_contacts(fvi_stepper *s, fvi_archive *v)
{
    fvi_mechanism_state *o = s->mechanism;
    const int status = FVI_SERIALIZE(v, FVI_STATE(o->m), FVI_STATE(o->last_m),
                                     FVI_STATES(o->contact, 2 * (o->most - o->permanent)));
    if (!status
        && !(has_possible_contacts(s, o->m, o->contact)
             && has_possible_contacts(s, o->last_m, o->last_contact)))
        FVI_FAIL("not a state of this run", FVI_EINVAL);
    o->n = o->s * (o->d + o->m);
    return status;
}
