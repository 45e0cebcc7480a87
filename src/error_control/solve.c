/* src/error_control/solve.c -- fvi_solve: the motion at given times, by given steps or to a tolerance. [H 18, 22] */
#include "solve_state.h"

#include "system/fail.h"

#include <fvi/lagrangian.h>
#include <fvi/lobatto.h>

#include "error_control/search_bound.h"
#include "error_control/step_search.h"
#include "run/solution.h"

#include <float.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { USUAL_MOST_STEPS = 1 << 24 };

/* ---- rows ---- */

static double time_of_row(const fvi_solve_state *o, size_t k)
{
    return o->out->t ? o->out->t[k] : (double)k * o->run.h;
}

/* Write row k to the outputs, with its energy, and call the caller's `row`. */
static int write_row(const fvi_solve_state *o, size_t k, const double *x, const double *p)
{
    const fvi_outputs *out = o->out;
    const size_t d = o->run.system->d;
    int status = FVI_SUCCESS;
    if (out->energy)
        status = fvi_energy_at(o->run.system, time_of_row(o, k), x, p, out->energy + k);
    if (status)
        return status;
    if (out->x && out->x + k * d != x)
        memcpy(out->x + k * d, x, d * sizeof *x);
    if (out->p && out->p + k * d != p)
        memcpy(out->p + k * d, p, d * sizeof *p);
    return out->row ? out->row(k, time_of_row(o, k), x, p, out->params)
                    : FVI_SUCCESS;
}

/* Report the error of a step that failed. */
static int fail_at_step(const fvi_solve_state *o, size_t step, int status)
{
    const char *why = status == o->failure.code ? o->failure.text : fvi_error_name(status);
    return fvi_at_index(o->error, step, fvi_fail(o->error, status, NULL, NAN, "step %zu: %s", step, why));
}

static void report_of_mesh(fvi_report *report, const fvi_step_statistics *counts)
{
    report->steps = counts->steps;
    report->rejected = counts->rejected;
    report->h = counts->longest;
    report->stages = counts->stages;
    report->form = counts->form;
}

/* Call the caller's `event` for the events up to the time `until` that it has not been told. */
static int report_events(fvi_solve_state *o, double until)
{
    const size_t d = o->run.system->d;
    int status = FVI_SUCCESS;
    for (; !status && o->reported < o->events.count && o->events.at[o->reported].t <= until; o->reported++) {
        const double *place = o->events.place + 2 * d * o->reported;
        if (o->out->event)
            status = o->out->event(&o->events.at[o->reported], place, place + d, o->out->params);
    }
    return status;
}

/* Return the step of one length at whose end row k is known. *is_there: nonzero if the row is at the end of that step,
 * and not within it. */
static size_t node_of_row(const fvi_solve_state *o, const fvi_stepper *s, size_t k, int *is_there)
{
    const double parts = time_of_row(o, k) / s->run.h;
    *is_there = !o->is_between || fabs(parts - round(parts)) <= 16 * DBL_EPSILON * parts;
    return (size_t)(*is_there ? round(parts) : ceil(parts));
}

/* Return nonzero if the run has not yet reached row k. */
static int is_ahead(const fvi_solve_state *o, const fvi_stepper *s, size_t k)
{
    int is_there;
    return s->method->dense ? s->t < time_of_row(o, k) : s->k < node_of_row(o, s, k, &is_there);
}

/* Give out row k within the last step, by the path of its stages. */
static int row_of_stages(const fvi_solve_state *o, const fvi_stepper *s, size_t k, double *room)
{
    const double t = time_of_row(o, k);
    double *p = room + o->run.system->d;
    int status = fvi_lobatto_within(s, t, room);
    if (!status)
        status = fvi_lobatto_momentum_within(s, t, p);
    return status ? status : write_row(o, k, room, p);
}

