/* src/program/sweep_lanes.c -- Runs of a sweep that take their steps together. */
#include "sweep_lanes.h"
#include "fvi_run.h"
#include "options/fvi_option_columns.h"
#include "options/fvi_options.h"
#include "output/fvi_table.h"

#include <fvi/fvi.h>

#include <stdlib.h>
#include <string.h>

/* ---- one lane ---- */

typedef struct {
    fvi_options o;
    fvi_system system;
    fvi_table table;
    sweep_verdict verdict;
    int is_open; /* are the options there? */
} lane;

/* Why a run with these options goes alone; NULL if it need not. */
static const char *refusal(const fvi_options *o)
{
    const fvi_system system = fvi_options_system(o);
    const fvi_run run = fvi_options_run(o, &system);
    return o->error > 0                    ? "each has steps of its own"
           : fvi_options_needs_stepper(o) ? "the columns have sums over the steps"
                                          : fvi_batch_refusal(o->method, 1, &run);
}

static int open_lane(const sweep_grid *g, size_t i, lane *l)
{
    if (sweep_grid_options(g, i, &l->o, NULL))
        return 0;
    l->is_open = 1;
    l->system = fvi_options_system(&l->o);
    return !refusal(&l->o) && sweep_table_open(g, &l->o, &l->system, &l->table);
}

static void close_lane(lane *l)
{
    if (!l->is_open)
        return;
    free(l->table.rows);
    fvi_options_free(&l->o);
}

static int reduces(const lane *l)
{
    return fvi_reductions_count(l->o.typed) > 0;
}

/* ---- all lanes ---- */

/* Row k of each lane, or what a reduction asks for. */
static int take_rows(size_t count, lane *lanes, const fvi_stepper *s, size_t k)
{
    int status = FVI_SUCCESS;
    for (size_t l = 0; l < count && !status; l++)
        status = fvi_run_state_row(&lanes[l].table, k, s->x + l, s->p + l);
    return status;
}

/* The last row of reductions, and whether a mode grows. */
static int finish(size_t count, lane *lanes)
{
    char text[FVI_WARNING_ROOM];
    for (size_t l = 0; l < count; l++) {
        const fvi_run run = fvi_options_run(&lanes[l].o, &lanes[l].system);
        if (reduces(lanes + l))
            fvi_run_reduced(&lanes[l].table, lanes[l].table.rows + lanes[l].table.width);
        lanes[l].verdict.unstable = fvi_warning_of_step(lanes[l].o.method, &run, sizeof text, text);
        if (lanes[l].verdict.unstable < 0)
            return FVI_ENOMEM;
    }
    return FVI_SUCCESS;
}

static int take_steps(size_t count, lane *lanes, fvi_stepper *s)
{
    const size_t steps = lanes->o.steps;
    int status = take_rows(count, lanes, s, 0);
    for (size_t k = 0; !status && k < steps;) {
        k = reduces(lanes) ? k + 1 : fvi_table_next(&lanes->table, k);
        while (!status && s->k < k)
            status = fvi_stepper_step(s);
        if (!status)
            status = take_rows(count, lanes, s, k);
    }
    return status ? status : finish(count, lanes);
}

static int run_lanes(size_t count, lane *lanes)
{
    fvi_run run[FVI_BATCH_MOST];
    fvi_batch *batch;
    fvi_stepper *s;
    for (size_t l = 0; l < count; l++)
        run[l] = fvi_options_run(&lanes[l].o, &lanes[l].system);
    if (fvi_batch_refusal(lanes->o.method, count, run)
        || fvi_batch_alloc(lanes->o.method, count, run, &batch, NULL))
        return 0;
    int status = fvi_stepper_start(lanes->o.method, fvi_batch_run(batch), &s, NULL);
    if (!status) {
        status = take_steps(count, lanes, s);
        fvi_stepper_free(s);
    }
    fvi_batch_free(batch);
    return !status;
}

int sweep_run_group(const sweep_grid *g, size_t count, const size_t *run, double *const *rows,
                    sweep_verdict *const *verdict)
{
    lane *lanes = calloc(count, sizeof *lanes);
    int is_done = lanes != NULL;
    for (size_t l = 0; l < count && is_done; l++)
        is_done = open_lane(g, run[l], lanes + l);
    is_done = is_done && run_lanes(count, lanes);
    for (size_t l = 0; l < count && is_done; l++) {
        lanes[l].verdict.lanes = count;
        sweep_keep_rows(g, run[l], &lanes[l].o, &lanes[l].table, &lanes[l].verdict, rows[l]);
        *verdict[l] = lanes[l].verdict;
    }
    for (size_t l = 0; l < count && lanes; l++)
        close_lane(lanes + l);
    free(lanes);
    return is_done;
}

/* ---- which runs ---- */

/* Runs that differ in these have steps of their own, or another memory. */
static int divides(const fvi_axis *a)
{
    static const char *const names[] = { "rho", "mass", "x0", "p0", "v0", NULL };
    for (size_t i = 0; names[i]; i++)
        if (strcmp(a->name, names[i]) == 0)
            return 0;
    return !a->is_let;
}

typedef struct {
    size_t key, run;
} keyed_run;

static int by_key(const void *a, const void *b)
{
    const keyed_run *x = a, *y = b;
    return x->key != y->key ? (x->key > y->key) - (x->key < y->key)
                            : (x->run > y->run) - (x->run < y->run);
}

/* The same number for runs that may go together. */
static size_t key_of(const sweep_grid *g, size_t i)
{
    size_t key = 0, place = 1;
    for (size_t n = g->count; n-- > 0; i /= g->axis[n].range.count) {
        const size_t count = g->axis[n].range.count;
        if (!divides(g->axis + n))
            continue;
        key += i % count * place;
        place *= count;
    }
    return key;
}

static void fill(const sweep_grid *g, const keyed_run *runs, sweep_plan *plan)
{
    for (size_t i = 0; i < g->runs; i++) {
        const int begins = i == 0 || runs[i].key != runs[i - 1].key
                           || i - plan->group[plan->groups - 1] == plan->most;
        plan->order[i] = runs[i].run;
        if (begins)
            plan->group[plan->groups++] = i;
    }
    plan->group[plan->groups] = g->runs;
}

int sweep_plan_make(const sweep_grid *g, const fvi_options *o, sweep_plan *plan)
{
    const size_t each = g->runs / g->jobs,
                 wanted = g->lanes ? g->lanes : each < FVI_BATCH_MOST ? each : FVI_BATCH_MOST;
    keyed_run *runs = malloc((g->runs + 1) * sizeof *runs);
    *plan = (sweep_plan){ .most = wanted < 1 ? 1 : wanted,
                          .order = malloc((g->runs + 1) * sizeof *plan->order),
                          .group = malloc((g->runs + 1) * sizeof *plan->group),
                          .why = refusal(o) };
    if (!runs || !plan->order || !plan->group) {
        free(runs);
        sweep_plan_free(plan);
        return FVI_ENOMEM;
    }
    if (plan->why)
        plan->most = 1;
    for (size_t i = 0; i < g->runs; i++)
        runs[i] = (keyed_run){ plan->most > 1 ? key_of(g, g->first + i) : i, g->first + i };
    qsort(runs, g->runs, sizeof *runs, by_key);
    fill(g, runs, plan);
    free(runs);
    return FVI_SUCCESS;
}

void sweep_plan_free(sweep_plan *plan)
{
    free(plan->order);
    free(plan->group);
    plan->order = plan->group = NULL;
}
