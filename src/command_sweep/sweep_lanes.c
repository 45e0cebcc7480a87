/* src/command_sweep/sweep_lanes.c -- Make runs of a sweep that take their steps together. */
#include "sweep_lanes.h"
#include "command_shared/fvi_run_rows.h"
#include "options/fvi_option_columns.h"
#include "options/fvi_options.h"
#include "output/fvi_table.h"

#include <fvi/fvi.h>

#include <stdlib.h>

/* ---- one lane ---- */

typedef struct {
    fvi_options o;
    fvi_system system;
    fvi_table table;
    sweep_verdict verdict;
    int is_open; /* nonzero if the options must be freed */
} lane;

/* Return why a run with these options must be made alone, or NULL if it need not. */
static const char *reason_to_run_alone(const fvi_options *o)
{
    const fvi_system system = fvi_options_system(o);
    const fvi_run run = fvi_options_run(o, &system);
    const unsigned of_all = FVI_OBSERVE_WORK | FVI_OBSERVE_MULTIPLIER | FVI_OBSERVE_CONTACT;
    return o->error > 0                                      ? "each has steps of its own"
           : fvi_typed_columns_wanted(o->typed) & of_all     ? "the columns have work"
                                                             : fvi_batch_refusal(o->method, 1, &run);
}

static int open_lane(const sweep_grid *g, size_t i, lane *l)
{
    if (sweep_grid_options(g, i, &l->o, NULL))
        return 0;
    l->is_open = 1;
    l->system = fvi_options_system(&l->o);
    return !reason_to_run_alone(&l->o) && sweep_table_open(g, &l->o, &l->system, &l->table);
}

static void close_lane(lane *l)
{
    if (!l->is_open)
        return;
    free(l->table.rows);
    fvi_options_free(&l->o);
}

static int has_reductions(const lane *l)
{
    return fvi_reductions_count(l->o.typed) > 0;
}

/* ---- all lanes ---- */

/* The stepper of all lanes, and its observer if a column needs one. */
typedef struct {
    fvi_stepper *stepper;
    fvi_observer *observer;
} active_lanes;

/* Return the part of an observation that belongs to lane l. */
static fvi_observation part_of(const fvi_observation *now, size_t l)
{
    return (fvi_observation){ .x = now->x + l,
                              .p = now->p + l,
                              .a = now->a + l,
                              .force = now->force + l,
                              .impulse = now->impulse + l,
                              .is_mean = now->is_mean };
}

/* Take row k of each lane, or add it to the reductions. */
static int store_rows(size_t count, lane *lanes, const active_lanes *all, size_t k)
{
    const fvi_stepper *s = all->stepper;
    fvi_observation now;
    int status = all->observer ? fvi_observer_read(all->observer, s, s->t, &now) : FVI_SUCCESS;
    for (size_t l = 0; l < count && !status; l++)
        if (all->observer) {
            const fvi_observation part = part_of(&now, l);
            status = fvi_run_observed_row(&lanes[l].table, k, &part);
        } else
            status = fvi_run_state_row(&lanes[l].table, k, s->x + l, s->p + l);
    return status;
}

/* Check whether a step of a lane is unstable. */
static int check_steps(size_t count, lane *lanes)
{
    char text[FVI_WARNING_ROOM];
    for (size_t l = 0; l < count; l++) {
        const fvi_run run = fvi_options_run(&lanes[l].o, &lanes[l].system);
        lanes[l].verdict.unstable = fvi_warning_of_step(lanes[l].o.method, &run, sizeof text, text);
        if (lanes[l].verdict.unstable < 0)
            return FVI_ENOMEM;
    }
    return FVI_SUCCESS;
}

static int step_lanes(size_t count, lane *lanes, const active_lanes *all)
{
    const size_t steps = lanes->o.steps;
    fvi_stepper *s = all->stepper;
    int status = store_rows(count, lanes, all, 0);
    for (size_t k = 0; !status && k < steps;) {
        k = has_reductions(lanes) ? k + 1 : fvi_table_next(&lanes->table, k);
        while (!status && s->k < k)
            status = all->observer ? fvi_observer_step(all->observer, s) : fvi_stepper_step(s);
        if (!status)
            status = store_rows(count, lanes, all, k);
    }
    return status ? status : check_steps(count, lanes);
}

static int run_to_rows(const fvi_run *run, size_t count, lane *lanes)
{
    active_lanes all = { NULL, NULL };
    int status = fvi_stepper_start(lanes->o.method, run, &all.stepper, NULL);
    if (!status && fvi_options_needs_stepper(&lanes->o))
        status = fvi_observer_start(all.stepper, fvi_typed_columns_wanted(lanes->o.typed), &all.observer, NULL);
    if (!status)
        status = step_lanes(count, lanes, &all);
    fvi_observer_free(all.observer);
    fvi_stepper_free(all.stepper);
    return status;
}

