/* src/variable_step/variable_step_places.c -- Find where z passes 0 and turns back within a step. [H 22]
 *
 * z is known at the stages. If |z| is smaller at one stage than at the two stages beside it, then |z| has a minimum
 * between these two, and parabolas find whether z is beyond 0 there. Near an end of the step the slope of z tells
 * whether there is such a minimum. */
#include "variable_step_events.h"

#include "system/larger.h"

#include <math.h>

/* Three places with z on the same side of 0; z is nearest to 0 at the middle one. size: |z|. */
typedef struct {
    double theta[3], size[3];
} bracket;

/* Return the minimum of the parabola through the three places; *size: its value there. */
static double lowest_of(const bracket *b, double *size)
{
    const double left = b->theta[0] - b->theta[1], right = b->theta[2] - b->theta[1],
                 slope_left = (b->size[0] - b->size[1]) / left,
                 slope_right = (b->size[2] - b->size[1]) / right,
                 curvature = (slope_right - slope_left) / (right - left),
                 slope = slope_left - curvature * left, move = -slope / (2 * curvature);
    *size = b->size[1] + move * (slope + curvature * move);
    return b->theta[1] + move;
}

/* Make the bracket smaller by a fourth place. */
static void narrow_bracket(bracket *b, double theta, double size)
{
    const int is_left = theta < b->theta[1], is_lower = size < b->size[1],
              end = is_left == is_lower ? 2 : 0; /* the end that is dropped */
    b->theta[end] = is_lower ? b->theta[1] : theta;
    b->size[end] = is_lower ? b->size[1] : size;
    if (is_lower) {
        b->theta[1] = theta;
        b->size[1] = size;
    }
}

/* Find a place within the bracket where z is beyond 0, and write it to *theta and *z; otherwise *z is unchanged, 0. The
 * search ends if the minimum of a parabola is hardly below the known values. */
static int find_beyond(const fvi_stepper *s, const fvi_variable_step_state *o, size_t i, double side,
                       bracket *b, double *theta, double *z)
{
    for (int n = 0; n < 20; n++) {
        double least, here;
        *theta = lowest_of(b, &least);
        const int is_within = *theta > b->theta[0] && *theta < b->theta[2];
        if (!is_within || fabs(*theta - b->theta[1]) < 1e-9 || (n > 0 && least > 0.9 * b->size[1]))
            return FVI_SUCCESS;
        const int status = fvi_event_within(s, o, i, *theta, &here);
        if (status)
            return status;
        if (fvi_event_sign(o->watch, i, here) == -side) {
            *z = here;
            return FVI_SUCCESS;
        }
        narrow_bracket(b, *theta, side * here);
    }
    return FVI_SUCCESS;
}

/* Places, and whether they are stages. */
typedef struct {
    fvi_event_places at;
    int is_stage[FVI_EVENT_PLACES];
} known_places;

static int evaluate_event_at(const fvi_stepper *s, const fvi_variable_step_state *o, size_t i, double theta,
                             known_places *to)
{
    const size_t n = to->at.count++;
    to->at.theta[n] = theta;
    return fvi_event_within(s, o, i, theta, &to->at.z[n]);
}

/* Return nonzero if z is too far from 0 to reach it. Between the stages, a polynomial leaves the range of its values at
 * the stages by less than half of that range, because Lebesgue's constant of eight Lobatto nodes is 1.97. */
static int stays_off_zero(const fvi_variable_step_state *o, size_t i, double first)
{
    const double *z = o->watch->z + i * o->rule->s;
    double nearest = fabs(first), farthest = nearest;
    for (size_t n = 1; n < o->rule->s; n++) {
        if (z[n] * first <= 0)
            return 0;
        nearest = smaller(nearest, fabs(z[n]));
        farthest = larger(farthest, fabs(z[n]));
    }
    return farthest - nearest < nearest;
}

/* Add places to *to, which holds the start of the step: the stages, and if |z| at an end of the step is smaller than at
 * the stage beside it, a place near that end, which tells the slope of z. */
static int evaluate_known_places(const fvi_stepper *s, const fvi_variable_step_state *o, size_t i,
                                 known_places *to)
{
    static const double NEAR = 1e-4;
    const size_t stages = o->rule->s;
    const double *z = o->watch->z + i * stages;
    int status = FVI_SUCCESS;
    if (fabs(to->at.z[0]) < fabs(z[1]))
        status = evaluate_event_at(s, o, i, NEAR, to);
    for (size_t n = 1; n < stages && !status; n++) {
        const int is_last = n + 1 == stages;
        if (is_last && fabs(z[n]) < fabs(z[n - 1]))
            status = evaluate_event_at(s, o, i, 1 - NEAR, to);
        const size_t k = to->at.count++;
        to->at.theta[k] = is_last ? 1 : o->rule->c[n];
        to->at.z[k] = z[n];
        to->is_stage[k] = 1;
    }
    return status;
}

/* Return nonzero if |z| at place n is smaller than at both places beside it, on the same side of 0. *b: these three
 * places; *side: the side. */
static int is_least(const fvi_event_watch *w, size_t i, const fvi_event_places *at, size_t n,
                    double *side, bracket *b)
{
    *side = fvi_event_sign(w, i, at->z[n]);
    if (n == 0 || n + 1 >= at->count || *side == 0)
        return 0;
    for (size_t k = 0; k < 3; k++) {
        if (fvi_event_sign(w, i, at->z[n - 1 + k]) != *side)
            return 0;
        b->theta[k] = at->theta[n - 1 + k];
        b->size[k] = fabs(at->z[n - 1 + k]);
    }
    return b->size[1] <= b->size[0] && b->size[1] < b->size[2];
}

static void append_place(fvi_event_places *to, double theta, double z)
{
    to->theta[to->count] = theta;
    to->z[to->count++] = z;
}

int fvi_event_places_of(const fvi_stepper *s, const fvi_variable_step_state *o, size_t i,
                        fvi_event_places *places)
{
    const size_t stages = o->rule->s;
    known_places known = { .at.count = 0 };
    int status = evaluate_event_at(s, o, i, 0, &known);
    places->count = 0;
    if (!status && stays_off_zero(o, i, known.at.z[0])) {
        for (size_t n = 1; n < stages; n++)
            append_place(places, n + 1 == stages ? 1 : o->rule->c[n], o->watch->z[i * stages + n]);
        return FVI_SUCCESS;
    }
    if (!status)
        status = evaluate_known_places(s, o, i, &known);
    for (size_t n = 0; n < known.at.count && !status; n++) {
        const double here = known.at.theta[n];
        double theta = here, side, beyond = 0;
        bracket b;
        if (is_least(o->watch, i, &known.at, n, &side, &b))
            status = find_beyond(s, o, i, side, &b, &theta, &beyond);
        if (beyond != 0 && theta < here)
            append_place(places, theta, beyond);
        if (known.is_stage[n])
            append_place(places, here, known.at.z[n]);
        if (beyond != 0 && theta > here)
            append_place(places, theta, beyond);
    }
    return status;
}
