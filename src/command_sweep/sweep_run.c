/* src/command_sweep/sweep_run.c -- Make one run of a sweep, with given steps or to a wanted error. */
#include "sweep_run.h"
#include "command_shared/fvi_run_rows.h"
#include "command_shared/fvi_run_search.h"
#include "command_shared/fvi_run_warn.h"
#include "options/fvi_options.h"
#include "output/fvi_table.h"

#include <stdlib.h>
#include <string.h>

/* Return the number of rows up to step k, which has a row. */
static size_t rows_up_to(const fvi_options *o, size_t k)
{
    return k / o->every + 1 + (k == o->steps && k % o->every != 0);
}

/* Return the step in whose place the last row of a run goes. An event ended the run at the time t, after row k. The
 * place is that of the next row. It is 0 if the event is at a row, which has been taken already. *rows becomes the
 * number of rows. */
static size_t row_of_end(const fvi_options *o, size_t k, double t, size_t *rows)
{
    const size_t last = k / o->every * o->every,
                 next = last + o->every < o->steps ? last + o->every : o->steps;
    const int is_at_row = k == last && t == (double)last * o->h;
    *rows = rows_up_to(o, is_at_row ? last : next);
    return is_at_row ? 0 : next;
}

/* Take the last row of a run that an event has ended, from the present state. */
static int write_end_row(fvi_table *t, const fvi_stepper *s, size_t *rows)
{
    const fvi_options *o = t->o;
    const size_t next = row_of_end(o, s->k, s->t, rows);
    fvi_observation now;
    int status = FVI_SUCCESS;
    t->ended = s->t;
    if (fvi_reductions_count(o->typed) > 0 || next == 0)
        return status;
    if (t->observer)
        status = fvi_observer_read(t->observer, s, s->t, &now);
    t->now = t->observer ? &now : NULL;
    if (!status)
        status = fvi_table_take(t, next, s->x, s->p);
    t->now = NULL;
    return status;
}

/* Check the inertia at the start and after the steps at which `fvi run` checks it. Return FVI_SUCCESS or FVI_ENOMEM. */
static int check_inertia(fvi_run_inertia *w, const fvi_stepper *s, sweep_verdict *v)
{
    char text[FVI_WARNING_ROOM];
    const int warned = fvi_run_check_inertia(w, s, text);
    v->singular |= warned > 0;
    return warned < 0 ? FVI_ENOMEM : FVI_SUCCESS;
}

/* Make all steps of length o->h, and take the rows of o->every. */
static sweep_verdict run_by_steps(const fvi_options *o, const fvi_run *r, fvi_table *t)
{
    fvi_stepper *s;
    sweep_verdict v = { .status = fvi_stepper_start(o->method, r, &s, NULL) };
    char unstable[FVI_WARNING_ROOM];
    fvi_run_inertia inertia = { 0 };
    if (v.status)
        return v;
    v.unstable = fvi_warning_of_step(o->method, r, sizeof unstable, unstable);
    v.status = v.unstable < 0 ? FVI_ENOMEM : fvi_run_observe(t, s, NULL);
    if (!v.status)
        v.status = fvi_inertia_watch_begin(r->system, &inertia.watch);
    if (!v.status)
        v.status = check_inertia(&inertia, s, &v);
    inertia.steps = 0; /* the start is no step */
    if (!v.status)
        v.status = fvi_run_row(t, s, 0);
    for (size_t k = 0, next = fvi_table_next(t, 0); !v.status && k < o->steps;) {
        if (s->k < next && fvi_stepper_is_over(s)) {
            v.status = write_end_row(t, s, &v.rows);
            break;
        }
        if (s->k < next) {
            v.step = s->k + 1;
            v.status = fvi_run_step(t, s);
            if (!v.status)
                v.status = check_inertia(&inertia, s, &v);
            continue;
        }
        v.status = fvi_run_row(t, s, k = next);
        next = k < o->steps ? fvi_table_next(t, k) : k;
    }
    fvi_inertia_watch_free(inertia.watch);
    fvi_observer_free(t->observer);
    fvi_stepper_free(s);
    return v;
}

/* The rows that a search has found. */
typedef struct {
    double *x, *p, *typed;
    fvi_report report;
    fvi_run_events events;
} found_run;

