/* src/program/fvi_fit.c -- The command `fvi fit`: parameters from a table. */
#include "fvi_fit.h"

#include <fvi/fvi.h>
#include "fvi_format.h"
#include "fvi_output.h"
#include "fvi_table.h"
#include "words/fvi_data.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define ALIKE 0.9 /* a correlation above this is worth a word */

static const char *const own_words[] = { "fit", "sigma", "starts", "curve",
                                         NULL };
typedef enum { FIT, SIGMA, STARTS, CURVE, OWN } own_index;

/* Of a run, and not of a fit, which takes its times from the data. */
static const char *const not_for_fit[] = { "steps",    "time",    "error",
                                           "damping",  "columns", "every",
                                           "format",   "plot",    "checkpoint",
                                           "continue", NULL };

/* What the words say, and what is read. */
typedef struct {
    const char *own[OWN], *data; /* the words */
    int has_step;
    fvi_options o;
    fvi_parameter which[FVI_FIT_MOST];
    const char *name[FVI_FIT_MOST];
    char names[80]; /* in pieces */
    fvi_fit fit;
    double low[FVI_FIT_MOST], high[FVI_FIT_MOST];
    double *t, *x, *curve;
} request;

/* ---- words ---- */

/* The number of this long option, "--name" or "--name=value", or -1. */
static int index_of(const char *word, const char *const *names)
{
    const size_t length = strcspn(word, "=");
    for (int i = 0; names[i]; i++)
        if (strncmp(word, "--", 2) == 0 && length == strlen(names[i]) + 2
            && strncmp(word + 2, names[i], length - 2) == 0)
            return i;
    return -1;
}

static int take_own(request *r, int which, const char *value, fvi_complaint c)
{
    if (!value)
        return fvi_refuse(c, "--%s: a value is missing", own_words[which]);
    if (r->own[which] && strcmp(r->own[which], value) != 0)
        return fvi_refuse(c, "--%s: given twice, as '%s' and as '%s'",
                          own_words[which], r->own[which], value);
    r->own[which] = value;
    return 0;
}

/* Words of `fit` into r; those that it shares with `run` into run, behind its name. */
static int sort_words(request *r, int argc, char **argv, char **run, int *count,
                      fvi_complaint c)
{
    static const char *const asked[] = { "method", "h", NULL };
    int has[2] = { 0, 0 }, status = 0;
    for (int i = 2; i < argc && !status; i++) {
        char *word = argv[i], *value = strchr(word, '=');
        const int own = index_of(word, own_words),
                  of_run = index_of(word, asked);
        if (own >= 0) {
            value = value ? value + 1 : i + 1 < argc ? argv[++i] : NULL;
            status = take_own(r, own, value, c);
        } else if (index_of(word, not_for_fit) >= 0) {
            status = fvi_refuse(c, "%s: not an option of this command", word);
        } else if (*word == '-') {
            if (of_run >= 0)
                has[of_run] = 1;
            run[(*count)++] = word;
            if (!value && i + 1 < argc)
                run[(*count)++] = argv[++i];
        } else if (r->data) {
            status = fvi_refuse(c, "'%s': not expected here", word);
        } else {
            r->data = word;
        }
    }
    r->has_step = has[1];
    if (!has[0])
        run[(*count)++] = "--method=fvi-lobatto4";
    return status;
}

/* ---- what is asked for ---- */

/* The constants of a potential by their names, NULL where there are no more: c, g, or
 * those of --let. */
static const char *constant_name(const fvi_options *o, size_t i)
{
    static const char *const c_and_g[] = { "c", "g", NULL };
    switch (o->potential) {
    case FVI_POTENTIAL_HARMONIC:
        return i == 0 ? "c" : NULL;
    case FVI_POTENTIAL_PENDULUM:
        return i == 0 ? "g" : NULL;
    case FVI_POTENTIAL_FREE:
    case FVI_POTENTIAL_SHARED:
        return NULL;
    case FVI_POTENTIAL_EXPRESSION:
        return i < o->lets.count ? o->lets.name[i] : NULL;
    default:
        return c_and_g[i];
    }
}

static int parameter_named(const request *r, const char *name,
                           fvi_parameter *which, fvi_complaint c)
{
    /* in the order of fvi_parameter, then the constants */
    const char *known[FVI_PARAMETER_CONSTANT + FVI_MOST_LETS + 1] = {
        "alpha", "rho", "mass", "x0", "p0"
    };
    size_t found = 0;
    for (size_t i = 0; constant_name(&r->o, i); i++)
        known[FVI_PARAMETER_CONSTANT + i] = constant_name(&r->o, i);
    const int status = fvi_word_choice("fit", name, known, &found, c);
    *which = (fvi_parameter)found;
    return status;
}

