/* src/fvi_cli.c -- The program build/fvi. */
#define _GNU_SOURCE
#include "coefficients.h"
#include "discrete_mechanics.h"
#include "exact_solution.h"
#include "fvi.h"
#include "fvi_options.h"
#include "fvi_output.h"
#include "fvi_table.h"
#include "stability.h"

#include <errno.h>
#include <gsl/gsl_errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

static const char usage[] =
    "usage: fvi run [options]            one trajectory, as a table\n"
    "       fvi coefficients [options]   n, alpha_n\n"
    "       fvi exact [options]          the exact solution on the same grid\n"
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

static const char usage_exact[] =
    "usage: fvi exact [options]\n"
    "the linear problem m x'' + C x + rho D^{2A} x = F, solved exactly; "
    "options as\n"
    "of run: --alpha --rho --mass --force --derivative --x0 --p0 --h --steps\n"
    "--columns --every -o, and --potential harmonic:C (C >= 0) or free\n";

static const char usage_coefficients[] =
    "usage: fvi coefficients [options]\n"
    "  --alpha A   order, 0 <= A <= 2   [0.5]\n"
    "  --count N   how many, N >= 1     [10]\n"
    "  -o FILE     write there, complete or not at all\n";

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

static int steps_and_rows(const fvi_table *t, fvi_stepper *s)
{
    const int terminal = isatty(STDERR_FILENO);
    double began = seconds(), shown = 0;
    int status = GSL_SUCCESS;
    fvi_table_take(t, 0, s->x, s->p);
    while (s->k < t->o->steps && !status) {
        status = fvi_step(s);
        if (!status)
            fvi_table_take(t, s->k, s->x, s->p);
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

/* Room for the rows that are kept; NULL if what is surely asked for is more
 * than the machine has. */
static double *room(const fvi_table *t)
{
    const fvi_options *o = t->o;
    double machine =
        (double)sysconf(_SC_PHYS_PAGES) * (double)sysconf(_SC_PAGESIZE);
    double bytes = 8 * (double)t->height * (double)t->width
                   + 8 * (double)o->d * (double)o->d;
    if (o->rho > 0 && o->method == &fvi_fractional)
        bytes += (double)fvi_memory_bytes(2 * o->alpha, o->d, o->steps,
                                          o->memory, o->tolerance);
    return bytes < machine ? calloc(t->height * t->width, sizeof *t->rows)
                           : NULL;
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

static int run(const fvi_options *o, const fvi_system *system)
{
    const fvi_run r = { .system = system,
                        .x0 = o->x0,
                        .p0 = o->p0,
                        .h = o->h,
                        .steps = o->steps,
                        .kappa = o->kappa,
                        .alpha = o->alpha,
                        .caputo = o->caputo,
                        .memory = o->memory,
                        .tolerance = o->tolerance };
    fvi_table t;
    fvi_stepper *s = NULL;
    int failed = 1, status = GSL_ENOMEM;
    fvi_table_shape(&t, o, system);
    if ((t.rows = room(&t)))
        status = fvi_start(o->method, &r, &s);
    if (status) {
        complain(status == GSL_ENOMEM ? "not enough memory"
                                      : gsl_strerror(status));
    } else if (!(t.out = fvi_output_open(o->output))) {
        cannot_write(o->output);
    } else {
        warn_if_unstable(o, &r);
        fvi_table_head(t.out, o);
        fvi_table_names(&t);
        status = steps_and_rows(&t, s);
        failed = status ? report(status, s->k + 1) : 0;
        if (!failed)
            fvi_table_finish(&t);
        if (fvi_output_close(t.out, !failed) != 0)
            failed = cannot_write(o->output);
    }
    fvi_stop(s);
    free(t.rows);
    return failed;
}

/* The rows of the exact solution, a batch at a time: each batch costs one
 * search for the poles. Returns 0, or 1 after it has said what is wrong. */
static int exact_rows(const fvi_table *t, const fvi_linear *problem)
{
    enum { BATCH = 512 };
    double time[BATCH], x[BATCH], v[BATCH];
    size_t step[BATCH], count = 0;
    for (size_t k = 0; k <= t->o->steps && !ferror(t->out); k++) {
        if (fvi_table_wants(t, k)) {
            step[count] = k;
            time[count++] = (double)k * t->o->h;
        }
        if (count < BATCH && k < t->o->steps)
            continue;
        int status = fvi_exact(problem, count, time, x, v);
        for (size_t i = 0; i < count; i++) {
            double p = problem->m * v[i];
            if (status && !(isfinite(x[i]) && isfinite(p)))
                return report(status, step[i]);
            fvi_table_take(t, step[i], &x[i], &p);
        }
        count = 0;
    }
    return 0;
}

static fvi_linear linear_problem(const fvi_options *o)
{
    return (fvi_linear){ .m = o->mass,
                         .c = o->spring[0],
                         .rho = o->rho,
                         .alpha = o->alpha,
                         .caputo = o->caputo,
                         .x0 = o->x0[0],
                         .v0 = o->p0[0] / o->mass,
                         .forcing = o->force == 's'   ? FVI_FORCING_STEP
                                    : o->force == 'c' ? FVI_FORCING_COSINE
                                                      : FVI_FORCING_NONE,
                         .A = o->forcing[0],
                         .T = o->forcing[1],
                         .w = o->forcing[1] };
}

/* The same table from the exact solution; p = m v. */
static int exact(const fvi_options *o, const fvi_system *system)
{
    const fvi_linear problem = linear_problem(o);
    fvi_table t;
    fvi_table_shape(&t, o, system);
    if (!(t.rows = room(&t)))
        return complain("not enough memory");
    int failed = 1;
    if (!(t.out = fvi_output_open(o->output))) {
        cannot_write(o->output);
    } else {
        fvi_table_head(t.out, o);
        fvi_table_names(&t);
        failed = exact_rows(&t, &problem);
        if (!failed)
            fvi_table_finish(&t);
        if (fvi_output_close(t.out, !failed) != 0)
            failed = cannot_write(o->output);
    }
    free(t.rows);
    return failed;
}

/* Both commands speak of a system; its masses and dampings live here. */
static int with_system(const fvi_options *o,
                       int (*command)(const fvi_options *, const fvi_system *))
{
    double *storage = malloc(2 * o->d * sizeof *storage);
    if (!storage)
        return complain("not enough memory");
    const fvi_system system = fvi_options_system(o, storage);
    int status = command(o, &system);
    free(storage);
    return status;
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
        fvi_table_head(out, o);
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
        status = with_system(&o, run);
        break;
    case FVI_COMMAND_EXACT:
        status = with_system(&o, exact);
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
        status = print_text(o.about == FVI_COMMAND_RUN     ? usage_run
                            : o.about == FVI_COMMAND_EXACT ? usage_exact
                            : o.about == FVI_COMMAND_COEFFICIENTS
                                ? usage_coefficients
                                : usage);
    }
    fvi_options_free(&o);
    return status;
}
