/* src/command_fit/fvi_fit.c -- Run the command `fvi fit`: find parameters from a table. */
#include "fvi_fit.h"

#include "fvi_fit_answer.h"
#include "fvi_fit_records.h"
#include "fvi_fit_material.h"
#include "command_shared/fvi_run_warn.h"
#include "output/fvi_complain.h"
#include "output/fvi_output.h"
#include "input/fvi_files.h"
#include "input/fvi_problem_words.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* Options of `fvi run` that a fit does not have, mostly because it takes its times from the data. */
static const char *const not_for_fit[] = { "steps",      "time",     "error",
                                           "step-error", "columns", "reduce",
                                           "every",      "format",   "plot",
                                           "checkpoint", "continue", "unknowns",
                                           "snapshot",   "longest",  "v0",
                                           "event",      NULL };

/* The methods that are used if none is named. Of the methods with stages, form D takes matrices. */
static char *const usual_method[] = { "--method=fvi-lobatto4", NULL },
                  *const method_of_matrices[] = { "--method=fvi-lobatto4d", NULL };

static const fvi_own_command fit = {
    .name = "fit",
    .own = { "fit", "sigma", "starts", "compare", "huber", "curve" },
    .without = not_for_fit,
    .no_events = "a fit follows derivatives, and none goes through an event",
    .operand = FVI_OPERANDS_MOST,
    .flag = "design",
    .presets = usual_method,
    .more = fvi_fit_time
};

/* The same for a plan (--design). A plan has no DATA: its times are those of --steps and --time. */
static const char *const not_for_design[] = { "error",      "step-error", "columns", "reduce",
                                              "ground",     "along",      "format",  "plot",
                                              "checkpoint", "continue",   "system",  "unknowns",
                                              "snapshot",   "longest",    "v0",      "event",
                                              NULL };

typedef fvi_fit_request request;

/* ---- what is asked for ---- */

/* Refuse a body of several masses unless --compare says which coordinates the data show. */
static int check_columns(const request *r, fvi_error *c)
{
    const fvi_options *o = &r->o;
    const option_index by = o->text[SYSTEM] ? SYSTEM : o->text[DIMENSION] ? DIMENSION : POTENTIAL;
    if (r->columns || o->d == 1)
        return 0;
    if (r->words.flag)
        return fvi_refuse(c, fvi_option_list[by].name,
                          "'%s' has %zu masses: --design plans a test of one column, x of one mass",
                          o->text[by], o->d);
    return fvi_refuse(c, fvi_option_list[by].name,
                      "'%s' has %zu masses: --compare says what the columns of DATA show, as in --compare x1,x2",
                      o->text[by], o->d);
}

/* Refuse options that a plan does not use. */
static int check_plan(const request *r, fvi_error *c)
{
    static const int none_of[] = { STARTS, COMPARE, HUBER };
    for (size_t i = 0; i < sizeof none_of / sizeof *none_of; i++)
        if (r->words.own[none_of[i]])
            return fvi_refuse(c, fit.own[none_of[i]],
                              none_of[i] == STARTS
                                  ? "not together with --design, which fits nothing"
                                  : "not together with --design, which is of one column by least "
                                    "squares");
    return 0;
}

/* Choose form D of the methods with stages if a coordinate has no inertia and no method is named. The preset method has
 * form M, which has no step for such a coordinate. */
static void choose_form(request *r)
{
    const fvi_mechanism *mechanism = r->system.mechanism;
    int is_massless = 0;
    for (size_t i = 0; i < r->system.d && mechanism && !mechanism->lagrangian; i++)
        is_massless |= !r->system.matrices && r->system.mass[i] == 0;
    if (!is_massless || r->words.given[METHOD])
        return;
    r->o.method = &fvi_lobatto_d4;
    r->o.text[METHOD] = r->o.method->name;
}

