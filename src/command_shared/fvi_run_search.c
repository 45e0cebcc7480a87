/* src/command_shared/fvi_run_search.c -- Make a run to a wanted error, with its typed columns and its events. */
#include "fvi_run_search.h"

#include "fvi_run_rows.h"
#include "options/fvi_option_columns.h"

#include <stdlib.h>
#include <string.h>

/* The arrays for the rows, the typed columns of all rows, and the events. `next` is the number of the next row. Until
 * that row is reached, its place holds the state at the last event. */
typedef struct {
    const fvi_options *o;
    double *x, *p, *rows;
    fvi_run_events *events;
    size_t next;
} typed_rows;

static int count_row(size_t k, double t, const double *x, const double *p, void *params)
{
    (void)t, (void)x, (void)p;
    ((typed_rows *)params)->next = k + 1;
    return FVI_SUCCESS;
}

static int store_event(const fvi_event_time *at, const double *x, const double *p, void *params)
{
    const typed_rows *kept = params;
    fvi_run_events *events = kept->events;
    const size_t d = kept->o->d, bytes = kept->next <= kept->o->steps ? d * sizeof *x : 0;
    memcpy(kept->x + kept->next * d, x, bytes);
    memcpy(kept->p + kept->next * d, p, bytes);
    if (events->count == events->room) {
        const size_t room = 2 * events->room + 16;
        fvi_event_time *more = realloc(events->at, room * sizeof *more);
        if (!more)
            return FVI_ENOMEM;
        events->at = more;
        events->room = room;
    }
    events->at[events->count++] = *at;
    return FVI_SUCCESS;
}

static int store_typed_columns(size_t k, const fvi_observation *now, void *params)
{
    const typed_rows *t = params;
    return fvi_typed_columns_values(t->o->typed, now,
                                    t->rows + k * fvi_typed_columns_count(t->o->typed));
}

/* Write the typed columns of a state between two rows to the place of the next row, because an event may end the run
 * there. */
static int store_between_rows(const fvi_observation *now, void *params)
{
    const typed_rows *t = params;
    return t->next > t->o->steps ? FVI_SUCCESS : store_typed_columns(t->next, now, params);
}

/* Add a row, or a step between two rows, to the reductions. fvi_solve calls these functions in the order of the
 * times. */
static int reduce_step(const fvi_observation *now, void *params)
{
    return fvi_run_reduce(((const typed_rows *)params)->o, now);
}

static int reduce_row(size_t k, const fvi_observation *now, void *params)
{
    (void)k;
    return reduce_step(now, params);
}

int fvi_run_search(const fvi_options *o, const fvi_method *method,
                   const fvi_run *r, double *x, double *p, double *typed,
                   fvi_report *found, fvi_run_events *events)
{
    typed_rows kept = { o, x, p, typed, events, 0 };
    const fvi_problem problem = { .system = *r->system,
                                  .x0 = r->x0,
                                  .p0 = r->p0,
                                  .T = o->time,
                                  .alpha = r->alpha,
                                  .law = r->law,
                                  .past = r->past,
                                  .events = r->events,
                                  .event_count = r->event_count };
    const fvi_solve_options options = { .method = method,
                                        .kappa = &r->kappa,
                                        .longest = r->longest,
                                        .history = r->memory,
                                        .history_tolerance = r->tolerance };
    const fvi_accuracy accuracy = { o->error, o->most_steps };
    fvi_outputs rows = { .rows = r->steps + 1, .x = x, .p = p, .params = &kept };
    rows.event = events ? store_event : NULL;
    rows.row = count_row;
    const int reduces = fvi_reductions_count(o->typed) > 0;
    if (typed && (reduces || fvi_options_needs_stepper(o))) {
        rows.observed = reduces ? reduce_row : store_typed_columns;
        rows.between = reduces ? reduce_step : r->event_count ? store_between_rows : NULL;
        rows.wanted = fvi_typed_columns_wanted(o->typed);
    }
    return fvi_solve(&problem, &options, &accuracy, &rows, found, NULL);
}
