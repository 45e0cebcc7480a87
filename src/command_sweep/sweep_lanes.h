/* src/command_sweep/sweep_lanes.h -- Make runs of a sweep that take their steps together. */
#ifndef FVI_SWEEP_LANES_H
#define FVI_SWEEP_LANES_H

#include "sweep_run.h"

/* The plan of the groups. `order` contains the numbers of all runs in the whole grid. Group n contains the runs
 * order[i] for i = group[n], ..., group[n + 1] - 1. The runs of a group have the same steps and the same memory. */
typedef struct {
    size_t most;   /* most runs in a group; 1: one by one */
    size_t groups;
    size_t *order, *group;
    const char *why; /* why all runs go one by one; NULL if some may go together */
} sweep_plan;

/* sweep_plan_make -- Plan the groups. A group has at most g->lanes runs. If that is 0, it has eight, or fewer so that
 * no process is without a group. The runs of the sweep have the options o except for the varied ones. Return 0 or
 * FVI_ENOMEM.
 * sweep_plan_free -- Free the plan. */
int sweep_plan_make(const sweep_grid *g, const fvi_options *o, sweep_plan *plan);
void sweep_plan_free(sweep_plan *plan);

/* sweep_why_apart -- Return why all runs of the plan went one by one. NULL if that was asked for, or if in each group
 * one of the runs failed. */
const char *sweep_why_apart(const sweep_grid *g, const sweep_plan *plan);

/* sweep_run_group -- Make `count` runs, at most FVI_BATCH_MOST, as the coordinates of a single run (batch.h). rows[l]
 * and verdict[l] get the rows and the verdict of run[l]. The rows are the same to the last bit as by sweep_run. Return
 * 1, or 0 if the runs cannot go together or one of them failed; then no rows and no verdicts are written. */
int sweep_run_group(const sweep_grid *g, size_t count, const size_t *run, double *const *rows,
                    sweep_verdict *const *verdict);

#endif
