/* src/program/fvi_sweep.c -- The command `fvi sweep`: a grid of runs, a row each. */
#define _GNU_SOURCE /* MAP_ANONYMOUS */
#include "output/fvi_complain.h"
#include <fvi/fvi.h>
#include "fvi_commands.h"
#include "output/fvi_format.h"
#include "sweep_grid.h"
#include "output/fvi_output.h"
#include "fvi_run.h"
#include "output/fvi_table.h"
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

/* What became of a run: 0, or a code, and the step in which it failed; 0 is its start. Does a
 * mode of it grow by its step? */
typedef struct {
    int status;
    size_t step;
    int unstable;
} verdict;

/* What the processes share. Each takes the next run that nobody has taken, and writes its
 * row: the table does not depend on who does what. */
typedef struct {
    _Atomic size_t next;
    double *rows; /* width numbers each */
    verdict *verdicts;
    size_t *first; /* row of each run; behind the last how many there are */
    size_t width, count;
    void *map;
    size_t bytes;
} board;

/* ---- one run ---- */

/* The last row of a run that an event has ended, where it stands. */
static int take_end(fvi_table *t, const fvi_stepper *s)
{
    fvi_observation now;
    int status = FVI_SUCCESS;
    t->ended = s->t;
    if (fvi_reductions_count(t->o->typed) > 0)
        return status;
    if (t->observer)
        status = fvi_observer_read(t->observer, s, s->t, &now);
    t->now = t->observer ? &now : NULL;
    if (!status)
        status = fvi_table_take(t, t->o->steps, s->x, s->p);
    t->now = NULL;
    return status;
}

/* All steps of o->h, and the rows that o->every asks for. */
static verdict by_steps(const fvi_options *o, const fvi_run *r, fvi_table *t)
{
    fvi_stepper *s;
    verdict v = { .status = fvi_stepper_start(o->method, r, &s, NULL) };
    char unstable[FVI_WARNING_ROOM];
    if (v.status)
        return v;
    v.unstable = fvi_warning_of_step(o->method, r, sizeof unstable, unstable);
    v.status = v.unstable < 0 ? FVI_ENOMEM : fvi_run_observe(t, s);
    if (!v.status)
        v.status = fvi_run_row(t, s, 0);
    for (size_t k = 0, next = fvi_table_next(t, 0); !v.status && k < o->steps;) {
        if (s->k < next && fvi_stepper_is_over(s)) {
            v.status = take_end(t, s);
            break;
        }
        if (s->k < next) {
            v.step = s->k + 1;
            v.status = fvi_run_step(t, s);
            continue;
        }
        v.status = fvi_run_row(t, s, k = next);
        next = k < o->steps ? fvi_table_next(t, k) : k;
    }
    if (!v.status && fvi_reductions_count(o->typed) > 0)
        fvi_run_reduced(t, t->rows + t->width);
    fvi_observer_free(t->observer);
    fvi_stepper_free(s);
    return v;
}

/* As many steps as the wanted error needs. */
static verdict by_error(const fvi_options *o, const fvi_run *r, fvi_table *t)
{
    const size_t count = o->steps + 1,
                 width = 2 * o->d + fvi_typed_columns_count(o->typed);
    double *x = malloc(count * width * sizeof *x),
           *p = x ? x + count * o->d : NULL, *typed = x ? p + count * o->d : NULL;
    fvi_report found;
    verdict v = { .status = FVI_ENOMEM };
    if (x)
        v.status = fvi_run_search(o, o->method, r, x, p, typed, &found);
    if (!v.status)
        v.status = fvi_run_found_row(t, 0, x, p, typed);
    for (size_t k = 0; k < o->steps && !v.status;) {
        k = fvi_table_next(t, k);
        v.status = fvi_run_found_row(t, k, x, p, typed);
    }
    free(x);
    return v;
}

/* How many rows a run gives. */
static size_t rows_of_run(const sweep_grid *g, const fvi_options *o)
{
    return g->has_rows ? o->steps / o->every + 1 + (o->steps % o->every != 0)
                       : 1;
}

