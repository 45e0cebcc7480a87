/* src/command_sweep/sweep_lanes.h -- Runs of a sweep that take their steps together. */
#ifndef FVI_SWEEP_LANES_H
#define FVI_SWEEP_LANES_H

#include "sweep_run.h"

/* Which runs go together: order is all numbers of runs of the whole grid; group number n is those from
 * group[n] to group[n + 1], and the runs of a group have the same steps and the same memory. */
typedef struct {
    size_t most;   /* runs in a group; 1: one by one */
    size_t groups;
    size_t *order, *group;
    const char *why; /* all runs go one by one; NULL if some need not */
} sweep_plan;

/* sweep_plan_make -- eight runs a group, but not so few groups that a process has none; as
 * g->lanes says if it is not 0. The runs of the sweep are o but for what is varied. Returns 0, or
 * FVI_ENOMEM. sweep_plan_free gives the plan back. */
int sweep_plan_make(const sweep_grid *g, const fvi_options *o, sweep_plan *plan);
void sweep_plan_free(sweep_plan *plan);

/* sweep_why_apart -- why all runs of the plan went one by one; NULL if that was asked for, or one of each group failed. */
const char *sweep_why_apart(const sweep_grid *g, const sweep_plan *plan);

/* sweep_run_group -- `count` runs, at most FVI_BATCH_MOST, as the coordinates of one (batch.h), each into
 * its rows as by sweep_run, to the bit, with its verdict. Returns 1; or 0 if they do not go together, or if one
 * of them failed: nothing is then known of them. */
int sweep_run_group(const sweep_grid *g, size_t count, const size_t *run, double *const *rows,
                    sweep_verdict *const *verdict);

#endif