/* Give out row k of a run that has reached or just passed its time. */
static int row_of_run(const fvi_solve_state *o, fvi_stepper *s, fvi_observer *observer,
                      size_t k, double *room)
{
    const size_t d = o->run.system->d;
    const double t = s->method->dense ? time_of_row(o, k) : s->t;
    fvi_observation now;
    int status;
    if (observer) {
        status = fvi_observer_read(observer, s, t, &now);
        if (!status)
            status = write_row(o, k, now.x, now.p);
        return status ? status : o->out->observed(k, &now, o->out->params);
    }
    if (!s->method->dense) {
        int is_there;
        node_of_row(o, s, k, &is_there);
        return is_there ? write_row(o, k, s->x, s->p) : row_of_stages(o, s, k, room);
    }
    if (s->t == t)
        return write_row(o, k, s->x, s->p);
    status = fvi_stepper_advance_to(s, t, room, room + d);
    return status ? status : write_row(o, k, room, room + d);
}

/* Call the caller's `between` for the end of the last step, unless that is a row. */
static int observe_between_rows(const fvi_solve_state *o, fvi_stepper *s, fvi_observer *observer,
                                double last_row)
{
    const double near = s->method->dense ? 1e-6 * o->run.h : s->run.h / 4;
    fvi_observation now;
    if (!observer || !o->out->between || s->t <= last_row + near)
        return FVI_SUCCESS;
    const int status = fvi_observer_read(observer, s, s->t, &now);
    return status ? status : o->out->between(&now, o->out->params);
}

/* Take steps to the time of row k, or to an event that ends the run. */
static int steps_to_row(fvi_solve_state *o, fvi_stepper *s, fvi_observer *observer, size_t k)
{
    const double before = k > 0 ? time_of_row(o, k - 1) : -INFINITY;
    int status = o->run.event_count ? fvi_event_list_add(&o->events, s) : FVI_SUCCESS;
    while (!status && is_ahead(o, s, k) && !fvi_stepper_is_over(s)) {
        status = observe_between_rows(o, s, observer, before);
        if (!status)
            status = report_events(o, INFINITY);
        if (!status)
            status = observer ? fvi_observer_step(observer, s)
                              : fvi_stepper_step(s);
        if (!status && o->run.event_count)
            status = fvi_event_list_add(&o->events, s);
    }
    return status;
}

/* Give out the rows of one run in order. A row within a step of a method that chooses its steps is interpolated. */
static int rows_of_run(fvi_solve_state *o, fvi_stepper *s, fvi_observer *observer,
                       double *room)
{
    size_t k = 0;
    for (; k < o->out->rows; k++) {
        int status = steps_to_row(o, s, observer, k);
        if (status)
            return fail_at_step(o, s->k + 1, status);
        if (is_ahead(o, s, k)) {
            status = observe_between_rows(o, s, observer, k > 0 ? time_of_row(o, k - 1) : -INFINITY);
            if (status)
                return fail_at_step(o, s->k + 1, status);
            break;
        }
        status = report_events(o, time_of_row(o, k));
        if (!status)
            status = row_of_run(o, s, observer, k, room);
        if (status)
            return fail_at_step(o, k, status);
    }
    o->report->rows = k;
    return report_events(o, INFINITY);
}

/* Give out the rows of a run that has been started, with an observer if the caller asks for one. */
static int observe_run(fvi_solve_state *o, fvi_stepper *s)
{
    o->events.count = 0; /* this run finds the events again */
    fvi_observer *observer = NULL;
    double *room = malloc(2 * o->run.system->d * sizeof *room);
    if (!room)
        return fvi_no_memory(o->error, NULL);
    int status = o->out->observed ? fvi_observer_start(s, o->out->wanted, &observer, o->error) : FVI_SUCCESS;
    if (!status)
        status = rows_of_run(o, s, observer, room);
    fvi_observer_free(observer);
    free(room);
    return status;
}

int fvi_solve_by_steps(fvi_solve_state *o)
{
    fvi_stepper *s;
    fvi_step_statistics counts;
    int status = fvi_stepper_start(o->method, &o->run, &s, o->error);
    if (status)
        return status;
    status = observe_run(o, s);
    o->report->steps = s->k;
    o->report->h = o->run.h;
    if (o->method->dense && fvi_stepper_statistics(s, &counts) == FVI_SUCCESS)
        report_of_mesh(o->report, &counts);
    fvi_stepper_free(s);
    return status;
}

/* ---- to a tolerance ---- */