static int interpret_names(request *r, fvi_complaint c)
{
    const char *text = r->own[FIT] ? r->own[FIT] : "alpha,rho";
    if (strlen(text) >= sizeof r->names)
        return fvi_refuse(c, "--fit: '%s' is too long", text);
    strcpy(r->names, text);
    r->own[FIT] = text;
    for (char *at = r->names; at; r->fit.parameters++) {
        const size_t n = r->fit.parameters;
        char *comma = strchr(at, ',');
        if (comma)
            *comma++ = '\0';
        if (n == FVI_FIT_MOST)
            return fvi_refuse(c, "--fit: more than %d parameters",
                              FVI_FIT_MOST);
        if (parameter_named(r, at, &r->which[n], c))
            return 2;
        for (size_t i = 0; i < n; i++)
            if (r->which[i] == r->which[n])
                return fvi_refuse(c, "--fit: '%s' stands twice", at);
        if (r->which[n] == FVI_PARAMETER_ALPHA
            && r->o.method->alpha_least == r->o.method->alpha_most)
            return fvi_refuse(c, "--fit: 'alpha' is %g for %s, and no other",
                              r->o.method->alpha_least, r->o.method->name);
        r->name[n] = at;
        at = comma;
    }
    return 0;
}

static int interpret(request *r, fvi_complaint c)
{
    fvi_options *o = &r->o;
    r->fit = (fvi_fit){ .method = o->method,
                        .constants = o->expression ? o->lets.value : o->spring,
                        .which = r->which,
                        .h = r->has_step ? o->h : 0 };
    int status = interpret_names(r, c);
    if (!status && o->d != 1)
        status = fvi_refuse(c,
                            "--potential: '%s' has more masses than the one "
                            "column of a fit",
                            o->text[POTENTIAL]);
    if (!status && r->own[SIGMA])
        status = fvi_word_number("sigma", r->own[SIGMA], 0, INFINITY, "()",
                                 &r->fit.sigma, c);
    if (!r->own[STARTS])
        r->own[STARTS] = "20";
    if (!status)
        status = fvi_word_whole("starts", r->own[STARTS], 1000000,
                                &r->fit.starts, c);
    if (!status && r->fit.starts < 2)
        status = fvi_refuse(c,
                            "--starts: '%s' is less than 2: one start alone "
                            "proves nothing",
                            r->own[STARTS]);
    if (!status && r->own[CURVE] && !*r->own[CURVE])
        status = fvi_refuse(c, "--curve: '' is not a file's name");
    return status;
}

static int read_data(request *r, fvi_complaint c)
{
    static const char *const names[] = { "t", "x" };
    if (!r->data)
        return fvi_refuse(c,
                          "DATA: a file with the columns t and x is missing");
    int status =
        fvi_data_table("DATA", r->data, names, &r->fit.n, &r->t, &r->x, c);
    if (status)
        return status;
    r->fit.t = r->t;
    r->fit.x = r->x;
    if (r->t[0] < 0)
        return fvi_refuse(c, "--DATA: %s: t begins before 0, with %g", r->data,
                          r->t[0]);
    if (r->fit.n <= r->fit.parameters)
        return fvi_refuse(c,
                          "--DATA: %s: %zu rows are not enough for %zu "
                          "parameters",
                          r->data, r->fit.n, r->fit.parameters);
    r->curve = malloc(r->fit.n * sizeof *r->curve);
    if (!r->curve)
        fvi_refuse(c, "not enough memory");
    return r->curve ? 0 : 1;
}

/* ---- the answer ---- */

/* What the reader must know before he believes it; to the table and to standard error. */
static void warn(FILE *out, const char *text)
{
    fprintf(stderr, "fvi: warning: %s\n", text);
    fprintf(out, "# warning = %s\n", text);
}

static void warnings(FILE *out, const request *r, const fvi_fitted *f)
{
    char text[200];
    for (size_t i = 0; i < r->fit.parameters; i++)
        for (size_t j = 0; j < i; j++)
            if (fabs(f->correlation[i][j]) > ALIKE) {
                snprintf(text, sizeof text,
                         "these data can hardly tell %s and %s apart "
                         "(correlation %.3f)",
                         r->name[j], r->name[i], f->correlation[i][j]);
                warn(out, text);
            }
    if (fabs(f->neighbours) > 5 / sqrt((double)r->fit.n)) {
        snprintf(
            text, sizeof text,
            "neighbouring residuals are alike (correlation %.2f): the model, "
            "its past or its force is not that of the data, or their noise "
            "is not independent",
            f->neighbours);
        warn(out, text);
    }
    if (!(f->bias <= 0.02) && r->fit.h == 0) {
        snprintf(
            text, sizeof text,
            "half the step moved the estimates by %.2g sd: take a method of "
            "higher order",
            f->bias);
        warn(out, text);
    }
}