/* The table of a run that keeps its rows: all, or the first and the last. */
static verdict run_table(const sweep_grid *g, fvi_options *o, fvi_table *t)
{
    const fvi_system system = fvi_options_system(o);
    const fvi_run r = fvi_options_run(o, &system);
    verdict v = { .status = FVI_ENOMEM };
    if (!g->has_rows)
        o->every = o->steps;
    fvi_table_shape(t, o, &system);
    t->wait = 1;
    t->height = g->has_rows ? rows_of_run(g, o) : 2;
    if ((t->rows = fvi_table_room(t, 0)))
        v = (o->error > 0 ? by_error : by_steps)(o, &r, t);
    return v;
}

/* Run number i into its rows: the values of the grid, then the columns; of the last step where one row
 * is asked for. */
static verdict one_run(const sweep_grid *g, size_t i, double *rows)
{
    fvi_options o;
    fvi_table t;
    if (sweep_grid_options(g, i, &o, NULL))
        return (verdict){ .status = FVI_ENOMEM }; /* it was understood before */
    const size_t count = rows_of_run(g, &o);
    const verdict v = run_table(g, &o, &t);
    const size_t width = g->count + t.width, skipped = t.height - count;
    for (size_t k = 0; k < count && !v.status; k++) {
        for (size_t n = 0; n < g->count; n++)
            rows[k * width + n] = sweep_grid_value(g, i, n);
        memcpy(rows + k * width + g->count, t.rows + (k + skipped) * t.width,
               t.width * sizeof *rows);
    }
    free(t.rows);
    fvi_options_free(&o);
    return v;
}

/* ---- all runs ---- */

