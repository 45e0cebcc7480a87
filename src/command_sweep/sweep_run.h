/* src/command_sweep/sweep_run.h -- One run of a sweep. */
#ifndef FVI_SWEEP_RUN_H
#define FVI_SWEEP_RUN_H

#include "output/fvi_table.h"
#include "sweep_grid.h"

/* What became of a run: 0, or a code, and the step in which it failed; 0 is its start. Does a
 * mode of it grow by its step? Was the inertia of its Lagrangian nearly singular on the way? */
typedef struct {
    int status;
    size_t step;
    int unstable, singular;
    size_t rows; /* how many there are: less where an event ends the run */
    size_t lanes; /* so many runs took their steps together; 0: this one alone */
} sweep_verdict;

/* sweep_run_rows -- how many rows a run with these options gives. */
size_t sweep_run_rows(const sweep_grid *g, const fvi_options *o);

/* sweep_run -- run number i of the whole grid into its rows: the values of the grid, then the columns; of the
 * last step where one row is asked for. `rows` has room for the rows of the run; where it fails they are
 * not written. */
sweep_verdict sweep_run(const sweep_grid *g, size_t i, double *rows);

/* sweep_table_open -- a table for a run that keeps its rows: all, or the first and the last. Returns 0 without
 * memory; its rows are to be freed. */
int sweep_table_open(const sweep_grid *g, fvi_options *o, const fvi_system *system, fvi_table *t);

/* sweep_keep_rows -- those rows of a table of run i that the sweep prints, behind the values of the grid;
 * *v then says how many they are. */
void sweep_keep_rows(const sweep_grid *g, size_t i, const fvi_options *o, const fvi_table *t,
                     sweep_verdict *v, double *rows);

#endif
