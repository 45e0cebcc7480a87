/* src/command_sweep/fvi_sweep.c -- Run the command `fvi sweep`: a grid of runs, a row for each run. */
#define _GNU_SOURCE /* for MAP_ANONYMOUS */
#include "output/fvi_complain.h"
#include <fvi/fvi.h>
#include "fvi_sweep.h"
#include "command_shared/fvi_run_start.h"
#include "command_shared/fvi_run_warn.h"
#include "output/fvi_format.h"
#include "sweep_lanes.h"
#include "output/fvi_output.h"
#include "output/fvi_table.h"
#include "options/fvi_checks.h"
#include "options/fvi_options.h"
#include <fvi/format_double.h>

#include <math.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/mman.h>
#ifdef __linux__
#include <sys/prctl.h>
#endif
#include <sys/wait.h>
#include <unistd.h>

/* The memory that the processes share. Each process takes the next group of runs that no process has taken, and writes
 * their rows. Therefore the table does not depend on which process does what. */
typedef struct {
    _Atomic size_t next;
    double *rows; /* width numbers in each row */
    sweep_verdict *verdicts;
    size_t *first; /* first row of each run; after the last run, the number of rows */
    size_t width, count;
    void *map;
    size_t bytes;
} board;

/* ---- all runs ---- */