static void print_head(FILE *out, const request *r)
{
    const char *name, *value;
    fprintf(out, "# fvi " FVI_VERSION "\n");
    for (size_t i = 0; fvi_options_describe(&r->o, i, &name, &value); i++) {
        int is_of_fit = strcmp(name, "h") != 0 || r->has_step;
        for (size_t k = 0; not_for_fit[k]; k++)
            is_of_fit &= strcmp(name, not_for_fit[k]) != 0;
        if (is_of_fit)
            fprintf(out, "# %s = %s\n", name, value);
    }
    for (int i = 0; i < CURVE; i++)
        if (r->own[i])
            fprintf(out, "# %s = %s\n", own_words[i], r->own[i]);
    fprintf(out, "# data = %s\n# name\testimate\tsd\tlower\tupper\n", r->data);
}

static void print_answer(FILE *out, const request *r, const fvi_fitted *f)
{
    print_head(out, r);
    for (size_t j = 0; j < r->fit.parameters; j++) {
        const double reach = f->quantile * f->sd[j];
        fputs(r->name[j], out);
        fvi_print_number(out, "\t", f->estimate[j]);
        fvi_print_number(out, "\t", f->sd[j]);
        fvi_print_number(out, "\t", f->estimate[j] - reach);
        fvi_print_number(out, "\t", f->estimate[j] + reach);
        fputc('\n', out);
    }
    fvi_print_number(out, "# chi2 = ", f->chi2);
    if (r->fit.sigma > 0)
        fprintf(out, "\n# probability = %.3g", f->probability);
    else
        fvi_print_number(out, "\n# estimated sigma = ", f->sigma);
    fprintf(out, "\n# points = %zu\n# starts = %zu, %zu agree", r->fit.n,
            r->fit.starts, f->agree);
    fvi_print_number(out, "\n# step = ", f->h);
    for (size_t j = 0; j < r->fit.parameters; j++)
        for (size_t i = 0; i < j; i++) {
            fprintf(out, "\n# correlation %s %s", r->name[i], r->name[j]);
            fvi_print_number(out, " = ", f->correlation[i][j]);
        }
    fputc('\n', out);
    warnings(out, r, f);
}

static int print_curve(const request *r)
{
    if (!r->own[CURVE])
        return 0;
    FILE *out = fvi_output_open(r->own[CURVE]);
    if (!out)
        return fvi_cannot_write(r->own[CURVE]);
    fprintf(out, "# t\tdata\tfit\tresidual\n");
    for (size_t i = 0; i < r->fit.n; i++)
        fvi_format_row(
            out, FVI_FORMAT_TSV, i, 4,
            (double[]){ r->t[i], r->x[i], r->curve[i], r->x[i] - r->curve[i] });
    return fvi_output_close(out, 1) ? fvi_cannot_write(r->own[CURVE]) : 0;
}

/* Why there is no answer that can be believed. Returns 1. */
static int complain_of_fit(int status, const request *r, const fvi_fitted *f)
{
    const double freedom = (double)(r->fit.n - r->fit.parameters);
    if (status == FVI_EMAXITER)
        fprintf(stderr,
                "fvi: %zu of %zu starts agree on the best fit, which is not "
                "enough to believe it; try more --starts, or begin nearer\n",
                f->agree, r->fit.starts);
    else if (status == FVI_ETOL)
        fprintf(stderr,
                "fvi: chi2 = %.6g, where about %g is expected (probability "
                "%.1g): the model, its past, its force or --sigma is not that "
                "of the data\n",
                f->chi2, freedom, f->probability);
    else if (status == FVI_ESING)
        fprintf(stderr, "fvi: these data do not determine %s together%s\n",
                r->own[FIT],
                r->o.force == FVI_FORCING_NONE
                    ? "; without a force mass, rho, c, g and p0 are known but "
                      "for a common factor"
                    : "");
    else
        fvi_complain(status == FVI_EBADFUNC
                         ? "no start gives a motion that can be computed"
                     : status == FVI_ENOMEM ? "not enough memory"
                                            : fvi_strerror(status));
    return 1;
}

/* The box of the library, which knows nothing of the constants of an expression: they may
 * be ten times as large or as small as --let says, or have either sign. */