static int interpret(request *r, fvi_error *c)
{
    fvi_options *o = &r->o;
    const int has_step = r->words.given[H] && !r->words.flag;
    r->system = fvi_options_system(o);
    choose_form(r);
    r->run = fvi_options_run(o, &r->system);
    r->fit = (fvi_estimation){ .method = o->method,
                        .run = &r->run,
                        .constants = fvi_fit_has_lets(o) ? o->lets.value
                                                      : o->potential.constants,
                        .which = r->which,
                        .h = has_step ? o->h : 0 };
    if (!has_step && !r->words.flag)
        o->text[H] = NULL; /* the step will be found, so it is not in the head */
    int status = fvi_fit_columns(r, c);
    if (!status)
        status = fvi_fit_names(r, c);
    if (!status)
        status = check_columns(r, c);
    if (!status)
        status = fvi_fit_sigma(r, c);
    if (!status && r->words.own[HUBER])
        status = fvi_parse_number("huber", r->words.own[HUBER], 0, INFINITY, "()", &r->fit.huber, c);
    if (!status && r->words.flag)
        return check_plan(r, c);
    if (!status)
        status = fvi_fit_starts(&r->words.own[STARTS], 1000000, &r->fit.starts, c);
    return status ? status : fvi_check_second_file("curve", r->words.own[CURVE], o->output, c);
}

/* Choose the method that suits the data, unless an option says something about the steps. */
static void choose_steps(request *r)
{
    static const option_index of_steps[] = { METHOD, H, KAPPA, MEMORY, TOLERANCE };
    for (size_t i = 0; i < sizeof of_steps / sizeof *of_steps; i++)
        if (r->words.given[of_steps[i]])
            return;
    const fvi_method *best = fvi_estimate_method(&r->fit);
    if (!best) /* the search will say why this cannot be fitted */
        return;
    r->o.method = r->fit.method = best;
    r->o.text[METHOD] = best->name;
}

/* Check --force as fvi_check_force_of_fit does. */
static int check_force(const request *r, fvi_error *c)
{
    const fvi_options *o = &r->o;
    return fvi_check_force_of_fit(&r->fit, "force", o->text[FORCE], o->force, c);
}

/* Return nonzero if a record of the data has its own start. */
static int has_own_start(const request *r)
{
    for (size_t i = 0; i < r->fit.records; i++)
        if (r->fit.record[i].x0 || r->fit.record[i].p0)
            return 1;
    return 0;
}

/* Start a run with the numbers of the options, and refuse what no search can mend: the method does not take the system,
 * or a p0 that is not fitted breaks a constraint. A plan is refused for any error, because it has no other numbers. */
static int check_start(const request *r, fvi_error *c)
{
    fvi_stepper *s = NULL;
    const int status = fvi_stepper_start(r->fit.method, &r->run, &s, c);
    fvi_stepper_free(s);
    if (!status || (has_own_start(r) && status != FVI_EUNSUP))
        return 0;
    const int is_of_p0 = r->system.mechanism && c->field && strcmp(c->field, "p0") == 0;
    return status == FVI_EUNSUP || r->words.flag || is_of_p0 ? status : 0;
}

static int read_data(request *r, fvi_error *c)
{
    const int status = fvi_fit_read(r, c);
    if (status)
        return status;
    choose_steps(r);
    r->curve = malloc(r->points * sizeof *r->curve);
    return r->curve ? 0
                    : fvi_no_memory(c, NULL);
}

/* ---- the search ---- */

/* Take the box of the library. It knows no bounds for the constants of an expression, so they are set here: from a
 * tenth to ten times the value of --let, or from -1 to 1 if that is 0. */
static int make_box(request *r)
{
    const int status = fvi_estimate_box(&r->fit, r->low, r->high);
    for (size_t j = 0; j < r->fit.parameters && fvi_fit_has_lets(&r->o); j++)
        if (r->which[j] >= FVI_FREE_PARAMETER_CONSTANT
            && r->which[j] < FVI_FREE_PARAMETER_CONSTANT + FVI_MOST_USER_PARAMETERS) {
            const double k =
                r->o.lets.value[r->which[j] - FVI_FREE_PARAMETER_CONSTANT];
            r->low[j] = k > 0 ? k / 10 : k < 0 ? 10 * k : -1;
            r->high[j] = k > 0 ? 10 * k : k < 0 ? k / 10 : 1;
        }
    r->fit.low = r->low;
    r->fit.high = r->high;
    return status;
}

/* Search for the parameters, and examine whether the answer can be believed. */
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

/* Print the answer. An answer that is not believed goes to standard output only. If a file was asked for, the flags of
 * such an answer go to standard error. Return an exit code. */