static int open_board(board *b, size_t count, size_t rows, size_t width)
{
    const size_t per_run = sizeof(sweep_verdict) + sizeof(size_t);
    const double bytes = (double)rows * (double)width * sizeof(double)
                         + (double)count * (double)per_run;
    *b = (board){ .width = width, .count = count, .map = MAP_FAILED };
    if (bytes > fvi_machine_bytes())
        return 0;
    b->bytes = sizeof *b + rows * width * sizeof(double)
               + (count + 1) * per_run;
    b->map = mmap(NULL, b->bytes, PROT_READ | PROT_WRITE,
                  MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    return b->map != MAP_FAILED;
}

/* End this process when its parent ends, however that happens: on Linux at once, elsewhere after its run. */
static void end_with_parent(pid_t parent)
{
#ifdef __linux__
    prctl(PR_SET_PDEATHSIG, SIGKILL);
#endif
    if (getppid() != parent) /* the parent ended before the request */
        _exit(1);
}

/* Make a group of runs together or, if that is not possible, one after the other. */
static void run_group(const sweep_grid *g, board *shared, size_t count, const size_t *run)
{
    double *rows[FVI_BATCH_MOST];
    sweep_verdict *verdicts[FVI_BATCH_MOST];
    for (size_t l = 0; l < count; l++) {
        const size_t i = run[l] - g->first;
        rows[l] = shared->rows + shared->first[i] * shared->width;
        verdicts[l] = shared->verdicts + i;
    }
    if (count > 1 && sweep_run_group(g, count, run, rows, verdicts))
        return;
    for (size_t l = 0; l < count; l++)
        *verdicts[l] = sweep_run(g, run[l], rows[l]);
}

/* Take groups of runs until there are none. Then end the process. */
static void process_groups(const sweep_grid *g, const sweep_plan *plan, board *shared, pid_t parent)
{
    for (size_t n; getppid() == parent
                   && (n = atomic_fetch_add(&shared->next, 1)) < plan->groups;)
        run_group(g, shared, plan->group[n + 1] - plan->group[n], plan->order + plan->group[n]);
    _exit(0);
}

/* Make all runs with at most g->jobs processes. Return 0, or 1 if a process failed. */
static int run_in_processes(const sweep_grid *g, const sweep_plan *plan, board *shared)
{
    size_t started = 0, ended = 0;
    const pid_t parent = getpid();
    fflush(NULL);
    for (; started < g->jobs && started < plan->groups; started++) {
        const pid_t child = fork();
        if (child == 0) {
            end_with_parent(parent);
            process_groups(g, plan, shared, parent);
        }
        if (child < 0)
            break; /* go on with fewer processes */
    }
    for (int state; ended < started && wait(&state) > 0;)
        ended += WIFEXITED(state) && WEXITSTATUS(state) == 0;
    return (started == 0 && plan->groups > 0) || ended < started;
}

/* Print how the runs were made, if standard error is a terminal or --lanes was given. The rows do not depend on it. */
static void print_how_runs_were_made(const sweep_grid *g, const sweep_plan *plan, const board *b)
{
    size_t together = 0;
    if (!g->lanes && !isatty(STDERR_FILENO))
        return;
    for (size_t i = 0; i < b->count; i++)
        together += b->verdicts[i].lanes > 0;
    fprintf(stderr, "fvi: %zu run%s: ", b->count, b->count == 1 ? "" : "s");
    if (together > 0) {
        fprintf(stderr, "%zu in groups of up to %zu that take their steps together%s\n", together, plan->most,
                together < b->count ? ", the others one by one" : "");
    } else {
        const char *why = sweep_why_apart(g, plan);
        fprintf(stderr, "one by one%s%s\n", why ? ": " : "", why ? why : "");
    }
}

/* ---- the table ---- */

/* Print the varied values of run i of the whole grid, for example "h = 10, rho = 1". */
static void print_varied_values(FILE *out, const sweep_grid *g, size_t i)
{
    for (size_t n = 0; n < g->count; n++) {
        char text[32];
        fvi_format_double(sweep_grid_value(g, i, n), text);
        fprintf(out, "%s%s = %s", n ? ", " : "", g->axis[n].name, text);
    }
}

/* Count the runs for which is_so is nonzero. Print on standard error how many there are, and the first of them. The
 * same warning without the first run is written to text, which becomes empty if there is no such run. */
static void warn_of_rows(const sweep_grid *g, const board *b, int (*is_so)(const sweep_verdict *v),
                         const char *what, size_t size, char *text)
{
    size_t many = 0, first = 0;
    *text = '\0';
    for (size_t i = b->count; i-- > 0;)
        if (is_so(b->verdicts + i)) {
            many++;
            first = i;
        }
    if (many == 0)
        return;
    snprintf(text, size, "%s: %zu of %zu", what, many, b->count);
    fprintf(stderr, "fvi: warning: %s, the first with ", text);
    print_varied_values(stderr, g, g->first + first);
    fputc('\n', stderr);
}

static int is_unstable(const sweep_verdict *v)
{
    return v->unstable > 0;
}

static int is_singular(const sweep_verdict *v)
{
    return v->singular > 0;
}

static void print_head(FILE *out, const sweep_grid *g, const fvi_options *o,
                       const char *no_solution, const char *unstable)
{
    const char *name, *value;
    fvi_format_begin(out, o->format);
    for (size_t i = 0; fvi_options_describe(o, i, &name, &value); i++)
        if (strcasecmp(name, "let") == 0) {
            if (*g->lets)
                fvi_format_parameter(out, o->format, name, g->lets);
        } else if (!sweep_grid_has(g, name)
                   && (g->has_rows || strcmp(name, "every") != 0)
                   && !(strcmp(name, "steps") == 0 && o->steps_follow)
                   && !(strcmp(name, "h") == 0 && o->text[H] == o->step)) {
            fvi_format_parameter(out, o->format, name, value);
        }
    fvi_format_parameter(out, o->format, "vary", g->text);
    if (g->parts > 1)
        fvi_format_parameter(out, o->format, "part", g->part_text);
    if (no_solution)
        fvi_format_parameter(out, o->format, "warning", no_solution);
    if (*unstable)
        fvi_format_parameter(out, o->format,
                             no_solution ? "warning of the step" : "warning",
                             unstable);
    size_t at = 0;
    for (; at < g->count; at++)
        fvi_format_name(out, o->format, at, g->axis[at].name, 0);
    fvi_table_column_names(out, o, at);
}

/* Find out why a run did not start, or which force is not finite. Its process returned no text, so the run is started
 * again here. The text is empty if nothing more is known. */
static void reason_of_start(const sweep_grid *g, size_t i, int status, size_t size, char *text)
{
    fvi_options o;
    fvi_error error = { 0 };
    *text = '\0';
    if (sweep_grid_options(g, i, &o, &error))
        return;
    const fvi_system system = fvi_options_system(&o);
    const fvi_run r = fvi_options_run(&o, &system);
    fvi_reason_of_start(&o, &r, status, &error);
    if (error.field)
        snprintf(text, size, "--%s: %s", error.field, error.text);
    else if (status == FVI_EUNSUP || status == FVI_EBADFUNC)
        snprintf(text, size, "%s", fvi_reason_of_code(&o, &error));
    fvi_options_free(&o);
}

/* Print which run failed, and how. Return 1. */
static int complain_of(const sweep_grid *g, size_t i, sweep_verdict v)
{
    char reason[sizeof((fvi_error *)0)->text + 32] = "";
    if (v.step == 0 || v.status == FVI_EBADFUNC)
        reason_of_start(g, i, v.status, sizeof reason, reason);
    fputs("fvi: with ", stderr);
    print_varied_values(stderr, g, i);
    if (v.step > 0)
        fprintf(stderr, ": step %zu", v.step);
    fprintf(stderr, ": %s\n", *reason ? reason : fvi_reason(v.status));
    return 1;
}

static void print_rows(FILE *out, const fvi_options *o, const board *b,
                       size_t run)
{
    for (size_t k = b->first[run]; k < b->first[run] + b->verdicts[run].rows; k++)
        fvi_format_row(out, o->format, k, b->width, b->rows + k * b->width);
}

/* Print the rows in the order of the grid. If a run failed, the rows before it are kept only on standard output. */
static int print_table(const sweep_grid *g, const fvi_options *o, const board *b,
                       const char *no_solution)
{
    FILE *out = fvi_output_open(o->output);
    if (!out)
        return fvi_cannot_write(o->output);
    int failed = 0;
    char unstable[FVI_WARNING_ROOM], singular[FVI_WARNING_ROOM];
    warn_of_rows(g, b, is_unstable, "rows with an unstable step", sizeof unstable, unstable);
    warn_of_rows(g, b, is_singular,
                 "rows of a Lagrangian whose inertia, its second derivatives by the velocities, is nearly "
                 "singular on the way, where a method may lose its order",
                 sizeof singular, singular);
    print_head(out, g, o, no_solution, unstable);
    for (size_t i = 0; i < b->count && !failed && !ferror(out); i++) {
        if (b->verdicts[i].status)
            failed = complain_of(g, g->first + i, b->verdicts[i]);
        else
            print_rows(out, o, b, i);
    }
    if (!failed)
        fvi_format_end(out, o->format);
    if (fvi_output_close(out, !failed) != 0)
        failed = fvi_cannot_write(o->output);
    return failed;
}

/* Interpret every point of the grid before the first run begins. Return 0, or a code with the error filled in. */
static int check_all(const sweep_grid *g, const char **no_solution,
                     size_t *first, fvi_error *c)
{
    int status = sweep_grid_check(g, c);
    *no_solution = NULL;
    first[0] = 0;
    for (size_t i = 0; !status && i < g->runs; i++) {
        fvi_options o;
        status = sweep_grid_options(g, g->first + i, &o, c);
        if (status)
            return status;
        if (o.no_solution)
            *no_solution = o.no_solution;
        first[i + 1] = first[i] + sweep_run_rows(g, &o);
        if (g->has_rows && fvi_reductions_count(o.typed) > 0)
            status = fvi_refuse(c, "rows", "not together with --reduce");
        else
            status = fvi_check_forces(&o, o.steps, c);
        fvi_options_free(&o);
    }
    return status;
}

/* Make all runs and print the table. *first is copied to the shared memory and freed before the processes begin,
 * because each of them would keep a copy. Return an exit code. */
static int run_all(const sweep_grid *g, const fvi_options *o,
                   size_t **first, const char *no_solution)
{
    const size_t rows = (*first)[g->runs];
    const fvi_system system = fvi_options_system(o);
    const fvi_run run = fvi_options_run(o, &system);
    fvi_table t;
    board b;
    if (fvi_run_warn_of_memory(o, &run))
        return 1;
    fvi_table_shape(&t, o, &system);
    if (!open_board(&b, g->runs, rows, g->count + t.width))
        return fvi_complain("not enough memory");
    board *shared = b.map;
    *shared = b;
    shared->rows = (double *)(shared + 1);
    shared->first = (size_t *)(void *)(shared->rows + rows * b.width);
    memcpy(shared->first, *first, (g->runs + 1) * sizeof **first);
    free(*first);
    *first = NULL;
    shared->verdicts = (sweep_verdict *)(shared->first + g->runs + 1);
    if (no_solution)
        fvi_warn(no_solution);
    sweep_plan plan;
    int failed = 1;
    if (sweep_plan_make(g, o, &plan)) {
        fvi_complain("not enough memory");
    } else if (run_in_processes(g, &plan, shared)) {
        fvi_complain("a process of the sweep was ended");
    } else {
        print_how_runs_were_made(g, &plan, shared);
        failed = print_table(g, o, shared, no_solution);
    }
    sweep_plan_free(&plan);
    munmap(b.map, b.bytes);
    return failed;
}

int fvi_command_sweep(int argc, char **argv)
{
    fvi_error error;
    sweep_grid g;
    fvi_options o;
    const char *no_solution;
    size_t *first = NULL;
    int status = sweep_grid_parse(argc, argv, &g, &error);
    if (!status && !(first = malloc((g.runs + 1) * sizeof *first)))
        status = fvi_no_memory(&error, NULL);
    if (!status)
        status = check_all(&g, &no_solution, first, &error);
    if (!status)
        status = sweep_grid_options(&g, g.first, &o, &error);
    if (status) {
        status = fvi_refused(&error, "sweep");
    } else {
        status = run_all(&g, &o, &first, no_solution);
        fvi_options_free(&o);
    }
    free(first);
    sweep_grid_free(&g);
    return status;
}
