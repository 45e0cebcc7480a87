/* src/program/fvi_fit.c -- The command `fvi fit`: parameters from a table. */
#include "fvi_commands.h"

#include "fvi_fit_answer.h"
#include "fvi_fit_material.h"
#include "output/fvi_complain.h"
#include "output/fvi_output.h"
#include "input/fvi_files.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* Of a run, and not of a fit, which takes its times from the data. */
static const char *const not_for_fit[] = { "steps",      "time",     "error",
                                           "step-error", "columns", "reduce",
                                           "ground",     "along",
                                           "every",      "format",   "plot",
                                           "checkpoint", "continue", "system",
                                           "unknowns",   "snapshot", "longest",
                                           "lagrangian", "damper",   "constraint",
                                           "impose",     "force-on", "v0",
                                           NULL };

static const fvi_own_command fit = {
    .name = "fit",
    .own = { "fit", "sigma", "starts", "curve" },
    .without = not_for_fit,
    .method = "--method=fvi-lobatto4",
    .operand = 1
};

typedef fvi_fit_request request;

/* ---- what is asked for ---- */

static int interpret(request *r, fvi_error *c)
{
    fvi_options *o = &r->o;
    r->fit = (fvi_estimation){ .method = o->method,
                        .constants = o->potential.expression ? o->lets.value
                                                      : o->potential.constants,
                        .which = r->which,
                        .h = r->words.given[H] ? o->h : 0 };
    if (!r->words.given[H])
        o->text[H] = NULL; /* it is found: not in the head */
    int status = fvi_fit_names(r, c);
    const int by_number = o->text[DIMENSION] != NULL;
    if (!status && o->d != 1)
        status = fvi_refuse(c,
                            by_number ? "dimension" : "potential", "'%s' has more masses than the one column of "
                            "a fit",
                            o->text[by_number ? DIMENSION : POTENTIAL]);
    if (!status && r->words.own[SIGMA])
        status = fvi_parse_number("sigma", r->words.own[SIGMA], 0, INFINITY,
                                 "()", &r->fit.sigma, c);
    if (!r->words.own[STARTS])
        r->words.own[STARTS] = "20";
    if (!status)
        status = fvi_parse_whole("starts", r->words.own[STARTS], 1000000,
                                &r->fit.starts, c);
    if (!status && r->fit.starts < 2)
        status = fvi_refuse(c,
                            "starts", "'%s' is less than 2: one start alone "
                            "proves nothing",
                            r->words.own[STARTS]);
    if (!status && r->words.own[CURVE] && !*r->words.own[CURVE])
        status = fvi_refuse(c, "curve", "'' is not a file's name");
    if (!status && r->words.own[CURVE]
        && fvi_same_file(r->words.own[CURVE], o->output))
        status = fvi_refuse(c, "curve", "'%s' is the table's file, too",
                            r->words.own[CURVE]);
    return status;
}

static int read_data(request *r, fvi_error *c)
{
    static const char *const names[] = { "t", "x" };
    if (!r->words.operand)
        return fvi_refuse(c,
                          NULL, "DATA: a file with the columns t and x is missing");
    fvi_mark_read("DATA", r->words.operand);
    int status = fvi_check_output("-o", r->o.output, c);
    if (!status)
        status = fvi_check_output("--curve", r->words.own[CURVE], c);
    if (!status)
        status = fvi_parse_table("DATA", r->words.operand, names, &r->fit.n,
                                &r->t, &r->x, c);
    if (status)
        return status;
    r->fit.t = r->t;
    r->fit.x = r->x;
    if (r->t[0] < 0)
        return fvi_refuse(c, "DATA", "%s: t begins before 0, with %g",
                          r->words.operand, r->t[0]);
    if (r->fit.n <= r->fit.parameters)
        return fvi_refuse(c,
                          "DATA", "%s: %zu rows are not enough for %zu "
                          "parameters",
                          r->words.operand, r->fit.n, r->fit.parameters);
    r->curve = malloc(r->fit.n * sizeof *r->curve);
    return r->curve ? 0
                    : fvi_fail(c, FVI_ENOMEM, NULL, NAN, "not enough memory");
}

/* ---- the search ---- */

/* The box of the library, which knows nothing of the constants of an expression: they may
 * be ten times as large or as small as --let says, or have either sign. */
static int make_box(request *r)
{
    const int status = fvi_estimate_box(&r->fit, r->low, r->high);
    for (size_t j = 0; j < r->fit.parameters && r->o.potential.expression; j++)
        if (r->which[j] >= FVI_FREE_PARAMETER_CONSTANT) {
            const double k =
                r->o.lets.value[r->which[j] - FVI_FREE_PARAMETER_CONSTANT];
            r->low[j] = k > 0 ? k / 10 : k < 0 ? 10 * k : -1;
            r->high[j] = k > 0 ? 10 * k : k < 0 ? k / 10 : 1;
        }
    r->fit.low = r->low;
    r->fit.high = r->high;
    return status;
}

/* The search, and whether its answer can be believed. */
static int search(request *r, fvi_estimate *f, fvi_examination *e)
{
    const int terminal = isatty(STDERR_FILENO);
    if (terminal)
        fprintf(stderr, "looking for %s ...", r->words.own[FIT]);
    int status = make_box(r);
    if (!status)
        status = fvi_estimate_multistart(&r->fit, r->curve, f);
    if (!status || status == FVI_EMAXITER || status == FVI_ETOL) {
        const int failed = fvi_estimate_examine(&r->fit, f, e);
        status = failed ? failed : status;
    }
    if (terminal)
        fprintf(stderr, "\r\033[K");
    return status;
}

/* Answers that are not believed are shown on standard output alone; where a file was asked for
 * the flags are said without it. */
static int search_and_print(request *r)
{
    const fvi_system system = fvi_options_system(&r->o);
    const fvi_run run = fvi_options_run(&r->o, &system);
    r->fit.run = &run;
    fvi_estimate f = { .agree = 0 };
    fvi_examination e = { .flags = 0 };
    const int status = search(r, &f, &e), is_believed = !status && !e.grave;
    int failed = !is_believed;
    if (is_believed || ((!status || status == FVI_EMAXITER || status == FVI_ETOL) && !r->o.output)) {
        FILE *out = fvi_output_open(r->o.output);
        if (!out)
            return fvi_cannot_write(r->o.output);
        fvi_subcommand_options_head(out, &fit, &r->words, &r->o);
        fvi_fit_print_answer(out, r, &f, &e);
        if (fvi_output_close(out, 1))
            failed = fvi_cannot_write(r->o.output);
    } else if (!status)
        fvi_fit_warn_of_flags(r, &f, &e);
    if (status)
        return fvi_fit_complain(status, r, &f);
    return failed ? failed : fvi_fit_print_curve(r);
}

/* ---- the command ---- */

int fvi_command_fit(int argc, char **argv)
{
    if (fvi_fit_is_material(argc, argv))
        return fvi_fit_material(argc, argv);
    fvi_error error, *c = &error;
    request r = { .t = NULL };
    int status = fvi_subcommand_options_parse(&fit, argc, argv, &r.words, &r.o, c);
    const int parsed = !status;
    if (!status)
        status = interpret(&r, c);
    if (!status)
        status = read_data(&r, c);
    if (status)
        status = fvi_refused(&error, fit.name);
    else
        status = search_and_print(&r);
    if (parsed)
        fvi_options_free(&r.o);
    free(r.t);
    free(r.curve);
    return status;
}
