/* tests/events/ball.h -- A ball with the weight 1 that falls from 1, for the tests of events.  [H 22] */
#ifndef BALL_H
#define BALL_H

#include "harness/ulp.h"

#include <fvi/fvi.h>

static inline int height(double t, size_t d, const double *x, const double *p,
                         void *params, double *z)
{
    (void)t, (void)d, (void)p;
    *z = x[0] - (params ? *(const double *)params : 0);
    return 0;
}

static inline int upwards(double t, size_t d, const double *x, void *params,
                          double *normal, double *rate)
{
    (void)t, (void)x, (void)params;
    for (size_t i = 0; i < d; i++)
        normal[i] = i == 0;
    *rate = 0;
    return 0;
}

static inline int weight(double t, size_t d, void *params, double *F)
{
    (void)t, (void)params;
    for (size_t i = 0; i < d; i++)
        F[i] = -1;
    return 0;
}

static const double mass = 1, none = 0, one = 1;

static inline fvi_event impact(double e)
{
    return (fvi_event){ .value = height,
                        .gradient = upwards,
                        .action = FVI_EVENT_IMPACT,
                        .restitution = e };
}

static inline fvi_system ball(const double *rho)
{
    return (fvi_system){ .d = 1, .mass = &mass, .damping = rho, .force = { .value = weight } };
}

static inline fvi_run fall(const fvi_system *system, size_t count, const fvi_event *events,
                           double T)
{
    fvi_run run = fvi_run_default(system, &one, &none, T / 8, 8);
    run.events = events;
    run.event_count = count;
    return run;
}

static inline fvi_stepper *started(const fvi_run *run)
{
    fvi_stepper *s;
    fvi_error error = { 0 };
    ck_assert_msg(fvi_stepper_start(&fvi_variable_step, run, &s, &error) == 0, "%s",
                  error.text);
    return s;
}

/* To the end, or to an event that ends it. */
static inline void go(fvi_stepper *s)
{
    while (s->k < s->run.steps && !fvi_stepper_is_over(s))
        ck_assert_int_eq(fvi_stepper_step(s), FVI_SUCCESS);
}

#endif
