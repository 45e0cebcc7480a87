/* src/command_exact/fvi_exact.c -- Print the table of `fvi exact` for one mass. */
#include "fvi_exact.h"

#include "command_shared/fvi_run_rows.h"
#include "options/fvi_option_columns.h"
#include "options/fvi_checks.h"
#include "options/fvi_values.h"
#include "output/fvi_complain.h"
#include "output/fvi_output.h"
#include "output/fvi_table.h"

#include <fvi/error.h>
#include <fvi/exact_solution.h>

#include <math.h>
#include <stdlib.h>

/* All steps of a table, computed before the first row is printed. x is NULL if they are not computed in advance. */
typedef struct {
    double *x, *v;
    int status;
} long_table;

/* Print the rows of `count` steps, at most BATCH. They are computed in one batch, because each call of fvi_exact_at
 * costs one search for the poles. A value that was not computed stays NaN. Return 0, or 1 after a message on standard
 * error. */
enum { BATCH = 512 };
static int exact_batch(fvi_table *t, const fvi_linear_oscillator *problem,
                       const long_table *all, size_t count, const size_t *step)
{
    double time[BATCH], x[BATCH], v[BATCH];
    size_t n = 0; /* number of times that are finite */
    for (size_t i = 0; i < count; i++) {
        time[i] = (double)step[i] * t->o->h;
        n += isfinite(time[i]) != 0;
        x[i] = all->x ? all->x[step[i]] : NAN;
        v[i] = all->x ? all->v[step[i]] : NAN;
    }
    int status = all->x  ? all->status
                 : n > 0 ? fvi_exact_at(problem, n, time, x, v, NULL)
                         : FVI_SUCCESS;
    fvi_progress_clear(); /* the rows may go to the terminal that shows the progress */
    for (size_t i = 0; i < count; i++) {
        double p = problem->m * v[i];
        if (isnan(x[i]))
            return fvi_stopped_at(step[i], status ? status : FVI_EOVRFLW);
        int finite = fvi_run_state_row(t, step[i], &x[i], &p);
        if (finite != FVI_SUCCESS)
            return fvi_stopped_at(step[i], finite);
    }
    fvi_progress(step[count - 1], t->o->steps);
    return 0;
}

static int exact_batches(fvi_table *t, const fvi_linear_oscillator *problem,
                         const long_table *all)
{
    size_t step[BATCH], count = 1;
    step[0] = 0;
    while (count > 0 && !ferror(t->out)) {
        size_t last = step[count - 1];
        if (count < BATCH && last < t->o->steps) {
            step[count++] = fvi_table_next(t, last);
            continue;
        }
        if (exact_batch(t, problem, all, count, step))
            return 1;
        step[0] = last < t->o->steps ? fvi_table_next(t, last) : last;
        count = last < t->o->steps;
    }
    return 0;
}

/* Print all rows. If there are more steps than fit into a batch, and at least one step in 31 is a row, all steps are
 * computed by one call of fvi_exact_grid, because a row by itself costs as much as tens of rows of the grid. Otherwise,
 * or if there is no memory for all steps, the rows are computed in batches. A run with a law always takes batches,
 * because fvi_exact_at promises a smaller error for it. */
static int exact_rows(fvi_table *t, const fvi_linear_oscillator *problem)
{
    const size_t N = t->o->steps, MOST = (size_t)1 << 24; /* 2 MOST doubles are 256 MB */
    long_table all = { NULL, NULL, FVI_SUCCESS };
    if (N > BATCH && N < MOST && t->o->every < 32 && !problem->law
        && isfinite((double)N * t->o->h))
        all.x = malloc(2 * (N + 1) * sizeof *all.x);
    if (all.x) {
        all.v = all.x + N + 1;
        all.status = fvi_exact_grid(problem, t->o->h, N, 0, all.x, all.v, NULL);
        if (all.status != FVI_SUCCESS && all.status != FVI_EOVRFLW
            && all.status != FVI_ELOSS) { /* x and v hold nothing of use */
            free(all.x);
            all.x = NULL;
        }
    }
    const int failed = exact_batches(t, problem, &all);
    free(all.x);
    return failed;
}

static fvi_linear_oscillator linear_problem(const fvi_options *o)
{
    fvi_forcing forcing = FVI_FORCING_NONE;
    double constants[2] = { 0 };
    fvi_typed_force_is_simple(o->force, &forcing, constants);
    const int is_free = o->potential.kind == FVI_POTENTIAL_FREE;
    return (fvi_linear_oscillator){ .m = o->mass[0],
                         .c = is_free ? 0 : o->potential.constants[0],
                         .rho = o->rho[0],
                         .alpha = o->alpha,
                         .past = o->past,
                         .x0 = o->x0[0],
                         .v0 = o->p0[0] / o->mass[0],
                         .forcing = forcing,
                         .A = constants[0],
                         .T = constants[1],
                         .w = constants[1],
                         .law = o->text[DAMPING] ? &o->damping.law : NULL };
}

int fvi_command_exact(const fvi_options *o, const fvi_system *system)
{
    if (!fvi_is_oscillator(o) || fvi_options_observes(o))
        return fvi_command_exact_motion(o, system);
    const fvi_linear_oscillator problem = linear_problem(o);
    fvi_table t;
    double re, im;
    fvi_error error = { 0 };
    const int status = problem.law ? fvi_exact_pole(&problem, &re, &im, &error) : FVI_SUCCESS;
    if (status && status != FVI_EDOM) /* FVI_EDOM: the motion does not oscillate */
        return fvi_complain(
            status == FVI_EUNSUP
                ? "--damping: a motion with more than three oscillations has "
                  "no exact solution here"
                : *error.text ? error.text : fvi_reason(status));
    fvi_table_shape(&t, o, system);
    if (!(t.rows = fvi_table_room(&t, 0)))
        return fvi_complain("not enough memory");
    int failed = fvi_table_open(&t);
    if (!failed) {
        fvi_table_head(t.out, o);
        fvi_table_names(&t);
        failed = fvi_table_close(&t, exact_rows(&t, &problem));
    }
    free(t.rows);
    return failed;
}
