/* src/fvi_cli.c -- The program build/fvi. */
#define _GNU_SOURCE
#include "coefficients.h"
#include "discrete_mechanics.h"
#include "fvi.h"
#include "fvi_options.h"
#include "fvi_output.h"
#include "stability.h"

#include <errno.h>
#include <gsl/gsl_errno.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#define FVI_VERSION "0.1.0"

static const char usage[] =
    "usage: fvi run [options]            one trajectory, as a table\n"
    "       fvi coefficients [options]   n, alpha_n\n"
    "       fvi methods                  name, order, memory of each method\n"
    "       fvi --help | --version       also: fvi run --help\n"
    "\n"
    "m x'' + grad U(x) + rho D^{2 alpha} x = F(t), stepped by a variational\n"
    "integrator with its whole memory.\n";

static const char usage_run[] =
    "usage: fvi run [options]\n"
    "  --method M       fvi, lda, euler-explicit, euler-implicit      [fvi]\n"
    "  --alpha A        damping of order 2A, 0 <= A <= 1              [0.5]\n"
    "  --rho R          damping, R >= 0                               [0.2]\n"
    "  --mass M         mass, M > 0                                   [1]\n"
    "  --potential P    harmonic:C  duffing:C,G  pendulum:G  free\n"
    "                   chain:D,C,G (D masses between two walls)      "
    "[harmonic:1]\n"
    "  --force F        none  step:A,T  cosine:A,W                    [none]\n"
    "  --derivative D   rl (Riemann-Liouville) or caputo              [rl]\n"
    "  --kappa K        potential at K x_k + (1 - K) x_{k+1}          [0.5]\n"
    "  --x0 X, --p0 P   start; for a chain a list, or one for all     [1, "
    "0.5]\n"
    "  --h H            step, H > 0                                   [0.1]\n"
    "  --steps N        number of steps, N >= 1                       [200]\n"
    "  --columns LIST   any of t,x,p,energy,y                         "
    "[t,x,p,energy]\n"
    "  --every K        rows 0, K, 2K, ... and the last               [1]\n"
    "  --memory W       direct, fft, exponentials, auto               [auto]\n"
    "  --tolerance E    of the compressed memory                      [1e-13]\n"
    "  -o FILE          write there, complete or not at all           "
    "[stdout]\n";

static const char usage_coefficients[] =
    "usage: fvi coefficients [options]\n"
    "  --alpha A   order, 0 <= A <= 2   [0.5]\n"
    "  --count N   how many, N >= 1     [10]\n"
    "  -o FILE     write there, complete or not at all\n";

/* ---- the head of a table ---- */

static void print_head(FILE *out, const fvi_options *o)
{
    const char *name, *value;
    fprintf(out, "# fvi " FVI_VERSION "\n");
    for (size_t i = 0; fvi_options_describe(o, i, &name, &value); i++)
        fprintf(out, "# %s = %s\n", name, value);
}

static const char *column_name(char letter)
{
    return letter == 'e'   ? "energy"
           : letter == 't' ? "t"
           : letter == 'x' ? "x"
           : letter == 'p' ? "p"
                           : "y";
}

static void print_column_names(FILE *out, const fvi_options *o)
{
    for (const char *c = o->columns; *c; c++) {
        const char *separator = c == o->columns ? "# " : "\t";
        if (o->d == 1 || strchr("te", *c))
            fprintf(out, "%s%s", separator, column_name(*c));
        else
            for (size_t i = 1; i <= o->d; i++, separator = "\t")
                fprintf(out, "%s%s%zu", separator, column_name(*c), i);
    }
    fprintf(out, "\n");
}

/* ---- rows ---- */

/* A table on its way out. Rows go out as they come, unless the mirror
 * y_k = x_{N-k} is asked for: then all wait for the end of the run. */
typedef struct {
    const fvi_options *o;
    const fvi_system *system;
    FILE *out;
    size_t width; /* numbers in a row */
    double *rows; /* one row, or all of them */
    int wait;
} table;

static int is_printed(const fvi_options *o, size_t k)
{
    return k % o->every == 0 || k == o->steps;
}

static size_t row_number(const fvi_options *o, size_t k)
{
    return k / o->every + (k == o->steps && k % o->every != 0);
}

