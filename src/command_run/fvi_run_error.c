/* src/command_run/fvi_run_error.c -- Run the command `fvi run --error`. */
#include "fvi_run.h"

#include "command_shared/fvi_run_rows.h"
#include "command_shared/fvi_run_search.h"
#include "command_shared/fvi_run_start.h"
#include "command_shared/fvi_run_warn.h"
#include "options/fvi_option_columns.h"
#include "options/fvi_values.h"
#include "output/fvi_complain.h"
#include "output/fvi_format.h"
#include "output/fvi_output.h"

#include <fvi/error.h>
#include <fvi/format_double.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

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

/* Write, for example, "1.9e-07, with the step 9.537e-07". */
static void describe_error(const fvi_report *found, size_t size, char *text)
{
    if (found->method->dense)
        snprintf(text, size, "%.2g, in %zu steps", found->error, found->steps);
    else
        snprintf(text, size, "%.2g, with the step %.4g", found->error,
                 found->h);
}

/* Print how near the search came to the wanted error. Another method is advised only after it has been tried. x and p
 * are room for the rows of that trial, which are not printed. */
static void print_nearest_error(const fvi_options *o, const fvi_run *r, double *x,
                                double *p, const fvi_report *found)
{
    char own[80], others[80], advice[160] = "";
    describe_error(found, sizeof own, own);
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
        describe_error(&tried, sizeof others, others);
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

/* Print why the search could not begin. Return an exit code. */
static int complain_of_search(const fvi_options *o, const fvi_run *r, int status)
{
    fvi_error error;
    fvi_reason_of_start(o, r, status, &error);
    return fvi_complain_of_start(o, &error, "run");
}

/* Find the step. Print the error that was reached, or how near the search came. Return an exit code. */
static int find_step(const fvi_options *o, const fvi_run *r, double *x,
                     double *p, double *typed, fvi_report *found, fvi_run_events *events)
{
    int status = search(o, o->method, r, x, p, typed, found, events);
    if (status == FVI_ETOL)
        print_nearest_error(o, r, x, p, found);
    else if (status == FVI_EMAXITER || status == FVI_EOVRFLW
             || (status == FVI_ESING && !o->directory))
        fvi_complain("--error: no step gives a result that can be trusted");
    else if (status)
        return complain_of_search(o, r, status);
    if (!status) {
        char text[80];
        describe_error(found, sizeof text, text);
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

static int print_found(fvi_table *t, const fvi_report *found, const double *x,
                       const double *p, const double *typed, const fvi_run_events *events)
{
    if (fvi_table_open(t))
        return 1;
    fvi_table_head(t->out, t->o);
    head_of_search(t->out, t->o, found);
    fvi_table_names(t);
    int status = 0;
    size_t k = 0;
    for (; k < found->rows && !status && !ferror(t->out); k++)
        status = fvi_run_found_row(t, k, x, p, typed);
    if (!status)
        status = fvi_run_reductions(t);
    if (!status)
        fvi_run_print_events(t, events->count, events->at);
    return fvi_table_close(t, status ? fvi_stopped_at(k - 1, status) : 0);
}

/* If a mechanism or its start is wrong, print the message of fvi_stepper_start, which names the field. Return an exit
 * code. */
static int check_start(const fvi_options *o, const fvi_run *r)
{
    fvi_error error = { 0 };
    fvi_stepper *s;
    if (!o->mechanism)
        return 0;
    return fvi_stepper_start(o->method, r, &s, &error) ? fvi_complain_of_start(o, &error, "run")
                                                       : fvi_stepper_free(s);
}

/* Warn if the inertia of a Lagrangian vanishes between the rows. Return an exit code. */
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
    /* The room for the output is allocated first, so that a lack of memory is found before the search. */
    t.rows = fvi_run_room(&t);
    const size_t count = o->steps + 1,
                 width = 2 * o->d + fvi_typed_columns_count(o->typed);
    double *x = t.rows ? malloc(count * width * sizeof *x) : NULL;
    if (!x) {
        free(t.rows);
        return fvi_complain("not enough memory");
    }
    double *p = x + count * o->d, *typed = p + count * o->d;
    fvi_run_events events = { 0 };
    int failed = find_step(o, &r, x, p, typed, &found, &events);
    if (!failed)
        failed = fvi_run_warn_of_memory(o, &r) || warn_of_inertia(o, system, found.rows, x, p);
    if (!failed)
        failed = print_found(&t, &found, x, p, typed, &events);
    free(events.at);
    free(x);
    free(t.rows);
    return failed;
}
