/* src/variable_step/variable_step_events.c -- End a step at an event. [H 22]
 *
 * A step has been tried. If z changes its sign in it, the polynomial of the step says roughly when. Then the length h
 * of the step is the unknown of z(x(h)) = 0, and each trial of h solves the step again. No trial changes the history,
 * so the last trial is the step. */
#include "variable_mechanism.h"
#include "variable_step_events.h"

#include "system/archive_pieces.h"
#include "system/arrays.h"
#include "system/fail.h"
#include "system/larger.h"

#include <gsl/gsl_machine.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- memory, copies, archive ---- */

int fvi_variable_step_velocities_jump(const fvi_run *run)
{
    if (run->system->force.impulse_count > 0)
        return 1;
    for (size_t i = 0; i < run->event_count; i++)
        if (fvi_event_has_wall(&run->events[i]))
            return 1;
    return 0;
}

static size_t count_numbers(const fvi_variable_step_state *o, size_t count)
{
    return count * (8 + o->rule->s) + 6 * o->d;
}

int fvi_variable_step_begin_events(const fvi_run *run, fvi_variable_step_state *o)
{
    const size_t n = run->event_count;
    if (n == 0)
        return FVI_SUCCESS;
    fvi_event_watch *w = o->watch = calloc(1, sizeof *w);
    if (w)
        w->side = FVI_ARRAYS({ &w->side, n }, { &w->size, n }, { &w->rounding, n }, { &w->has_hit, n },
                             { &w->theta, n }, { &w->behind, n }, { &w->closed, n }, { &w->is_new, n },
                             { &w->z, n * o->rule->s }, { &w->point, 6 * o->d });
    if (!w || !w->side)
        FVI_FAIL("no memory for the events", FVI_ENOMEM);
    w->count = n;
    return FVI_SUCCESS;
}

int fvi_variable_step_copy_events(const fvi_event_watch *from, fvi_variable_step_state *o)
{
    if (!from)
        return FVI_SUCCESS;
    const fvi_run run = { .event_count = from->count };
    const int status = fvi_variable_step_begin_events(&run, o);
    if (status)
        return status;
    fvi_event_watch *w = o->watch;
    memcpy(w->side, from->side, count_numbers(o, w->count) * sizeof *w->side);
    w->is_ready = from->is_ready;
    w->is_over = from->is_over;
    w->rest = from->rest;
    if (from->happened == 0)
        return FVI_SUCCESS;
    w->times = malloc(from->happened * sizeof *w->times);
    if (!w->times)
        FVI_FAIL("no memory for the events", FVI_ENOMEM);
    memcpy(w->times, from->times, from->happened * sizeof *w->times);
    w->happened = w->room = from->happened;
    return FVI_SUCCESS;
}

/* Serialise the side of each z and the events so far. A run that goes on may have less room for the times. */
int fvi_variable_step_archive_events(const fvi_stepper *s, fvi_variable_step_state *o, fvi_archive *v)
{
    fvi_event_watch *w = o->watch;
    size_t happened = w->happened;
    int status = FVI_SERIALIZE(v, FVI_CONSTANT(w->count), FVI_STATES(w->side, count_numbers(o, w->count)),
                               FVI_STATE(w->is_ready), FVI_STATE(w->is_over), FVI_STATE(happened));
    if (!status && happened > 2 * w->count * (o->counts.steps + 1))
        FVI_FAIL("not a state of this run", FVI_EINVAL);
    if (!status)
        status = fvi_variable_step_room_for_times(w, happened);
    if (status)
        return status;
    for (w->happened = 0; w->happened < happened && !status; w->happened++) {
        fvi_event_time *at = &w->times[w->happened];
        status = FVI_SERIALIZE(v, FVI_STATE(at->t), FVI_STATE(at->event), FVI_STATE(at->at_rest),
                               FVI_STATE(at->lifts_off));
        if (!status && !(at->event < w->count && at->t <= s->t))
            FVI_FAIL("not a state of this run", FVI_EINVAL);
    }
    return status;
}