static void print_row(const table *t, const double *row)
{
    for (size_t i = 0; i < t->width; i++)
        fprintf(t->out, i ? "\t%.17g" : "%.17g", row[i]);
    fputc('\n', t->out);
}

static void fill(const table *t, const fvi_stepper *s, double *row, int mirror)
{
    const size_t d = t->o->d;
    for (const char *c = t->o->columns; *c; c++) {
        size_t width = strchr("te", *c) ? 1 : d;
        if (*c == 'y' && mirror)
            memcpy(row, s->x, d * sizeof *row);
        else if (*c == 't' && !mirror)
            row[0] = s->t;
        else if (*c == 'e' && !mirror)
            row[0] = fvi_energy(t->system, s->x, s->p);
        else if (*c == 'x' && !mirror)
            memcpy(row, s->x, d * sizeof *row);
        else if (*c == 'p' && !mirror)
            memcpy(row, s->p, d * sizeof *row);
        row += width;
    }
}

static void take_row(const table *t, const fvi_stepper *s)
{
    const fvi_options *o = t->o;
    if (is_printed(o, s->k)) {
        double *row = t->rows + (t->wait ? row_number(o, s->k) * t->width : 0);
        fill(t, s, row, 0);
        if (!t->wait)
            print_row(t, row);
    }
    if (t->wait && is_printed(o, o->steps - s->k))
        fill(t, s, t->rows + row_number(o, o->steps - s->k) * t->width, 1);
}

/* ---- progress: one line on standard error after the first second ---- */

static double seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static void show_progress(size_t k, size_t steps, double began, double *shown)
{
    double now = seconds();
    if (now - began < 1 || now - *shown < 0.2)
        return;
    *shown = now;
    fprintf(stderr, "\rstep %zu of %zu (%.0f %%), %.0f s\033[K", k, steps,
            100 * (double)k / (double)steps, now - began);
}

static int steps_and_rows(const table *t, fvi_stepper *s)
{
    const int terminal = isatty(STDERR_FILENO);
    double began = seconds(), shown = 0;
    int status = GSL_SUCCESS;
    take_row(t, s);
    while (s->k < t->o->steps && !status) {
        status = fvi_step(s);
        if (!status)
            take_row(t, s);
        if (s->k % 4096 == 0 && ferror(t->out))
            break;
        if (terminal && s->k % 1024 == 0)
            show_progress(s->k, t->o->steps, began, &shown);
    }
    if (shown > 0)
        fprintf(stderr, "\r\033[K");
    return status;
}

/* ---- commands ---- */

static int complain(const char *what)
{
    fprintf(stderr, "fvi: %s\n", what);
    return 1;
}

static int cannot_write(const char *name)
{
    fprintf(stderr, "fvi: cannot write %s: %s\n",
            name ? name : "standard output", strerror(errno));
    return 1;
}

/* Bytes that are surely asked for, against those of the machine. */
static int too_large(const fvi_options *o, size_t rows, size_t width)
{
    double machine =
        (double)sysconf(_SC_PHYS_PAGES) * (double)sysconf(_SC_PAGESIZE);
    double bytes =
        8 * (double)rows * (double)width + 8 * (double)o->d * (double)o->d;
    if (o->rho > 0 && o->method == &fvi_fractional)
        bytes += (double)fvi_memory_bytes(2 * o->alpha, o->d, o->steps,
                                          o->memory, o->tolerance);
    return bytes > machine;
}

static int report(int status, size_t step)
{
    const char *what =
        status == GSL_EMAXITER  ? "Newton's method did not converge"
        : status == GSL_ESING   ? "the equation of the step is singular"
        : status == GSL_EOVRFLW ? "a value is no longer finite"
                                : gsl_strerror(status);
    fprintf(stderr, "fvi: step %zu: %s\n", step, what);
    return 1;
}

/* A warning before a run that must blow up; it goes on all the same. */
static void warn_if_unstable(const fvi_options *o, const fvi_run *r)
{
    double load, h;
    if (o->method != &fvi_fractional && o->method != &fvi_lagrange_dalembert)
        return;
    if (fvi_stability_load(r, &load) || fvi_stability_step(r, &h) || load <= 1)
        return;
    fprintf(
        stderr,
        "fvi: warning: this step is unstable (load %.4g, above 1); %s %.4g\n",
        load, h > 0 ? "stable below h =" : "no step is stable: rho / m is",
        h > 0 ? h : o->rho / o->mass);
}

