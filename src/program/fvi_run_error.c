/* src/program/fvi_run_error.c -- The command `fvi run --error`. */
#include "output/fvi_complain.h"
#include <fvi/error.h>
#include <fvi/step_search.h>

#include "output/fvi_output.h"
#include "output/fvi_format.h"
#include "fvi_run.h"
#include "words/fvi_shortest.h"
#include "words/fvi_values.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

/* What a search found: one of a step, or of a method that chooses its steps. */
typedef struct {
    fvi_step_found step;
    fvi_adaptive_found adaptive;
} found_by;

enum { MOST_STEPS = 1 << 24 };

static int search(const fvi_options *o, const fvi_run *r, double *x, double *p,
                  found_by *found)
{
    const int terminal = isatty(STDERR_FILENO);
    if (terminal)
        fprintf(stderr, "looking for the step ...");
    int status = o->method->dense
                     ? fvi_adaptive_search(r, o->error, MOST_STEPS, x, p,
                                           &found->adaptive)
                     : fvi_step_search(o->method, r, o->error, MOST_STEPS, x, p,
                                       &found->step);
    if (terminal)
        fprintf(stderr, "\r\033[K");
    return status;
}

/* How near to the wanted error a search came. */
static void say_how_near(const fvi_options *o, const fvi_run *r,
                         const found_by *found)
{
    const int dense = o->method->dense != NULL;
    const double estimate =
        dense ? found->adaptive.estimate : found->step.estimate;
    const fvi_method *other =
        dense ? NULL : fvi_step_search_other(o->method, r);
    char with[80];
    if (!isfinite(estimate)) {
        fvi_complain("--error: no step gives a result that can be trusted");
        return;
    }
    if (dense)
        snprintf(with, sizeof with, "in %zu steps",
                 found->adaptive.counts.steps);
    else
        snprintf(with, sizeof with, "with the step %.4g",
                 o->h / (double)found->step.parts);
    fprintf(stderr,
            "fvi: --error: %g is out of reach; the smallest estimate was "
            "%.2g, %s%s%s\n",
            o->error, estimate, with, other ? "; try --method " : "",
            other ? other->name : "");
}

/* Find the step; say what was found, or how near it came. */
static int find_step(const fvi_options *o, const fvi_run *r, double *x,
                     double *p, found_by *found)
{
    int status = search(o, r, x, p, found);
    if (status == FVI_ETOL)
        say_how_near(o, r, found);
    else if (status == FVI_EMAXITER || status == FVI_EOVRFLW
             || (status == FVI_ESING && !o->directory))
        fvi_complain("--error: no step gives a result that can be trusted");
    else if (status)
        fvi_complain_of_start(o, status);
    else if (o->method->dense)
        fprintf(stderr, "fvi: the error of x is about %.2g, in %zu steps\n",
                found->adaptive.estimate, found->adaptive.counts.steps);
    else
        fprintf(stderr,
                "fvi: the error of x is about %.2g, with the step %.4g\n",
                found->step.estimate, o->h / (double)found->step.parts);
    return status != 0;
}

static void head_of_search(FILE *out, const fvi_options *o,
                           const found_by *found)
{
    const int dense = o->method->dense != NULL;
    char text[32];
    if (dense) {
        fvi_adaptive_head(out, o, &found->adaptive.counts);
    } else {
        fvi_shortest(o->h / (double)found->step.parts, text);
        fvi_format_parameter(out, o->format, "step", text);
    }
    snprintf(text, sizeof text, "%.2g",
             dense ? found->adaptive.estimate : found->step.estimate);
    fvi_format_parameter(out, o->format, "error estimate", text);
}

static int print_found(const fvi_options *o, const fvi_system *system,
                       const found_by *found, const double *x, const double *p)
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
        for (; k <= o->steps && !status && !ferror(t.out); k++)
            status = fvi_table_take(&t, k, x + k * o->d, p + k * o->d);
        failed =
            fvi_table_close(&t, status ? fvi_stopped_at(k - 1, status) : 0);
    }
    free(t.rows);
    return failed;
}

int fvi_command_error(const fvi_options *o, const fvi_system *system)
{
    const fvi_run r = fvi_options_run(o, system);
    found_by found;
    fvi_table t;
    fvi_table_shape(&t, o, system);
    double *rows =
        fvi_run_room(&t); /* is there enough, before anything is tried? */
    double *x = rows ? malloc(2 * (o->steps + 1) * o->d * sizeof *x) : NULL;
    free(rows);
    if (!x)
        return fvi_complain("not enough memory");
    double *p = x + (o->steps + 1) * o->d;
    int failed = find_step(o, &r, x, p, &found);
    if (!failed)
        failed = print_found(o, system, &found, x, p);
    free(x);
    return failed;
}