void fvi_variable_step_free_events(fvi_event_watch *w)
{
    if (!w)
        return;
    free(w->times);
    free(w->side);
    free(w);
}

/* ---- z ---- */

static int evaluate(const fvi_stepper *s, size_t i, double t, const double *x,
                    const double *p, double *z)
{
    const fvi_event *e = &s->run.events[i];
    fvi_event_watch *w = ((fvi_variable_step_state *)s->method_state)->watch;
    const int status = e->value(t, s->run.system->d, x, p, e->params, z);
    if (status)
        return status;
    if (!isfinite(*z))
        return FVI_EOVRFLW;
    w->size[i] = larger(w->size[i], fabs(*z));
    return FVI_SUCCESS;
}

double fvi_event_sign(const fvi_event_watch *w, size_t i, double z)
{
    const double least = larger(8 * GSL_DBL_EPSILON * w->size[i], 4 * w->rounding[i]);
    return fabs(z) <= least ? 0 : z > 0 ? 1 : -1;
}

int fvi_event_within(const fvi_stepper *s, const fvi_variable_step_state *o, size_t i, double theta,
                     double *z)
{
    double *x = o->watch->point, *p = x + o->d;
    const double t = o->t + theta * o->length.h;
    int status = FVI_SUCCESS;
    if (o->watch->closed[i] != 0) {
        *z = fvi_variable_step_normal_force(s, o, i, theta);
        return status;
    }
    fvi_variable_step_within(s, o, theta, x, p);
    if (o->mechanism && s->mechanism->m) {
        double *v = p + o->d;
        memcpy(v, o->v, o->d * sizeof *v);
        status = fvi_mesh_project(s, t, x, p, v);
    }
    return status ? status : evaluate(s, i, t, x, p, z);
}

/* Compute z of event i at the end of the step that has been tried, with the x and p that the accepted step will
 * have. */
static int value_at_end(const fvi_stepper *s, const fvi_variable_step_state *o,
                        size_t i, double *z)
{
    const size_t last = o->rule->s - 1;
    const double h = o->length.h, t = o->t + h;
    double *x = o->watch->point, *p = x + o->d, move[FVI_LANES];
    if (o->watch->closed[i] != 0) {
        *z = fvi_variable_step_normal_force(s, o, i, 1);
        return FVI_SUCCESS;
    }
    const int status = o->mechanism ? fvi_mesh_end(s, o, x, p) : FVI_SUCCESS;
    for (size_t j = 0; j < o->d && !o->mechanism; j++) {
        const double *delta = o->delta + j * FVI_LANES;
        double G = 0, slope = 0;
        if (fvi_singular_is(o, o->t))
            fvi_singular_at(&o->singular, j, t, &G, &slope, NULL);
        fvi_square_apply(o->rule->s, o->to_x, delta, move);
        x[j] = o->y[j] + h * (o->v[j] + move[last]) + G;
        p[j] = s->run.system->mass[j] * (o->v[j] + delta[last] + slope);
    }
    return status ? status : evaluate(s, i, t, x, p, z);
}

int fvi_variable_step_sides(const fvi_stepper *s, fvi_event_watch *w, int anew)
{
    for (size_t i = 0; i < w->count; i++) {
        double z;
        if (w->closed[i] != 0)
            continue;
        const int status = evaluate(s, i, s->t, s->x, s->p, &z);
        if (status)
            return status;
        const double sign = fvi_event_sign(w, i, z);
        if (sign != 0 && (w->side[i] == 0 || (anew && w->has_hit[i] == 0)))
            w->side[i] = sign;
    }
    return FVI_SUCCESS;
}

/* ---- the first event of a step ---- */

/* Find the passing of z between two times of the polynomial. At the first time, z is on its side, or near 0. */
static int bisect(const fvi_stepper *s, const fvi_variable_step_state *o, size_t i,
                  double side, double low, double high, double *theta)
{
    for (int n = 0; n < 50; n++) {
        const double middle = low + (high - low) / 2;
        double z;
        const int status = fvi_event_within(s, o, i, middle, &z);
        if (status)
            return status;
        if (z * side > 0)
            low = middle;
        else
            high = middle;
    }
    *theta = high;
    return FVI_SUCCESS;
}

