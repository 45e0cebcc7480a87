/* src/program/fvi_run_error.c -- The command `fvi run --error`. */
#include "output/fvi_complain.h"
#include <fvi/error.h>

#include "output/fvi_output.h"
#include "output/fvi_format.h"
#include "fvi_run.h"
#include <fvi/format_double.h>
#include "options/fvi_values.h"
#include "options/fvi_option_columns.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* Where the typed columns of all rows go, and events. `next` is the row that comes next: there stands the last
 * event, until there is such a row. */
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

static int keep_event(const fvi_event_time *at, const double *x, const double *p, void *params)
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

static int keep_typed(size_t k, const fvi_observation *now, void *params)
{
    const typed_rows *t = params;
    return fvi_typed_columns_values(t->o->typed, now,
                                    t->rows + k * fvi_typed_columns_count(t->o->typed));
}

/* The same where the run stands between two rows: an event may end it there. */
static int keep_between(const fvi_observation *now, void *params)
{
    const typed_rows *t = params;
    return t->next > t->o->steps ? FVI_SUCCESS : keep_typed(t->next, now, params);
}

/* At a row and at each step of the run that was found, in the order of the times. */
static int reduce_step(const fvi_observation *now, void *params)
{
    const fvi_options *o = ((const typed_rows *)params)->o;
    const int status = fvi_typed_columns_values(o->typed, now, o->typed_row);
    return status ? status : fvi_reductions_add(o->typed, now->t);
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
    rows.event = events ? keep_event : NULL;
    rows.row = count_row;
    const int reduces = fvi_reductions_count(o->typed) > 0;
    if (typed && (reduces || fvi_options_needs_stepper(o))) {
        rows.observed = reduces ? reduce_row : keep_typed;
        rows.between = reduces ? reduce_step : r->event_count ? keep_between : NULL;
        rows.wanted = fvi_typed_columns_wanted(o->typed);
    }
    return fvi_solve(&problem, &options, &accuracy, &rows, found, NULL);
}

static int search(const fvi_options *o, const fvi_method *method,
                  const fvi_run *r, double *x, double *p, double *typed,
                  fvi_report *found, fvi_run_events *events)
{
    const int terminal = isatty(STDERR_FILENO);
    if (terminal)
        fprintf(stderr, "looking for the step ...");
    const int status = fvi_run_search(o, method, r, x, p, typed, found, events);
    if (terminal)
        fprintf(stderr, "\r\033[K");
    return status;
}

/* "1.9e-07, with the step 9.537e-07" */
static void describe(const fvi_report *found, size_t size, char *text)
{
    if (found->method->dense)
        snprintf(text, size, "%.2g, in %zu steps", found->error, found->steps);
    else
        snprintf(text, size, "%.2g, with the step %.4g", found->error,
                 found->h);
}

/* How near to the wanted error a search came; and another method is tried before it is
 * advised. x and p are room for its rows, which nobody sees. */
static void say_how_near(const fvi_options *o, const fvi_run *r, double *x,
                         double *p, const fvi_report *found)
{
    char own[80], others[80], advice[160] = "";
    describe(found, sizeof own, own);
    if (!isfinite(found->error) && o->most_steps > 0) {
        fprintf(stderr,
                "fvi: --error: of the runs that --most-steps allows, up to %zu "
                "steps, no two can be compared\n",
                o->most_steps);
        return;
    }
    if (!isfinite(found->error) && found->events_differ) {
        fprintf(stderr,
                "fvi: --error: %g is out of reach: no two runs have the same events; they agree on "
                "%zu, until t = %.6g, and then a Z may touch 0, or the motion be chaotic\n",
                o->error, found->agreed, found->agreed_until);
        return;
    }
    if (!isfinite(found->error)) {
        fvi_complain("--error: no step gives a result that can be trusted");
        return;
    }
    const fvi_method *other = found->other;
    fvi_report tried;
    const int status = other ? search(o, other, r, x, p, NULL, &tried, NULL) : 0;
    if (other && !status)
        snprintf(advice, sizeof advice, "; try --method %s%s", other->name,
                 o->kappa != 0.5 && !other->takes_kappa ? " without --kappa" : "");
    else if (status == FVI_ETOL && tried.error < found->error) {
        describe(&tried, sizeof others, others);
        snprintf(advice, sizeof advice, "; by %s %s", other->name, others);
    }
    char reached[80] = "";
    if (found->until > 0)
        snprintf(reached, sizeof reached, "; until t = %.4g it is reached", found->until);
    fprintf(stderr,
            "fvi: --error: %g is out of reach; the smallest estimate was "
            "%s%s%s\n",
            o->error, own, reached, advice);
}

/* Returns an exit code. */
static int complain_of_search(const fvi_options *o, const fvi_run *r, int status)
{
    fvi_error error;
    fvi_reason_of_start(o, r, status, &error);
    return fvi_complain_of_start(o, &error, "run");
}