static int run_lanes(size_t count, lane *lanes)
{
    fvi_run run[FVI_BATCH_MOST];
    fvi_batch *batch;
    for (size_t l = 0; l < count; l++)
        run[l] = fvi_options_run(&lanes[l].o, &lanes[l].system);
    if (fvi_batch_refusal(lanes->o.method, count, run)
        || fvi_batch_alloc(lanes->o.method, count, run, &batch, NULL))
        return 0;
    const int status = run_to_rows(fvi_batch_run(batch), count, lanes);
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

/* Return nonzero if runs with different values of this axis cannot go together, because they have other steps or
 * another memory. Runs may differ in starts, masses and rho. With stages they may not differ in masses and rho, because
 * the memory depends on them. */
static int separates_runs(const fvi_axis *a, int has_stages)
{
    static const char *const names[] = { "rho", "mass", "x0", "p0", "v0", NULL };
    return !a->is_let && !fvi_is_one_of(a->name, names + (has_stages ? 2 : 0));
}

typedef struct {
    size_t key, run;
} keyed_run;

static int compare_keys(const void *a, const void *b)
{
    const keyed_run *x = a, *y = b;
    return x->key != y->key ? (x->key > y->key) - (x->key < y->key)
                            : (x->run > y->run) - (x->run < y->run);
}

/* Return a number that is the same for runs that may go together. An observer finds out once for all lanes whether
 * anything is damped, and whether the start makes a force infinite. So with an observer a start or a damping of 0 gets
 * its own number. */
static size_t key_of(const sweep_grid *g, size_t i, int has_stages, int is_observed)
{
    size_t key = 0;
    for (size_t n = 0; n < g->count; n++) {
        const double value = sweep_grid_value(g, i, n);
        size_t behind = 1;
        for (size_t m = n + 1; m < g->count; m++)
            behind *= g->axis[m].range.count;
        key *= g->axis[n].range.count + 1;
        if (separates_runs(g->axis + n, has_stages))
            key += i / behind % g->axis[n].range.count;
        else if (is_observed && !g->axis[n].is_let)
            key += value == 0;
    }
    return key;
}

static void fill_lanes(const sweep_grid *g, const keyed_run *runs, sweep_plan *plan)
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
    const int is_observed = fvi_options_needs_stepper(o);
    const size_t each = g->runs / g->jobs,
                 wanted = g->lanes ? g->lanes : each < FVI_BATCH_MOST ? each : FVI_BATCH_MOST;
    keyed_run *runs = malloc((g->runs + 1) * sizeof *runs);
    *plan = (sweep_plan){ .most = wanted < 1 ? 1 : wanted,
                          .order = malloc((g->runs + 1) * sizeof *plan->order),
                          .group = malloc((g->runs + 1) * sizeof *plan->group),
                          .why = reason_to_run_alone(o) };
    if (!runs || !plan->order || !plan->group) {
        free(runs);
        sweep_plan_free(plan);
        return FVI_ENOMEM;
    }
    if (plan->why)
        plan->most = 1;
    for (size_t i = 0; i < g->runs; i++) {
        const size_t run = g->first + i;
        runs[i] = (keyed_run){ plan->most > 1 ? key_of(g, run, o->method->stages > 0, is_observed) : i, run };
    }
    qsort(runs, g->runs, sizeof *runs, compare_keys);
    fill_lanes(g, runs, plan);
    free(runs);
    return FVI_SUCCESS;
}

void sweep_plan_free(sweep_plan *plan)
{
    free(plan->order);
    free(plan->group);
    plan->order = plan->group = NULL;
}

/* The reason is that of the first group. If groups have one run, it is that of the first two groups together. */
const char *sweep_why_apart(const sweep_grid *g, const sweep_plan *plan)
{
    lane lanes[FVI_BATCH_MOST] = { { .is_open = 0 } };
    fvi_run run[FVI_BATCH_MOST];
    if (plan->why || plan->most < 2 || g->runs < 2)
        return plan->why;
    const size_t together = plan->group[1], count = together < 2 ? 2 : together;
    int is_open = 1;
    for (size_t l = 0; l < count && is_open; l++) {
        is_open = open_lane(g, plan->order[l], lanes + l);
        if (is_open)
            run[l] = fvi_options_run(&lanes[l].o, &lanes[l].system);
    }
    const char *why = is_open ? fvi_batch_refusal(lanes->o.method, count, run) : NULL;
    for (size_t l = 0; l < count; l++)
        close_lane(lanes + l);
    return why || together > 1 ? why : "a start or a damping is 0, and the columns have forces";
}