static int search_and_print(request *r)
{
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
        fvi_fit_print_flags(NULL, r, &f, &e);
    if (status)
        return fvi_fit_complain(status, r, &f);
    if (!is_believed)
        return fvi_fit_tell_unwritten(r->o.output, r->words.own[CURVE]);
    return failed ? failed : fvi_fit_print_curve(r);
}

/* ---- a plan ---- */

/* Make the times of the plan: the steps k, 2 k, ... of --every k. Return 0, or a code with the error filled in. */
static int planned_times(request *r, fvi_error *c)
{
    const fvi_options *o = &r->o;
    const size_t n = o->steps / o->every;
    if (r->words.own[CURVE])
        return fvi_refuse(c, "curve", "not together with --design, which fits nothing");
    if (!r->words.own[SIGMA])
        return fvi_refuse(c, "sigma", "is missing: a plan needs the noise that is expected");
    if (n <= r->fit.parameters)
        return fvi_refuse(c, "steps", "%zu rows are not enough for %zu parameters", n, r->fit.parameters);
    r->t = malloc(n * sizeof *r->t);
    if (!r->t)
        return fvi_no_memory(c, NULL);
    for (size_t i = 0; i < n; i++)
        r->t[i] = (double)((i + 1) * o->every) * o->h;
    r->fit.t = r->t;
    r->fit.n = n;
    return 0;
}

static int print_plan(request *r, const fvi_own_command *command)
{
    fvi_estimate f = { .agree = 0 };
    fvi_examination e;
    const int status = fvi_estimate_design(&r->fit, &f, &e);
    if (status == FVI_EDOM)
        return fvi_complain("a value that is to be fitted is at the end of its range");
    if (status)
        return fvi_fit_complain(status, r, &f);
    FILE *out = fvi_output_open(r->o.output);
    if (!out)
        return fvi_cannot_write(r->o.output);
    fvi_subcommand_options_head(out, command, &r->words, &r->o);
    fvi_fit_print_plan(out, r, &f, &e);
    return fvi_output_close(out, 1) ? fvi_cannot_write(r->o.output) : 0;
}

static int has_option(int argc, char **argv, const char *name)
{
    for (int i = 2; i < argc && strcmp(argv[i], "--") != 0; i++)
        if (fvi_word_is_option(argv[i], name))
            return 1;
    return 0;
}

/* ---- the command ---- */

/* Refuse options that only the fit of a material has. */
static int check_words_of_material(int argc, char **argv, fvi_error *c)
{
    static const char *const names[] = { "law", "weights" };
    for (int i = 2; i < argc && strcmp(argv[i], "--") != 0; i++)
        for (size_t n = 0; n < sizeof names / sizeof *names; n++)
            if (fvi_word_is_option(argv[i], names[n]))
                return fvi_refuse(c, names[n], "goes with --moduli, --creep or --relaxation alone");
    return 0;
}

int fvi_command_fit(int argc, char **argv)
{
    if (fvi_fit_is_material(argc, argv))
        return fvi_fit_material(argc, argv);
    fvi_error error, *c = &error;
    request r = { .t = NULL };
    const int is_plan = has_option(argc, argv, "design");
    int status = check_words_of_material(argc, argv, c);
    fvi_own_command command = fit;
    if (is_plan) {
        command.without = not_for_design;
        command.operand = 0;
        command.more = NULL;
    }
    if (has_option(argc, argv, "system"))
        command.presets = method_of_matrices;
    if (!status)
        status = fvi_subcommand_options_parse(&command, argc, argv, &r.words, &r.o, c);
    if (!status)
        status = interpret(&r, c);
    if (!status)
        status = is_plan ? planned_times(&r, c) : read_data(&r, c);
    if (!status)
        status = fvi_fit_check_outputs(&r, c);
    if (!status)
        status = check_start(&r, c);
    if (!status)
        status = check_force(&r, c);
    status = status                                 ? fvi_refused(&error, fit.name)
             : fvi_run_warn_of_memory(&r.o, &r.run) ? 1
             : is_plan                              ? print_plan(&r, &command)
                                                    : search_and_print(&r);
    fvi_fit_records_free(&r);
    fvi_options_free(&r.o);
    free(r.t);
    free(r.curve);
    return status;
}