static int board_open(board *b, size_t count, size_t rows, size_t width)
{
    const size_t per_run = sizeof(verdict) + sizeof(size_t);
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

/* However the parent ends, this process does, too: on Linux at once, elsewhere after its
 * run. */
static void end_with(pid_t parent)
{
#ifdef __linux__
    prctl(PR_SET_PDEATHSIG, SIGKILL);
#endif
    if (getppid() != parent) /* it was over before that was asked for */
        _exit(1);
}

/* Take runs until there are none; ends the process. */
static void work(const sweep_grid *g, board *shared, pid_t parent)
{
    for (size_t i; getppid() == parent
                   && (i = atomic_fetch_add(&shared->next, 1)) < shared->count;)
        shared->verdicts[i] =
            one_run(g, g->first + i, shared->rows + shared->first[i] * shared->width);
    _exit(0);
}

/* All runs, by so many processes. Returns 0, or 1 if a process did not come to its
 * end. */
static int work_together(const sweep_grid *g, board *shared)
{
    size_t started = 0, ended = 0;
    const pid_t parent = getpid();
    fflush(NULL);
    for (; started < g->jobs && started < shared->count; started++) {
        const pid_t child = fork();
        if (child == 0) {
            end_with(parent);
            work(g, shared, parent);
        }
        if (child < 0)
            break; /* fewer do */
    }
    for (int state; ended < started && wait(&state) > 0;)
        ended += WIFEXITED(state) && WEXITSTATUS(state) == 0;
    return (started == 0 && shared->count > 0) || ended < started;
}

/* ---- the table ---- */

/* The varied values of run i of the whole grid, "h = 10, rho = 1". */
static void name_run(FILE *out, const sweep_grid *g, size_t i)
{
    for (size_t n = 0; n < g->count; n++) {
        char text[32];
        fvi_format_double(sweep_grid_value(g, i, n), text);
        fprintf(out, "%s%s = %s", n ? ", " : "", g->axis[n].name, text);
    }
}

/* How many steps are unstable, and the first of them; on standard error, and left in text. */
static void warn_of_unstable(const sweep_grid *g, const board *b, size_t size,
                             char *text)
{
    size_t many = 0, first = 0;
    *text = '\0';
    for (size_t i = b->count; i-- > 0;)
        if (b->verdicts[i].unstable) {
            many++;
            first = i;
        }
    if (many == 0)
        return;
    snprintf(text, size, "rows with an unstable step: %zu of %zu", many,
             b->count);
    fprintf(stderr, "fvi: warning: %s, the first with ", text);
    name_run(stderr, g, g->first + first);
    fputc('\n', stderr);
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

/* Why a run did not start: it is tried again here, because no text came back from its process. Empty if
 * nothing more is known. */
static void reason_of_start(const sweep_grid *g, size_t i, size_t size, char *text)
{
    fvi_options o;
    fvi_error error = { 0 };
    fvi_stepper *s = NULL;
    *text = '\0';
    if (sweep_grid_options(g, i, &o, &error))
        return;
    const fvi_system system = fvi_options_system(&o);
    const fvi_run r = fvi_options_run(&o, &system);
    if (o.mechanism && fvi_stepper_start(o.method, &r, &s, &error) && error.field)
        snprintf(text, size, "--%s: %s", error.field, error.text);
    fvi_stepper_free(s);
    fvi_options_free(&o);
}

/* Which run failed, and how. */
static int complain_of(const sweep_grid *g, size_t i, verdict v)
{
    char reason[sizeof((fvi_error *)0)->text + 32] = "";
    if (v.step == 0)
        reason_of_start(g, i, sizeof reason, reason);
    fputs("fvi: with ", stderr);
    name_run(stderr, g, i);
    if (v.step > 0)
        fprintf(stderr, ": step %zu", v.step);
    fprintf(stderr, ": %s\n", *reason ? reason : fvi_reason(v.status));
    return 1;
}

static void print_rows(FILE *out, const fvi_options *o, const board *b,
                       size_t run)
{
    for (size_t k = b->first[run]; k < b->first[run + 1]; k++)
        fvi_format_row(out, o->format, k, b->width, b->rows + k * b->width);
}

/* Rows in the order of the grid; those before a run that failed stand where the output
 * is standard output. */
static int print_table(const sweep_grid *g, const fvi_options *o, const board *b,
                       const char *no_solution)
{
    FILE *out = fvi_output_open(o->output);
    if (!out)
        return fvi_cannot_write(o->output);
    int failed = 0;
    char unstable[FVI_WARNING_ROOM];
    warn_of_unstable(g, b, sizeof unstable, unstable);
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

/* Every point of the grid is understood before the first run begins. Returns 0, or a code. */
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
        first[i + 1] = first[i] + rows_of_run(g, &o);
        if (g->has_rows && (fvi_reductions_count(o.typed) > 0 || o.text[EVENT]))
            status = fvi_refuse(c, "rows", "not together with --%s",
                                o.text[EVENT] ? "event" : "reduce");
        fvi_options_free(&o);
    }
    return status;
}

static int run_all(const sweep_grid *g, const fvi_options *o,
                   const size_t *first, const char *no_solution)
{
    const fvi_system system = fvi_options_system(o);
    fvi_table t;
    board b;
    fvi_table_shape(&t, o, &system);
    if (!board_open(&b, g->runs, first[g->runs], g->count + t.width))
        return fvi_complain("not enough memory");
    board *shared = b.map;
    *shared = b;
    shared->rows = (double *)(shared + 1);
    shared->first = (size_t *)(void *)(shared->rows + first[g->runs] * b.width);
    memcpy(shared->first, first, (g->runs + 1) * sizeof *first);
    shared->verdicts = (verdict *)(shared->first + g->runs + 1);
    if (no_solution)
        fvi_warn(no_solution);
    int failed = work_together(g, shared)
                     ? fvi_complain("a process of the sweep was ended")
                     : print_table(g, o, shared, no_solution);
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
        status = fvi_fail(&error, FVI_ENOMEM, NULL, NAN, "not enough memory");
    if (!status)
        status = check_all(&g, &no_solution, first, &error);
    if (!status)
        status = sweep_grid_options(&g, g.first, &o, &error);
    if (status) {
        status = fvi_refused(&error, "sweep");
    } else {
        status = run_all(&g, &o, first, no_solution);
        fvi_options_free(&o);
    }
    free(first);
    sweep_grid_free(&g);
    return status;
}
