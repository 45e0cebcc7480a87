/* src/command_run/fvi_run.c -- Run the command `fvi run` with a given step.
 *
 * fvi_command_run starts the run, print_table_of_run prints the table from its head to its end, and step_and_write_rows
 * takes the steps. In this file t is the table, s the stepper, o the options and c the checkpoint. A status is a code
 * of fvi/error.h, `failed` an exit code. */
#include "fvi_run.h"

#include "command_shared/fvi_run_rows.h"
#include "command_shared/fvi_run_start.h"
#include "command_shared/fvi_run_warn.h"
#include "fvi_checkpoint.h"
#include "options/fvi_values.h"
#include "output/fvi_complain.h"
#include "output/fvi_format.h"
#include "output/fvi_output.h"
#include "output/fvi_table.h"

#include <fvi/fvi.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

double *fvi_run_room(const fvi_table *t)
{
    const fvi_options *o = t->o;
    const fvi_system system = fvi_options_system(o);
    const fvi_run run = fvi_options_run(o, &system);
    const double search_bytes = 40 * (double)o->d * (double)o->steps; /* fvi_solve keeps all rows */
    return fvi_table_room(t, o->error > 0 ? search_bytes : fvi_run_bytes(o->method, &run));
}

/* The two checks along a run: of its step, and of the inertia of a Lagrangian. */
typedef struct {
    fvi_watch of_step;
    fvi_run_inertia of_inertia;
} run_checks;

/* After a step, warn if the run has become too stiff for its step or if the inertia of its Lagrangian vanishes. Return
 * FVI_SUCCESS or FVI_ENOMEM. */
static int check_step_and_inertia(run_checks *checks, const fvi_stepper *s)
{
    char text[FVI_WARNING_ROOM];
    int warned = fvi_warning_along(&checks->of_step, s->method, &s->run, s->k, s->x, sizeof text, text);
    if (warned > 0)
        fvi_warn(text);
    if (warned < 0)
        return FVI_ENOMEM;
    warned = fvi_run_check_inertia(&checks->of_inertia, s, text);
    if (warned > 0)
        fvi_warn(text);
    return warned < 0 ? FVI_ENOMEM : FVI_SUCCESS;
}

/* Print between which rows a step failed. If the run took too many steps, print how far it came. Return 1. */
static int print_stop(const fvi_options *o, const fvi_stepper *s, int status)
{
    fvi_step_statistics counts;
    if (status == s->run.failure->code)
        return fvi_stopped_by(s->k + 1, s->run.failure);
    if (status != FVI_ERUNAWAY || fvi_stepper_statistics(s, &counts))
        return fvi_stopped_at(s->k + 1, status);
    fvi_progress_clear();
    fprintf(stderr, "fvi: step %zu: t = %.10g after %zu steps%s\n", s->k + 1,
            s->t, counts.steps + counts.rejected,
            o->most_steps > 0
                ? ", and --most-steps allows no more"
                : ", of which the rest would take a million million at this "
                  "pace; --most-steps N would allow N");
    return 1;
}

/* Take a step and check the run. Return 0, or 1 after a message. */
static int take_step(fvi_table *t, fvi_stepper *s, run_checks *checks)
{
    const size_t before = s->k;
    int status = fvi_run_step(t, s);
    if (status) { /* if the step is taken all the same, a reduction failed after it */
        const int is_taken = s->k > before && !t->o->method->dense;
        return is_taken ? fvi_stopped_at(s->k, status) : print_stop(t->o, s, status);
    }
    status = check_step_and_inertia(checks, s);
    return status ? fvi_stopped_at(s->k, status) : 0;
}

/* Print the row of the current state, if the table begins with it. Return 0, or 1 after a message. */
static int print_first_row(fvi_table *t, fvi_stepper *s)
{
    int status = FVI_SUCCESS;
    if (t->begin == t->o->steps)
        fvi_table_mark_last(t);
    if (t->begin == s->k || t->begin == 0)
        status = fvi_run_row(t, s, t->begin);
    return status ? fvi_stopped_at(t->begin, status) : 0;
}

/* Print the rows from *next on that the run has reached. *next becomes the row after them; the last row stays. Return
 * 0, or 1 after a message. */