/* Find where the force of closed contact i passes 0, to w->theta[i]: 0 if the contact is under tension at the start of
 * the step, INFINITY if it pushes at all stages. */
static int find_lift_off(const fvi_stepper *s, const fvi_variable_step_state *o, size_t i)
{
    const fvi_event_watch *w = o->watch;
    const size_t row = fvi_mechanism_row_of_contact(s->mechanism, i), stages = o->rule->s;
    const double noise = fvi_mesh_contact_noise(s, o, row);
    double low = 0;
    w->z[i * stages] = fvi_variable_step_normal_force(s, o, i, 0);
    w->theta[i] = w->z[i * stages] < -noise ? 0 : INFINITY;
    for (size_t n = 1; n < stages && w->theta[i] == INFINITY; n++) {
        const double high = n + 1 < stages ? o->rule->c[n] : 1;
        if (w->z[i * stages + n] < -noise)
            return bisect(s, o, i, 1, low, high, &w->theta[i]);
        low = high;
    }
    return FVI_SUCCESS;
}

/* Find where event i passes 0, to w->theta[i]; INFINITY if it does not. *is_too_long: set to 1 if z has not been on its
 * side at any place behind the impact of this event; then a shorter step must find z there. A body that starts on its
 * wall counts as one that has just hit it. */
static int find_passing(const fvi_stepper *s, const fvi_variable_step_state *o,
                        size_t i, int *is_too_long)
{
    fvi_event_watch *w = o->watch;
    const fvi_event *e = &s->run.events[i];
    const int on_wall = w->side[i] == 0 && fvi_event_has_wall(e);
    double side = on_wall ? fvi_variable_step_outside(e) : w->side[i], low = 0;
    int is_seen = w->has_hit[i] == 0 && !on_wall;
    fvi_event_places places;
    w->theta[i] = INFINITY;
    if (w->closed[i] != 0)
        return find_lift_off(s, o, i);
    const int status = fvi_event_places_of(s, o, i, &places);
    for (size_t n = 0; !status && n < places.count; n++) {
        const double sign = fvi_event_sign(w, i, places.z[n]), here = places.theta[n];
        const int passes = side != 0 && sign == -side;
        if (sign == 0)
            continue;
        if (passes && !is_seen) {
            *is_too_long = 1;
            w->has_hit[i] = 1;
            return FVI_SUCCESS;
        }
        if (passes && (e->direction == 0 || e->direction == -side)) {
            w->behind[i] = -side;
            return bisect(s, o, i, side, low, here, &w->theta[i]);
        }
        side = sign;
        is_seen = 1;
        low = here;
    }
    return status;
}

/* Find the first event of the step; w->count if there is none. */
static int find_first(const fvi_stepper *s, fvi_variable_step_state *o,
                      size_t *first, int *is_too_long)
{
    fvi_event_watch *w = o->watch;
    const size_t stages = o->rule->s;
    int status = FVI_SUCCESS;
    *is_too_long = 0;
    *first = w->count;
    for (size_t n = 1; n < stages && !status; n++)
        for (size_t i = 0; i < w->count && !status; i++)
            status = n + 1 < stages
                         ? fvi_event_within(s, o, i, o->rule->c[n], &w->z[i * stages + n])
                         : value_at_end(s, o, i, &w->z[i * stages + n]);
    for (size_t i = 0; i < w->count && !status; i++) {
        status = find_passing(s, o, i, is_too_long);
        if (w->theta[i] < INFINITY
            && (*first == w->count || w->theta[i] < w->theta[*first]))
            *first = i;
    }
    return status;
}

/* ---- the length of the step ---- */

//> event_length
/* Solve a step of length h, and compute z at its end. */
static int try_length(fvi_stepper *s, fvi_variable_step_state *o, size_t i, double h,
                      double *z)
{
    double error;
    const int status = fvi_variable_step_try(s, o, (fvi_length){ h, FVI_OFF_LATTICE },
                                             &error);
    return status ? status : value_at_end(s, o, i, z);
}

