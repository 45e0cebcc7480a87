/* src/program/fvi_cli.c -- Run the program build/fvi. */
#define _GNU_SOURCE
#include "command_exact/fvi_exact.h"
#include "command_fit/fvi_fit.h"
#include "command_gradient/fvi_gradient.h"
#include "command_response/fvi_response.h"
#include "command_run/fvi_run.h"
#include "command_sweep/fvi_sweep.h"
#include "fvi_usage.h"
#include "input/fvi_problem_words.h"
#include "options/fvi_checks.h"
#include "options/fvi_option_columns.h"
#include "options/fvi_options.h"
#include "options/fvi_values.h"
#include "output/fvi_complain.h"
#include "output/fvi_format.h"
#include "output/fvi_output.h"
#include "output/fvi_table.h"

#include <fvi/coefficients.h>
#include <fvi/error.h>
#include <fvi/formulas.h>
#include <fvi/methods.h>

#include <fcntl.h>
#include <signal.h>
#include <stdlib.h>

/* Print the head and the weights, one line for each weight. */
static int coefficients(const fvi_options *o)
{
    const double bytes = 8 * (double)o->count;
    double *w =
        bytes < fvi_machine_bytes() ? malloc(o->count * sizeof *w) : NULL;
    if (!w)
        return fvi_complain("not enough memory");
    fvi_gl_weights(o->alpha, o->count, w);
    FILE *out = fvi_output_open(o->output);
    int failed = !out;
    if (out) {
        fvi_table_head(out, o);
        fvi_format_name(out, o->format, 0, "n", 0);
        fvi_format_name(out, o->format, 1, "w_n", 0);
        fvi_format_names_end(out, o->format);
        for (size_t n = 0; n < o->count && !ferror(out); n++)
            fvi_format_row(out, o->format, n, 2, (double[]){ (double)n, w[n] });
        fvi_format_end(out, o->format);
        failed = fvi_output_close(out, 1) != 0;
    }
    free(w);
    return failed ? fvi_cannot_write(o->output) : 0;
}

static int print_methods(void)
{
    for (size_t i = 0; fvi_methods[i]; i++) {
        const fvi_method *m = fvi_methods[i];
        printf("%s\t%s\t%s\n", m->name, m->order, m->memory);
    }
    return fvi_output_close(stdout, 1) ? fvi_cannot_write(NULL) : 0;
}

static int print_text(const char *text, const char *more)
{
    fputs(text, stdout);
    fputs(more, stdout);
    return fvi_output_close(stdout, 1) ? fvi_cannot_write(NULL) : 0;
}

/* Print the options of run, the formulas of their words, and examples. */
static int print_help_of_run(void)
{
    const size_t size = fvi_formulas_write(0, NULL) + 1;
    char *formulas = malloc(size);
    if (!formulas)
        return fvi_complain("not enough memory");
    fvi_formulas_write(size, formulas);
    fputs(usage_run, stdout);
    fputs(usage_run_rest, stdout);
    const int failed = print_text(formulas, usage_run_examples);
    free(formulas);
    return failed;
}

/* Call a command that needs the system of the options. */
static int with_system(const fvi_options *o,
                       int (*command)(const fvi_options *, const fvi_system *))
{
    const fvi_system system = fvi_options_system(o);
    return command(o, &system);
}

int main(int argc, char **argv)
{
    fvi_options o;
    fvi_error error;
    for (int fd = 0; fd < 3; fd++) /* otherwise an output could get descriptor 2, standard error */
        if (fcntl(fd, F_GETFD) < 0 && open("/dev/null", O_RDONLY) != fd)
            return 1;
    signal(SIGCHLD, SIG_DFL); /* if it is ignored, waitpid cannot ask a child that has ended */
    int status = fvi_problem_words(&argc, &argv, &error);
    if (status) /* at most the command is known */
        return fvi_refused(&error, fvi_command_of_word(argc > 1 ? argv[1] : ""));
    status = fvi_options_parse(argc, argv, &o, &error);
    if (status)
        return fvi_refused(&error, fvi_command_name(o.command));
    switch (o.command) {
    case FVI_COMMAND_SWEEP:
        return fvi_command_sweep(argc, argv);
    case FVI_COMMAND_FIT:
        return fvi_command_fit(argc, argv);
    case FVI_COMMAND_GRADIENT:
        return fvi_command_gradient(argc, argv);
    case FVI_COMMAND_RESPONSE:
        return fvi_command_response(argc, argv);
    case FVI_COMMAND_POLES:
        return fvi_command_poles(argc, argv);
    case FVI_COMMAND_RUN:
        if (fvi_options_check_reduced(&o, &error) || fvi_check_forces(&o, o.steps, &error)) {
            status = fvi_refused(&error, "run");
            break;
        }
        status =
            with_system(&o, o.error > 0 ? fvi_command_error : fvi_command_run);
        break;
    case FVI_COMMAND_EXACT:
        status = with_system(&o, fvi_command_exact);
        break;
    case FVI_COMMAND_COEFFICIENTS:
        status = coefficients(&o);
        break;
    case FVI_COMMAND_METHODS:
        status = print_methods();
        break;
    case FVI_COMMAND_VERSION:
        status = print_text("fvi " FVI_VERSION, "\n");
        break;
    default:
        status = o.about == FVI_COMMAND_RUN ? print_help_of_run() :
                 print_text(o.about == FVI_COMMAND_EXACT      ? usage_exact
                            : o.about == FVI_COMMAND_SWEEP    ? usage_sweep
                            : o.about == FVI_COMMAND_FIT      ? usage_fit
                            : o.about == FVI_COMMAND_GRADIENT ? usage_gradient
                            : o.about == FVI_COMMAND_RESPONSE ? usage_response
                            : o.about == FVI_COMMAND_POLES    ? usage_poles
                            : o.about == FVI_COMMAND_COEFFICIENTS
                                ? usage_coefficients
                                : usage,
                            "");
    }
    fvi_options_free(&o);
    return status;
}