static int print_reached_rows(fvi_table *t, fvi_stepper *s, size_t *next)
{
    const size_t last = t->o->steps;
    for (; s->k >= *next; *next = fvi_table_next(t, *next)) {
        fvi_progress_clear(); /* the rows may go to the terminal that shows the progress */
        if (*next == last)
            fvi_table_mark_last(t);
        const int status = fvi_run_row(t, s, *next);
        if (status)
            return fvi_stopped_at(*next, status);
        if (*next == last)
            break;
    }
    return 0;
}

/* Run to the last step and print the rows. Return 0, or 1 after a message that names the step at which the run
 * ended. */
static int step_and_write_rows(fvi_table *t, fvi_stepper *s, run_checks *checks,
                               const fvi_checkpoint *c)
{
    const size_t steps = t->o->steps, d = t->o->d;
    /* For larger d there are fewer steps between two looks at the clock, because a step may cost d^3 operations. */
    const size_t steps_to_look = d < 32 ? 1024 / (d * d) : 1;
    size_t next_row = t->begin > 0 ? t->begin : fvi_table_next(t, 0),
           next_look = s->k + steps_to_look; /* a comparison, because a division at each step would cost more */
    if (print_first_row(t, s))
        return 1;
    while (s->k < steps && !fvi_stepper_is_over(s) && !ferror(t->out)
           && !fvi_checkpoint_stopped()) {
        if (take_step(t, s, checks))
            return 1;
        const int looks_now = s->k >= next_look;
        if (looks_now) {
            fvi_progress(s->k, steps);
            next_look = s->k + steps_to_look;
        }
        fvi_checkpoint_in_rows(1);
        if (print_reached_rows(t, s, &next_row))
            return 1;
        fvi_checkpoint_in_rows(0);
        if (looks_now && t->o->checkpoint && fvi_checkpoint_due()
            && fvi_checkpoint_write(c, t, s))
            return 1;
    }
    const int is_complete = s->k == steps || fvi_stepper_is_over(s);
    const int status = is_complete ? fvi_run_reductions(t) : FVI_SUCCESS;
    return status ? fvi_stopped_at(steps, status) : 0;
}

/* Print the warning of the step in the head of a table; "" is no warning. If the warning that there is no solution
 * is in the head already, this one gets another name, because a reader of JSON keeps one of two values with the
 * same name. */
static void print_step_warning(FILE *out, const fvi_options *o, const char *warning)
{
    if (*warning)
        fvi_format_parameter(out, o->format,
                             o->no_solution ? "warning of the step" : "warning",
                             warning);
}

void fvi_variable_step_head(FILE *out, const fvi_options *o, int stages,
                            char form, size_t steps)
{
    char text[32];
    snprintf(text, sizeof text, "%c, %d stages", form, stages);
    fvi_format_parameter(out, o->format, "form", text);
    if (steps == 0)
        return;
    snprintf(text, sizeof text, "%zu", steps);
    fvi_format_parameter(out, o->format, "steps taken", text);
}

/* Return the name of the solver of a step with matrices. It depends on which of M, C and K the matrix of a step
 * contains. */
static const char *solver_name(const fvi_options *o)
{
    const fvi_scheme scheme = o->method->scheme;
    const int stable = scheme == FVI_SCHEME_CQ2_MIDPOINT,
              staged = scheme == FVI_SCHEME_LOBATTO,
              uses_damping = stable || staged || scheme == FVI_SCHEME_CQ2_SHIFTED,
              uses_stiffness = stable || staged || (o->kappa > 0 && o->kappa < 1);
    const char *name = fvi_directory_solver(o->directory, 1, uses_damping, uses_stiffness);
    return staged && strcmp(name, "CHOLMOD") == 0 ? "UMFPACK" : name; /* the matrix of (27.14) is complex */
}

/* Write the rows between the head and the end: first the rows that were saved, then the rows of the run, with its
 * checkpoints. Return an exit code. */
static int write_rows_and_checkpoints(fvi_table *t, fvi_stepper *s, run_checks *checks,
                                      const fvi_checkpoint *c)
{
    if (!t->o->checkpoint)
        return step_and_write_rows(t, s, checks, c);
    int failed = fvi_checkpoint_rows(c, t);
    if (failed)
        return failed;
    fvi_checkpoint_watch();
    failed = step_and_write_rows(t, s, checks, c);
    if (!failed && !ferror(t->out))
        failed = fvi_checkpoint_write(c, t, s);
    fvi_checkpoint_unwatch();
    return failed;
}

