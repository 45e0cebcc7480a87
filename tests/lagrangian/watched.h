/* tests/lagrangian/watched.h -- A run of a mechanism with events, as they are typed. */
#ifndef WATCHED_H
#define WATCHED_H

#include "mechanisms.h"

enum { MOST_EVENTS = 3 };

typedef struct {
    mechanism_problem p;
    fvi_typed_events *typed;
    fvi_run run;
} watched;

static inline void open_watched(const mechanism_text *text, const char *const *events, double T, watched *w)
{
    size_t count = 0;
    while (count < MOST_EVENTS && events[count])
        count++;
    open_problem(text, &w->p);
    static const double ones[] = { 1, 1, 1, 1 };
    OK(fvi_parse_events(count, events, text->d, ones, NULL, &w->typed, NULL));
    fvi_typed_events_of(w->typed, w->p.system.mechanism);
    w->run = run_of(&w->p, T, 1);
    w->run.events = fvi_events_typed(w->typed, &w->run.event_count);
}

static inline void close_watched(watched *w)
{
    fvi_typed_events_free(w->typed);
    close_problem(&w->p);
}

/* To the end, or to an event that ends the run. */
static inline fvi_stepper *at_end(const fvi_run *run)
{
    fvi_stepper *s;
    fvi_error error = { 0 };
    ck_assert_msg(fvi_stepper_start(&fvi_variable_step, run, &s, &error) == 0, "%s", error.text);
    while (s->k < run->steps && !fvi_stepper_is_over(s))
        OK(fvi_stepper_step(s));
    return s;
}

/* So many events, each at rest (1), lifting off (2) or neither (0), and, if t is not NULL, at its time; the run goes on. */
static inline void check_events(const fvi_stepper *s, size_t count, const int *kind, const double *t, double most)
{
    size_t n;
    const fvi_event_time *at = fvi_stepper_events(s, &n);
    ck_assert_uint_eq(n, count);
    for (size_t i = 0; i < n; i++) {
        ck_assert_int_eq(at[i].at_rest + 2 * at[i].lifts_off, kind[i]);
        if (t)
            ck_assert_msg(fabs(at[i].t - t[i]) <= most, "event %zu at %.17g, not %.17g", i, at[i].t, t[i]);
    }
    ck_assert(!fvi_stepper_is_over(s));
}

#endif
