/* src/variable_step/variable_step_length.c -- Limit the length of the next step by events and by the force. [H 22] */
#include "variable_step.h"

#include "system/fail.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>

static int compare(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Collect the times at which steps end, in order: the jumps and the impulses of the force within the run, the end of
 * the singular start, and the end of the run. */
int fvi_variable_step_find_events(const fvi_stepper *s, fvi_variable_step_state *o)
{
    const fvi_force *force = &s->run.system->force;
    const size_t hits = force->impulse_count;
    if (force->jump_count > SIZE_MAX / sizeof(double) - 2 - hits)
        FVI_FAIL("jumps must be addressable", FVI_EINVAL);
    o->events = malloc((force->jump_count + hits + 2) * sizeof *o->events);
    if (!o->events)
        FVI_FAIL("no memory for the jumps", FVI_ENOMEM);
    for (size_t i = 0; i < force->jump_count; i++)
        if (force->jumps[i] > 0 && force->jumps[i] < o->T)
            o->events[o->event_count++] = force->jumps[i];
    for (size_t i = 0; i < hits; i++)
        if (force->impulses[i].t > 0 && force->impulses[i].t < o->T)
            o->events[o->event_count++] = force->impulses[i].t;
    if (o->singular.J && o->singular.t1 < o->T)
        o->events[o->event_count++] = o->singular.t1;
    o->events[o->event_count++] = o->T;
    qsort(o->events, o->event_count, sizeof *o->events, compare);
    return FVI_SUCCESS;
}

/* Return the next time at which a step must end. */
double fvi_variable_step_next_event(fvi_variable_step_state *o)
{
    while (o->events[o->event] <= o->t * (1 + 8 * GSL_DBL_EPSILON)
           && o->events[o->event] < o->T)
        o->event++;
    return o->events[o->event];
}

//> length
/* Return h = exp(L k). But the last two steps before an event are equal to the last bit, so they share the matrices and
 * modes that a length off the lattice needs. */
static fvi_length propose_length(const fvi_variable_step_state *o, double event)
{
    const double rest = event - o->t;
    const fvi_length length = { o->next_exponent == o->length.k && o->length.h > 0
                                    ? o->length.h
                                    : exp(fvi_variable_spacing() * o->next_exponent),
                                o->next_exponent };
    if (length.h < rest / 2)
        return length;
    if (length.h >= rest && o->length.k == FVI_OFF_LATTICE
        && fabs(o->length.h - rest) <= 4 * GSL_DBL_EPSILON * event)
        return o->length;
    return (fvi_length){ length.h >= rest ? rest : rest / 2, FVI_OFF_LATTICE };
}
//< length

/* Return k of a length, which may be off the lattice. */
int fvi_variable_step_exponent(fvi_length length)
{
    return length.k != FVI_OFF_LATTICE
               ? length.k
               : (int)floor(log(length.h) / fvi_variable_spacing());
}

/* ---- pulses that a step could pass over ---- */

/* A step as short as this part of the run is taken, whatever the bound of the force says, because a bound may be
 * infinite where the force is finite. */
static const double BLIND = 1e-10;

/* Each step that is clear doubles the number of steps for which the next bounds are computed at once, up to MOST_AHEAD.
 * A step that is not clear becomes shorter by FASTER rungs. */
enum { MOST_AHEAD = 64, FASTER = 3 };

/* Return a bound of F_j minus the best polynomial that the stages integrate exactly, on any interval of length h: half
 * of the range of F_j for a constant; or 2 (h/4)^k |F^(k)| / k! for Chebyshev's polynomial of degree k - 1. (22.24) */
//> hidden
static double hidden_force(const double *most, size_t d, size_t order, double h)
{
    double least = most[0], power = 2;
    for (size_t k = 1; k <= order; k++) {
        power *= h / 4;
        const double rest = power * most[k * d];
        if (rest < least) /* 0 times INFINITY is NaN */
            least = rest;
    }
    return least;
}

/* Return nonzero if the step can hide no pulse: two impulses, of the remainder of F and of the remainder that the
 * stages see, move no coordinate farther than this step may be wrong. (22.25) */
static int is_clear(const fvi_variable_step_state *o, size_t order, double h)
{
    for (size_t j = 0; j < o->d; j++) {
        const fvi_coordinate_group *group = &o->group[o->group_of[j]];
        const double compliance = fvi_variable_step_compliance(o, group),
                     rest = hidden_force(o->most_of_force + j, o->d, order, h);
        if (!(2 * h * rest * compliance <= o->allowed * group->mass))
            return 0;
    }
    return 1;
}
//< hidden

/* Compute the bounds of the force from t to `end`, and decide whether steps of length h are clear there. */
static int check_force_bounds_to(const fvi_stepper *s, fvi_variable_step_state *o, double h,
                      double end, int *clear)
{
    const fvi_force *force = &s->run.system->force;
    const size_t order = 2 * o->rule->s - 2;
    const double in = 4 * GSL_DBL_EPSILON;
    int status = force->bound(o->t + in * fmax(o->t, h), end - in * end, order,
                              o->d, force->params, o->most_of_force);
    *clear = !status && is_clear(o, order, h);
    if (*clear) {
        o->clear_to = end;
        o->clear_h = h;
    }
    return status;
}

/* Decide whether a step of length h is clear. It is, if longer steps are clear in an interval that contains it. */
static int check_force_bounds(const fvi_stepper *s, fvi_variable_step_state *o, double h,
                double event, int *clear)
{
    const double end = o->t + h;
    *clear = end <= o->clear_to && h <= o->clear_h;
    if (*clear)
        return FVI_SUCCESS;
    const double ahead = fmin(o->t + o->ahead * h, event);
    int status = FVI_SUCCESS;
    if (ahead > end)
        status = check_force_bounds_to(s, o, h, ahead, clear);
    o->ahead = *clear ? (int)fmin(2 * o->ahead, MOST_AHEAD) : 1;
    if (!*clear && !status)
        status = check_force_bounds_to(s, o, h, fmin(end, event), clear);
    if (*clear && o->ahead == 1)
        o->ahead = 2;
    return status;
}

int fvi_variable_step_choose(const fvi_stepper *s, fvi_variable_step_state *o, double event,
                        fvi_length *length)
{
    const double part = s->run.step_error > 0 ? FVI_TOLERANCE_LEAST : 1e-10;
    o->allowed = fmax(s->run.step_error, part * o->scale);
    for (;;) {
        *length = propose_length(o, event);
        int clear = !s->run.system->force.bound || length->h <= BLIND * o->T;
        int status =
            clear ? FVI_SUCCESS : check_force_bounds(s, o, length->h, event, &clear);
        if (status || clear)
            return status;
        o->next_exponent = fvi_variable_step_exponent(*length) - FASTER;
    }
}