static int run(const fvi_options *o)
{
    double *masses = malloc(2 * o->d * sizeof *masses);
    if (!masses)
        return complain("not enough memory");
    const fvi_system system = fvi_options_system(o, masses);
    table t = { .o = o,
                .system = &system,
                .wait = strchr(o->columns, 'y') != NULL };
    for (const char *c = o->columns; *c; c++)
        t.width += strchr("te", *c) ? 1 : o->d;
    const size_t rows = t.wait ? row_number(o, o->steps) + 1 : 1;
    const fvi_run r = { .system = &system,
                        .x0 = o->x0,
                        .p0 = o->p0,
                        .h = o->h,
                        .steps = o->steps,
                        .kappa = o->kappa,
                        .alpha = o->alpha,
                        .caputo = o->caputo,
                        .memory = o->memory,
                        .tolerance = o->tolerance };
    fvi_stepper *s = NULL;
    int failed = 1, status = GSL_ENOMEM;
    if (!too_large(o, rows, t.width)
        && (t.rows = calloc(rows * t.width, sizeof *t.rows)))
        status = fvi_start(o->method, &r, &s);
    if (status) {
        complain(status == GSL_ENOMEM ? "not enough memory"
                                      : gsl_strerror(status));
    } else if (!(t.out = fvi_output_open(o->output))) {
        cannot_write(o->output);
    } else {
        warn_if_unstable(o, &r);
        print_head(t.out, o);
        print_column_names(t.out, o);
        status = steps_and_rows(&t, s);
        for (size_t i = 0; t.wait && !status && i < rows; i++)
            print_row(&t, t.rows + i * t.width);
        failed = status ? report(status, s->k + 1) : 0;
        if (fvi_output_close(t.out, !failed) != 0)
            failed = cannot_write(o->output);
    }
    fvi_stop(s);
    free(t.rows);
    free(masses);
    return failed;
}

static int coefficients(const fvi_options *o)
{
    double machine =
        (double)sysconf(_SC_PHYS_PAGES) * (double)sysconf(_SC_PAGESIZE);
    double *w =
        8 * (double)o->count < machine ? malloc(o->count * sizeof *w) : NULL;
    if (!w)
        return complain("not enough memory");
    fvi_coefficients(o->alpha, o->count, w);
    FILE *out = fvi_output_open(o->output);
    int failed = !out;
    if (out) {
        print_head(out, o);
        fprintf(out, "# n\talpha_n\n");
        for (size_t n = 0; n < o->count && !ferror(out); n++)
            fprintf(out, "%zu\t%.17g\n", n, w[n]);
        failed = fvi_output_close(out, 1) != 0;
    }
    free(w);
    return failed ? cannot_write(o->output) : 0;
}

static int print_methods(void)
{
    for (size_t i = 0; fvi_options_methods[i]; i++) {
        const fvi_method *m = fvi_options_methods[i];
        printf("%s\t%s\t%s\n", m->name, m->order, m->memory);
    }
    return fvi_output_close(stdout, 1) ? cannot_write(NULL) : 0;
}

static int print_text(const char *text)
{
    fputs(text, stdout);
    return fvi_output_close(stdout, 1) ? cannot_write(NULL) : 0;
}

int main(int argc, char **argv)
{
    fvi_options o;
    char complaint[400];
    gsl_set_error_handler_off(); /* the default handler aborts */
    int status = fvi_options_parse(argc, argv, &o, complaint, sizeof complaint);
    if (status) {
        fprintf(stderr, "fvi: %s\nTry 'fvi --help' or 'fvi run --help'.\n",
                complaint);
        return status;
    }
    switch (o.command) {
    case FVI_COMMAND_RUN:
        status = run(&o);
        break;
    case FVI_COMMAND_COEFFICIENTS:
        status = coefficients(&o);
        break;
    case FVI_COMMAND_METHODS:
        status = print_methods();
        break;
    case FVI_COMMAND_VERSION:
        status = print_text("fvi " FVI_VERSION "\n");
        break;
    default:
        status = print_text(o.about == FVI_COMMAND_RUN ? usage_run
                            : o.about == FVI_COMMAND_COEFFICIENTS
                                ? usage_coefficients
                                : usage);
    }
    fvi_options_free(&o);
    return status;
}