/* Find the step; say what was found, or how near it came. Returns an exit code. */
static int find_step(const fvi_options *o, const fvi_run *r, double *x,
                     double *p, double *typed, fvi_report *found, fvi_run_events *events)
{
    int status = search(o, o->method, r, x, p, typed, found, events);
    if (status == FVI_ETOL)
        say_how_near(o, r, x, p, found);
    else if (status == FVI_EMAXITER || status == FVI_EOVRFLW
             || (status == FVI_ESING && !o->directory))
        fvi_complain("--error: no step gives a result that can be trusted");
    else if (status)
        return complain_of_search(o, r, status);
    if (!status) {
        char text[80];
        describe(found, sizeof text, text);
        fprintf(stderr, "fvi: the error of x is %sabout %s\n",
                o->method->dense ? "at most " : "", text);
    }
    return status != 0;
}

static void head_of_search(FILE *out, const fvi_options *o,
                           const fvi_report *found)
{
    const int dense = o->method->dense != NULL;
    char text[32];
    if (dense) {
        fvi_variable_step_head(out, o, found->stages, found->form,
                               found->steps);
    } else {
        fvi_format_double(found->h, text);
        fvi_format_parameter(out, o->format, "step", text);
    }
    snprintf(text, sizeof text, "%.2g", found->error);
    fvi_format_parameter(out, o->format, "error estimate", text);
}

static int print_found(const fvi_options *o, const fvi_system *system,
                       const fvi_report *found, const double *x,
                       const double *p, const double *typed, const fvi_run_events *events)
{
    fvi_table t;
    fvi_table_shape(&t, o, system);
    if (!(t.rows = fvi_run_room(&t)))
        return fvi_complain("not enough memory");
    int failed = fvi_table_open(&t);
    if (!failed) {
        fvi_table_head(t.out, o);
        head_of_search(t.out, o, found);
        fvi_table_names(&t);
        int status = 0;
        size_t k = 0;
        for (; k < found->rows && !status && !ferror(t.out); k++)
            status = fvi_run_found_row(&t, k, x, p, typed);
        if (!status)
            status = fvi_run_reductions(&t);
        if (!status)
            fvi_run_print_events(&t, events->count, events->at);
        failed =
            fvi_table_close(&t, status ? fvi_stopped_at(k - 1, status) : 0);
    }
    free(t.rows);
    return failed;
}

/* What is wrong with a mechanism, or with its start, has a field and words. Returns an exit code. */
static int check_start(const fvi_options *o, const fvi_run *r)
{
    fvi_error error = { 0 };
    fvi_stepper *s;
    if (!o->mechanism)
        return 0;
    return fvi_stepper_start(o->method, r, &s, &error) ? fvi_complain_of_start(o, &error, "run")
                                                       : fvi_stepper_free(s);
}

int fvi_run_inertia_of_rows(const fvi_options *o, const fvi_system *system, size_t rows,
                            const double *x, const double *p, char *text)
{
    double *t = o->text[LAGRANGIAN] ? malloc(rows * sizeof *t) : NULL;
    if (!t)
        return o->text[LAGRANGIAN] ? -1 : 0;
    for (size_t k = 0; k < rows; k++)
        t[k] = (double)k * o->h;
    const int warned =
        fvi_warning_of_inertia_in_rows(system, rows, t, x, p, FVI_WARNING_ROOM, text);
    free(t);
    return warned;
}

/* Of a Lagrangian whose inertia vanishes between the rows that were found. Returns an exit code. */
static int warn_of_inertia(const fvi_options *o, const fvi_system *system, size_t rows,
                           const double *x, const double *p)
{
    char text[FVI_WARNING_ROOM];
    const int warned = fvi_run_inertia_of_rows(o, system, rows, x, p, text);
    if (warned > 0)
        fvi_warn(text);
    return warned < 0 ? fvi_complain("not enough memory") : 0;
}

int fvi_command_error(const fvi_options *o, const fvi_system *system)
{
    const fvi_run r = fvi_options_run(o, system);
    fvi_report found;
    fvi_table t;
    const int refused = check_start(o, &r);
    if (refused)
        return refused;
    fvi_table_shape(&t, o, system);
    double *rows =
        fvi_run_room(&t); /* is there enough, before anything is tried? */
    const size_t count = o->steps + 1,
                 width = 2 * o->d + fvi_typed_columns_count(o->typed);
    double *x = rows ? malloc(count * width * sizeof *x) : NULL;
    free(rows);
    if (!x)
        return fvi_complain("not enough memory");
    double *p = x + count * o->d, *typed = p + count * o->d;
    fvi_run_events events = { 0 };
    int failed = find_step(o, &r, x, p, typed, &found, &events);
    if (!failed)
        failed = warn_of_inertia(o, system, found.rows, x, p);
    if (!failed)
        failed = print_found(o, system, &found, x, p, typed, &events);
    free(events.at);
    free(x);
    return failed;
}