/* Search for a run to the tolerance. Write x and p of its rows, or of the given times if the method gives out any time,
 * and the report. */
static int search(fvi_solve_state *o, double *x, double *p)
{
    fvi_report *report = o->report;
    const size_t most = o->most_steps ? o->most_steps : USUAL_MOST_STEPS;
    int status;
    if (o->method->dense) {
        o->found = (fvi_variable_step_found){ .estimate = INFINITY };
        status = fvi_variable_step_search(&o->run, o->out->rows, o->out->t,
                                          o->tolerance, most, x, p, &o->found);
        o->events = o->found.events;
        report->error = o->found.estimate;
        report->until = o->found.until;
        report->rows = o->found.rows;
        report->step_error = o->found.step_error;
        report->agreed = o->found.common.agreed;
        report->agreed_until = o->found.common.until;
        report->events_differ = o->found.common.differ;
        report_of_mesh(report, &o->found.counts);
    } else if (o->is_between) {
        status = fvi_solve_between(o, most, x, p);
    } else {
        fvi_step_found found = { .estimate = INFINITY, .parts = 1 };
        status = fvi_step_search(o->method, &o->run, o->tolerance, most, x, p,
                                 &found);
        report->error = found.estimate;
        report->until = found.until;
        report->rows = o->out->rows;
        report->steps = found.parts * o->run.steps;
        report->h = o->run.h / (double)found.parts;
        if (status == FVI_ETOL)
            report->other = fvi_step_search_other(o->method, &o->run);
    }
    return status;
}

/* Return nonzero if no motion starts as the run does (19.2). */
static int has_no_solution(const fvi_solve_state *o)
{
    int has = 1;
    return fvi_run_has_solution(&o->run, &has) == FVI_SUCCESS && !has;
}

/* Report why a search failed. If the method refuses the start of the run, fvi_stepper_start says why. */
static int fail_of_search(const fvi_solve_state *o, int status)
{
    if (status == FVI_EDOM && has_no_solution(o))
        return fvi_fail(o->error, status, "past", NAN,
                        "Riemann-Liouville with a damped x0 != 0 has no solution for alpha > 1/2, to which no run can "
                        "be near; %s runs as printed with h in the place of an error", o->method->name);
    if (status == FVI_EUNSUP || status == FVI_EDOM) {
        fvi_stepper *s = NULL;
        const int again = fvi_stepper_start(o->method, &o->run, &s, o->error);
        fvi_stepper_free(s);
        if (again == status)
            return status;
    }
    if (o->method->dense && fvi_search_is_too_long(status))
        return fvi_fail(o->error, status, NULL, NAN, "%s; no run comes further than t = %.6g", fvi_error_name(status),
                        o->report->until);
    if (status == o->failure.code)
        return fvi_at_index(o->error, o->failure.index, fvi_fail(o->error, status, o->failure.field, o->failure.value,
                                                                 "%s", o->failure.text));
    if (status != FVI_ETOL)
        return fvi_fail(o->error, status, NULL, NAN, "%s", fvi_error_name(status));
    if (!isfinite(o->report->error) && o->report->events_differ)
        return fvi_fail(o->error, status, "tolerance", o->tolerance, "%g is out of reach: no two runs have the same "
                        "events; they agree on %zu, until t = %.6g, and then a Z may touch 0, or the motion be "
                        "chaotic", o->tolerance, o->report->agreed, o->report->agreed_until);
    char limit[60] = "", reached[100] = "";
    if (o->most_steps > 0)
        snprintf(limit, sizeof limit, " in at most %zu steps", o->most_steps);
    if (o->report->until > 0)
        snprintf(reached, sizeof reached, "; until t = %.4g it is reached: end there, or allow a larger error",
                 o->report->until);
    if (!isfinite(o->report->error))
        return fvi_fail(o->error, status, "tolerance", o->tolerance, "%g is out of reach%s: no step gives a result "
                        "that can be trusted%s", o->tolerance, limit, reached);
    return fvi_fail(o->error, status, "tolerance", o->tolerance,
                    "%g is out of reach%s; the smallest estimate was %.2g%s%s%s", o->tolerance, limit,
                    o->report->error, reached, o->report->other ? "; a higher order has " : "",
                    o->report->other ? o->report->other->name : "");
}

