/* src/command_sweep/sweep_grid.h -- Read the options of a sweep, and build its runs. */
#ifndef FVI_SWEEP_GRID_H
#define FVI_SWEEP_GRID_H

#include "options/fvi_option_list.h"
#include "options/fvi_range.h"

enum { FVI_MOST_AXES = 3 };

/* An axis, NAME=A:B:N[:log] or NAME=V1,V2,... of --vary: values of an option, or of a parameter of the expressions. */
typedef struct {
    char name[64];
    int is_let;
    fvi_range range; /* with the list of its values, unless it is long */
} fvi_axis;

/* The options of `fvi sweep`. In the numbers of the runs the last axis varies fastest. */
typedef struct {
    fvi_axis axis[FVI_MOST_AXES];
    size_t count;       /* number of axes */
    size_t first, runs; /* first run and number of runs of this part */
    size_t part, parts; /* part I of K, I from 1 */
    size_t jobs;
    size_t lanes; /* most runs that take their steps together; 0: not given */
    int has_rows; /* nonzero: print all rows of each run, not only the last one */
    char text[400]; /* all axes, as they were given */
    char part_text[64];
    char lets[1024]; /* values of --let, without the parameters that are varied */
    char **
        words; /* words for `fvi run`, after room for "fvi run" and for each axis */
    int word_count; /* number of these words, without that room */
} sweep_grid;

/* sweep_grid_parse -- Interpret the options of a sweep in argv. Return what fvi_options_parse returns. Free the grid
 * with sweep_grid_free in each case. */
int sweep_grid_parse(int argc, char **argv, sweep_grid *g, fvi_error *c);
void sweep_grid_free(sweep_grid *g);

/* sweep_grid_options -- Make the options of run i of the whole grid. Return what fvi_options_parse returns. */
int sweep_grid_options(const sweep_grid *g, size_t i, fvi_options *o,
                       fvi_error *c);

/* sweep_grid_check -- Check that each varied name that is no option stands in another word. sweep_grid_options will
 * check that it stands in an expression. Return 0, or a code of fvi/error.h with the error filled in. */
int sweep_grid_check(const sweep_grid *g, fvi_error *c);

/* sweep_grid_value -- Return the value of axis n in run i of the whole grid. */
double sweep_grid_value(const sweep_grid *g, size_t i, size_t n);

/* sweep_grid_has -- Return nonzero if this name is varied. */
int sweep_grid_has(const sweep_grid *g, const char *name);

#endif