/* Take the last row of a run that an event has ended. It is moved to the place of the row that would come next. */
static int write_found_end(fvi_table *t, found_run *f, size_t *rows)
{
    const fvi_options *o = t->o;
    const size_t d = o->d, at = f->report.rows, width = fvi_typed_columns_count(o->typed);
    t->ended = f->events.at[f->events.count - 1].t;
    const size_t next = row_of_end(o, at - 1, t->ended, rows);
    if (next == 0)
        return FVI_SUCCESS;
    memmove(f->x + next * d, f->x + at * d, d * sizeof *f->x);
    memmove(f->p + next * d, f->p + at * d, d * sizeof *f->p);
    memmove(f->typed + next * width, f->typed + at * width, width * sizeof *f->typed);
    return fvi_run_found_row(t, next, f->x, f->p, f->typed);
}

/* Take the rows of o->every from the rows that were found. */
static void write_found_rows(fvi_table *t, const fvi_run *r, found_run *f, sweep_verdict *v)
{
    const fvi_options *o = t->o;
    char text[FVI_WARNING_ROOM];
    v->singular = fvi_run_inertia_of_rows(o, r->system, f->report.rows, f->x, f->p, text);
    v->status = v->singular < 0 ? FVI_ENOMEM : FVI_SUCCESS;
    for (size_t k = 0; k < f->report.rows && !v->status; k = fvi_table_next(t, k)) {
        v->status = fvi_run_found_row(t, k, f->x, f->p, f->typed);
        if (k == o->steps)
            break;
    }
    if (!v->status && f->report.rows <= o->steps)
        v->status = write_found_end(t, f, &v->rows);
}

/* Make a run with as many steps as the wanted error needs. */
static sweep_verdict run_to_error(const fvi_options *o, const fvi_run *r, fvi_table *t)
{
    const size_t count = o->steps + 1,
                 width = 2 * o->d + fvi_typed_columns_count(o->typed);
    found_run f = { .x = malloc(count * width * sizeof *f.x) };
    sweep_verdict v = { .status = FVI_ENOMEM };
    if (!f.x)
        return v;
    f.p = f.x + count * o->d;
    f.typed = f.p + count * o->d;
    v.status = fvi_run_search(o, o->method, r, f.x, f.p, f.typed, &f.report, &f.events);
    if (!v.status)
        write_found_rows(t, r, &f, &v);
    free(f.events.at);
    free(f.x);
    return v;
}

size_t sweep_run_rows(const sweep_grid *g, const fvi_options *o)
{
    return g->has_rows ? rows_up_to(o, o->steps) : 1;
}

int sweep_table_open(const sweep_grid *g, fvi_options *o, const fvi_system *system, fvi_table *t)
{
    if (!g->has_rows)
        o->every = o->steps;
    fvi_table_shape(t, o, system);
    t->wait = 1;
    t->height = g->has_rows ? sweep_run_rows(g, o) : 2;
    t->rows = fvi_table_room(t, 0);
    return t->rows != NULL;
}

static sweep_verdict run_table(const sweep_grid *g, fvi_options *o, fvi_table *t)
{
    const fvi_system system = fvi_options_system(o);
    const fvi_run r = fvi_options_run(o, &system);
    sweep_verdict v = { .status = FVI_ENOMEM };
    if (sweep_table_open(g, o, &system, t))
        v = (o->error > 0 ? run_to_error : run_by_steps)(o, &r, t);
    return v;
}

void sweep_keep_rows(const sweep_grid *g, size_t i, const fvi_options *o, const fvi_table *t,
                     sweep_verdict *v, double *rows)
{
    const size_t count = sweep_run_rows(g, o), width = g->count + t->width,
                 skipped = t->height - count;
    if (!g->has_rows || v->rows == 0) /* no event has ended the run early */
        v->rows = count;
    if (!v->status && fvi_reductions_count(o->typed) > 0)
        fvi_reductions_values(o->typed, t->rows + t->width);
    for (size_t k = 0; k < v->rows && !v->status; k++) {
        for (size_t n = 0; n < g->count; n++)
            rows[k * width + n] = sweep_grid_value(g, i, n);
        memcpy(rows + k * width + g->count, t->rows + (k + skipped) * t->width,
               t->width * sizeof *rows);
    }
}

sweep_verdict sweep_run(const sweep_grid *g, size_t i, double *rows)
{
    fvi_options o;
    fvi_table t;
    /* The options were accepted before, so the only possible reason is a lack of memory. */
    if (sweep_grid_options(g, i, &o, NULL))
        return (sweep_verdict){ .status = FVI_ENOMEM };
    sweep_verdict v = run_table(g, &o, &t);
    sweep_keep_rows(g, i, &o, &t, &v, rows);
    free(t.rows);
    fvi_options_free(&o);
    return v;
}
