/* src/command_sweep/sweep_run.h -- Make one run of a sweep. */
#ifndef FVI_SWEEP_RUN_H
#define FVI_SWEEP_RUN_H

#include "output/fvi_table.h"
#include "sweep_grid.h"

/* The outcome of a run. status is 0, or a code; step is the step that failed, 0 for the start. unstable is nonzero if a
 * mode grows because of the length of the step. singular is nonzero if the inertia of the Lagrangian was nearly
 * singular on the way. */
typedef struct {
    int status;
    size_t step;
    int unstable, singular;
    size_t rows; /* number of rows; fewer if an event ended the run */
    size_t lanes; /* number of runs that took their steps together; 0: this run was made alone */
} sweep_verdict;

/* sweep_run_rows -- Return the number of rows of a run with these options. */
size_t sweep_run_rows(const sweep_grid *g, const fvi_options *o);

/* sweep_run -- Make run number i of the whole grid. Each row contains the values of the grid and then the columns.
 * Without --rows there is one row, that of the last step. `rows` has room for the rows of the run; if the run fails it
 * is not written. Return the outcome. */
sweep_verdict sweep_run(const sweep_grid *g, size_t i, double *rows);

/* sweep_table_open -- Make a table that keeps its rows: all of them, or the first and the last one. Return 0 if there
 * is no memory, else 1. The caller frees t->rows. */
int sweep_table_open(const sweep_grid *g, fvi_options *o, const fvi_system *system, fvi_table *t);

/* sweep_keep_rows -- Copy the rows of run i that the sweep prints, or its reductions, with the values of the grid in
 * front. v->rows becomes the number of rows. */
void sweep_keep_rows(const sweep_grid *g, size_t i, const fvi_options *o, const fvi_table *t,
                     sweep_verdict *v, double *rows);

#endif