/* How many rows the search writes, and at which of them row k stands. */
static size_t rows_of_search(const fvi_solve_state *o)
{
    return o->out->t && (o->method->dense || o->is_between) ? o->out->rows : o->run.steps + 1;
}

static size_t place_of_row(const fvi_solve_state *o, size_t k)
{
    return o->out->t && !o->method->dense && !o->is_between
               ? (size_t)round(o->out->t[k] / o->run.h)
               : k;
}

/* Repeat the run that was found, for an observer. Its rows are the same, to the bit. */
static int observe_again(fvi_solve_state *o)
{
    fvi_stepper *s;
    fvi_run run = o->run;
    int status;
    if (o->method->dense) {
        status = fvi_variable_step_again(
            &run, o->most_steps ? o->most_steps : USUAL_MOST_STEPS, &o->found,
            &s);
    } else {
        const double parts = round(o->run.h / o->report->h);
        run.h = o->report->h;
        run.steps *= (size_t)parts;
        status = fvi_stepper_start(o->method, &run, &s, o->error);
    }
    if (status)
        return fvi_fail(o->error, status, NULL, NAN, "%s", fvi_error_name(status));
    status = observe_run(o, s);
    fvi_stepper_free(s);
    return status;
}

/* Give out the rows and the events that a search has found, in the order of their times. */
static int write_found_rows(fvi_solve_state *o, const double *x, const double *p)
{
    int status = FVI_SUCCESS;
    for (size_t k = 0; !status && k < o->report->rows; k++) {
        const size_t at = place_of_row(o, k) * o->run.system->d;
        status = report_events(o, time_of_row(o, k));
        if (!status)
            status = write_row(o, k, x + at, p + at);
        if (status)
            fail_at_step(o, k, status);
    }
    return status ? status : report_events(o, INFINITY);
}

static int solve_to_tolerance(fvi_solve_state *o)
{
    const size_t d = o->run.system->d, rows = rows_of_search(o);
    if (rows >= SIZE_MAX / sizeof(double) / 8 / d)
        return fvi_fail(o->error, FVI_EINVAL, "rows", (double)rows, "rows must be addressable");
    double *x = malloc(2 * rows * d * sizeof *x);
    if (!x)
        return fvi_no_memory(o->error, NULL);
    double *p = x + rows * d;
    int status = search(o, x, p);
    const double T = o->run.h * (double)o->run.steps;
    /* `until` is of use only for a motion that ends earlier. Before T / 20 the roundings were too large at once. And if
     * two runs agree up to T, it is their order that is not believed, which a shorter motion does not change. */
    if (status == FVI_ETOL && !(o->report->until >= T / 20 && o->report->until < T * (1 - 1e-9)))
        o->report->until = 0;
    if (status)
        fail_of_search(o, status);
    else if (o->out->observed)
        status = observe_again(o);
    if (!status && !o->out->observed)
        status = write_found_rows(o, x, p);
    free(x);
    return status;
}

int fvi_solve(const fvi_problem *problem, const fvi_solve_options *options,
              const fvi_accuracy *accuracy, const fvi_outputs *outputs,
              fvi_report *report, fvi_error *error)
{
    static const fvi_solve_options usual_options;
    static const fvi_accuracy not_asked_for;
    if (!problem || !outputs)
        return fvi_fail(error, FVI_EFAULT, problem ? "outputs" : "problem", NAN, "null pointer");
    fvi_report done = { .error = INFINITY };
    fvi_solve_state o = { .out = outputs, .report = &done, .error = error };
    int status = fvi_solve_prepare(&o, problem, options ? options : &usual_options,
                                   accuracy ? accuracy : &not_asked_for);
    if (status)
        return status;
    done.method = o.method;
    o.run.failure = &o.failure;
    status = o.tolerance > 0 ? solve_to_tolerance(&o) : fvi_solve_by_steps(&o);
    done.events = o.events.count;
    fvi_event_list_free(&o.events);
    if (report && (!status || status == FVI_ETOL))
        *report = done;
    return status;
}