/* Find the length at which z is 0 by secants, from a guess of the length and of dz/dh by the polynomial. The secants
 * end if |z| does not become smaller, or if h changes by a rounding error of the time only. */
static int solve_length(fvi_stepper *s, fvi_variable_step_state *o, size_t i,
                        double guess, double slope, double longest)
{
    const double least = 4 * GSL_DBL_EPSILON * (o->t + guess);
    double h = larger(guess, least), best_h = h, best = INFINITY, h0 = 0, z0 = 0, z = 0;
    for (int n = 0; n < 12; n++) {
        const int status = try_length(s, o, i, h, &z);
        if (status)
            return status;
        if (n > 0 && h != h0 && z != z0)
            slope = (z - z0) / (h - h0);
        const int is_better = fabs(z) < best;
        if (is_better) {
            best = fabs(z);
            best_h = h;
        }
        const double next = fmin(larger(h - z / slope, least), longest);
        if (!is_better || z == 0 || !isfinite(next)
            || fabs(next - h) <= GSL_DBL_EPSILON / 2 * (o->t + h))
            break;
        h0 = h;
        z0 = z;
        h = next;
    }
    o->watch->rounding[i] = best;
    return best_h == o->length.h ? FVI_SUCCESS : try_length(s, o, i, best_h, &z);
}
//< event_length

/* Compute dz/dh near theta by the polynomial. */
static int slope_of(const fvi_stepper *s, const fvi_variable_step_state *o, size_t i,
                    double theta, double *slope)
{
    const double low = larger(theta - 1e-4, 0), high = fmin(theta + 1e-4, 1);
    double z, before;
    int status = fvi_event_within(s, o, i, low, &before);
    if (!status)
        status = fvi_event_within(s, o, i, high, &z);
    if (!status)
        *slope = (z - before) / ((high - low) * o->length.h);
    return status;
}

/* Return nonzero if a body that started on its wall lies there: longer steps have seen it fall, but in a short step z
 * is a rounding error only. */
static int lies_on_wall(const fvi_variable_step_state *o)
{
    const fvi_event_watch *w = o->watch;
    for (size_t i = 0; i < w->count; i++) {
        int lies = w->side[i] == 0 && w->has_hit[i] != 0;
        for (size_t n = 1; n < o->rule->s && lies; n++)
            lies = fvi_event_sign(w, i, w->z[i * o->rule->s + n]) == 0;
        if (lies)
            return 1;
    }
    return 0;
}

int fvi_variable_step_end_at_event(fvi_stepper *s, fvi_variable_step_state *o)
{
    fvi_event_watch *w = o->watch;
    size_t first;
    int is_too_long, status = FVI_SUCCESS;
    w->at_rest = w->is_released = 0;
    if (w->is_over)
        FVI_FAIL("an event has ended the run", FVI_EINVAL);
    if (!w->is_ready)
        status = fvi_variable_step_sides(s, w, 1);
    w->is_ready = 1;
    while (!status) {
        double error, slope;
        const double h = o->length.h;
        status = find_first(s, o, &first, &is_too_long);
        if (status)
            return status;
        if (is_too_long && h > larger(o->least, 64 * GSL_DBL_EPSILON * o->t)) {
            status = fvi_variable_step_try(
                s, o, (fvi_length){ h / 4, FVI_OFF_LATTICE }, &error);
            continue;
        }
        if (first < w->count && w->closed[first] != 0 && w->theta[first] == 0) {
            w->is_released = 1;
            return fvi_variable_step_open_contact(s, o, first);
        }
        w->at_rest = is_too_long || lies_on_wall(o);
        if (w->at_rest || first == w->count)
            return FVI_SUCCESS;
        status = slope_of(s, o, first, w->theta[first], &slope);
        return status ? status
                      : solve_length(s, o, first, w->theta[first] * h, slope, h);
    }
    return status;
}