void fvi_run_print_events(const fvi_table *t, size_t n, const fvi_event_time *at)
{
    if (!t->o->events)
        return;
    fvi_format_events_begin(t->out, t->o->format);
    for (size_t i = 0; i < n; i++)
        fvi_format_event(t->out, t->o->format, i, at[i].t,
                         fvi_typed_event_name(t->o->events, at[i].event),
                         at[i].at_rest     ? "at rest"
                         : at[i].lifts_off ? "lifts off"
                                           : NULL);
}

/* Print the head of the table, up to the names of the columns.
 *
 *   warning  the warning of the step, or ""
 *   solver   the name of the solver of a step with matrices, or NULL */
static void print_head(fvi_table *t, const fvi_stepper *s, const char *warning, const char *solver)
{
    const fvi_options *o = t->o;
    fvi_step_statistics counts;
    fvi_table_head(t->out, o);
    print_step_warning(t->out, o, warning);
    if (solver)
        fvi_format_parameter(t->out, o->format, "solver", solver);
    if (o->method->dense && fvi_stepper_statistics(s, &counts) == FVI_SUCCESS) {
        /* The number of steps is known only at the end of the run, so it is not in this head. */
        fvi_variable_step_head(t->out, o, counts.stages, counts.form, 0);
    }
    fvi_table_names(t);
}

/* Start the check of the inertia, and warn if it is singular at the start. Then print the rows. Return an exit code. */
static int write_checked_rows(fvi_table *t, fvi_stepper *s, run_checks *checks, const fvi_checkpoint *c)
{
    fvi_inertia_watch **watch = &checks->of_inertia.watch;
    char text[FVI_WARNING_ROOM];
    int failed = fvi_inertia_watch_begin(s->run.system, watch) ? fvi_complain("not enough memory") : 0;
    if (fvi_warning_of_inertia(*watch, s->t, s->x, s->p, sizeof text, text) > 0)
        fvi_warn(text);
    if (!failed)
        failed = write_rows_and_checkpoints(t, s, checks, c);
    fvi_inertia_watch_free(*watch);
    return failed;
}

/* Print the whole table of a run that has been started or goes on. Return an exit code. */
static int print_table_of_run(fvi_table *t, const fvi_run *r, fvi_stepper *s,
                              const fvi_checkpoint *c)
{
    const fvi_options *o = t->o;
    const char *solver = o->directory ? solver_name(o) : NULL;
    if (solver && !*solver)
        return fvi_complain("not enough memory");
    if (fvi_table_open(t))
        return 1;
    char step_warning[FVI_WARNING_ROOM];
    int failed = fvi_checkpoint_judge_rows(c, t) ? 2 : 0;
    if (!failed)
        failed = fvi_run_warn(o, r, sizeof step_warning, step_warning);
    if (failed) {
        fvi_table_close(t, 1);
        return failed;
    }
    print_head(t, s, step_warning, solver);
    run_checks checks = { .of_step = fvi_watch_begin(o->method, r, *step_warning != '\0') };
    failed = write_checked_rows(t, s, &checks, c);
    const int is_whole = !failed && !fvi_checkpoint_stopped();
    size_t event_count;
    const fvi_event_time *events = fvi_stepper_events(s, &event_count);
    if (!failed)
        fvi_run_print_events(t, event_count, events);
    failed = fvi_table_close(t, !is_whole);
    if (is_whole && !failed)
        failed = fvi_snapshot(o, s);
    fvi_checkpoint_end();
    return failed;
}

int fvi_command_run(const fvi_options *o, const fvi_system *system)
{
    fvi_run r = fvi_options_run(o, system);
    fvi_table t;
    fvi_checkpoint c = { .head = NULL };
    fvi_stepper *s = NULL;
    fvi_error error = { 0 }, failure = { 0 };
    int failed, status;
    r.failure = &failure;
    fvi_table_shape(&t, o, system);
    t.rows = fvi_run_room(&t);
    status = t.rows ? fvi_stepper_start(o->method, &r, &s, &error)
                    : fvi_no_memory(&error, NULL);
    if (!status)
        status = fvi_run_observe(&t, s, &error);
    if (status == FVI_EOVRFLW && s) /* the run has started, but a reduction is not finite */
        failed = fvi_stopped_at(0, status);
    else if (status)
        failed = fvi_complain_of_start(o, &error, "run");
    else
        failed = fvi_checkpoint_begin(&t, s, &c);
    if (!failed)
        failed = print_table_of_run(&t, &r, s, &c);
    fvi_observer_free(t.observer);
    fvi_stepper_free(s);
    fvi_checkpoint_free(&c);
    free(t.rows);
    return failed;
}