static int make_box(request *r)
{
    const int status = fvi_fit_box(&r->fit, r->low, r->high);
    for (size_t j = 0; j < r->fit.parameters && r->o.expression; j++)
        if (r->which[j] >= FVI_PARAMETER_CONSTANT) {
            const double k =
                r->o.lets.value[r->which[j] - FVI_PARAMETER_CONSTANT];
            r->low[j] = k > 0 ? k / 10 : k < 0 ? 10 * k : -1;
            r->high[j] = k > 0 ? 10 * k : k < 0 ? k / 10 : 1;
        }
    r->fit.low = r->low;
    r->fit.high = r->high;
    return status;
}

/* Answers that are not believed are shown on standard output alone. */
static int search_and_print(request *r)
{
    const fvi_system system = fvi_options_system(&r->o);
    fvi_run run = fvi_run_default(&system, r->o.x0, r->o.p0, 1, 1);
    run.alpha = r->o.alpha;
    run.kappa = r->o.kappa;
    run.past = r->o.past;
    run.memory = r->o.memory;
    run.tolerance = r->o.tolerance;
    r->fit.run = &run;
    fvi_fitted f = { .agree = 0 };
    const int terminal = isatty(STDERR_FILENO);
    if (terminal)
        fprintf(stderr, "looking for %s ...", r->own[FIT]);
    int status = make_box(r);
    if (!status)
        status = fvi_fit_search(&r->fit, r->curve, &f);
    if (terminal)
        fprintf(stderr, "\r\033[K");
    int failed = status != 0;
    if (!status
        || ((status == FVI_EMAXITER || status == FVI_ETOL) && !r->o.output)) {
        FILE *out = fvi_output_open(r->o.output);
        if (!out)
            return fvi_cannot_write(r->o.output);
        print_answer(out, r, &f);
        if (fvi_output_close(out, 1))
            failed = fvi_cannot_write(r->o.output);
    }
    if (status)
        return complain_of_fit(status, r, &f);
    return failed ? failed : print_curve(r);
}

/* ---- the command ---- */

static const char usage_fit[] =
    "usage: fvi fit [options] DATA\n"
    "the parameters of the motion that is nearest to a measured one; DATA is "
    "a\n"
    "table with the columns t and x (so named, or the first two), t >= 0\n"
    "  --fit LIST       of alpha,rho,mass,c,g,x0,p0, and the    [alpha,rho]\n"
    "                   names of --let\n"
    "  --sigma S        standard deviation of the noise         [estimated]\n"
    "  --starts K       searches, from K places; 2 must agree   [20]\n"
    "  --curve FILE     t, data, fit, residual\n"
    "  --h H            a step that is not halved               [found]\n"
    "and of run: --alpha --rho --mass --potential --x0 --p0 (what is not "
    "fitted;\n"
    "of what is, one of the starts) --let --force --derivative --kappa\n"
    "--memory --tolerance --method [fvi-lobatto4] -o\n"
    "\n"
    "example:\n"
    "  fvi fit --fit alpha,rho,x0 measured.tsv\n";

int fvi_is_fit(int argc, char **argv)
{
    return (argc > 1 && strcmp(argv[1], "fit") == 0)
           || (argc == 3 && strcmp(argv[1], "help") == 0
               && strcmp(argv[2], "fit") == 0);
}

static int is_help(int argc, char **argv)
{
    int help = strcmp(argv[1], "help") == 0;
    for (int i = 2; i < argc; i++)
        help |= strcmp(argv[i], "-h") == 0 || strcmp(argv[i], "--help") == 0;
    return help;
}

int fvi_command_fit(int argc, char **argv)
{
    char complaint[FVI_COMPLAINT] = "";
    const fvi_complaint c = { complaint, sizeof complaint };
    request r = { .data = NULL };
    int count = 2;
    if (is_help(argc, argv)) {
        fputs(usage_fit, stdout);
        return fvi_output_close(stdout, 1) ? fvi_cannot_write(NULL) : 0;
    }
    char **run = malloc(((size_t)argc + 2) * sizeof *run);
    if (!run)
        return fvi_complain("not enough memory");
    run[0] = argv[0];
    run[1] = "run";
    int status = sort_words(&r, argc, argv, run, &count, c);
    run[count] = NULL;
    if (!status)
        status =
            fvi_options_parse(count, run, &r.o, complaint, sizeof complaint);
    const int parsed = !status;
    if (!status)
        status = interpret(&r, c);
    if (!status)
        status = read_data(&r, c);
    if (status)
        fprintf(stderr, "fvi: %s\nTry 'fvi fit --help'.\n",
                complaint + 2 * (strncmp(complaint, "--DATA", 6) == 0));
    else
        status = search_and_print(&r);
    if (parsed)
        fvi_options_free(&r.o);
    free(r.t);
    free(r.curve);
    free(run);
    return status;
}
