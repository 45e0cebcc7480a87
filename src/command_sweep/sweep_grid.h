/* src/command_sweep/sweep_grid.h -- The runs of a sweep. */
#ifndef FVI_SWEEP_GRID_H
#define FVI_SWEEP_GRID_H

#include "options/fvi_option_list.h"
#include "options/fvi_range.h"

enum { FVI_MOST_AXES = 3 };

/* NAME=A:B:N[:log], a --vary: N values from A to B of an option, or of a parameter of the
 * expressions. */
typedef struct {
    char name[64];
    int is_let;
    fvi_range range;
    double *list; /* the range.count values; NULL of a long range */
} fvi_axis;

/* The words of `fvi sweep`. The runs are numbered with the last axis fastest. */
typedef struct {
    fvi_axis axis[FVI_MOST_AXES];
    size_t count;       /* of the axes */
    size_t first, runs; /* of this part */
    size_t part, parts; /* part I of K, I from 1 */
    size_t jobs;
    size_t lanes; /* runs that take their steps together, at most; 0: nothing is said */
    int has_rows; /* all rows of each run, and not the last alone */
    char text[400]; /* all axes, as they were given */
    char part_text[64];
    char lets[1024]; /* --let without those that are varied */
    char **
        words; /* those for `fvi run`, behind room for that, and for each axis */
    int word_count; /* without these */
} sweep_grid;

/* sweep_grid_parse -- understand argv, all but what is for `fvi run`. Returns as
 * fvi_options_parse; free the grid with sweep_grid_free in any case. */
int sweep_grid_parse(int argc, char **argv, sweep_grid *g, fvi_error *c);
void sweep_grid_free(sweep_grid *g);

/* sweep_grid_options -- the options of run i, counted in the whole grid. As
 * fvi_options_parse. */
int sweep_grid_options(const sweep_grid *g, size_t i, fvi_options *o,
                       fvi_error *c);

/* sweep_grid_check -- does each name that is no option stand in another word? Whether that is
 * an expression sweep_grid_options sees. Returns 0, or FVI_EINVAL. */
int sweep_grid_check(const sweep_grid *g, fvi_error *c);

/* sweep_grid_value -- of axis n in run i, as fvi_range_value. */
double sweep_grid_value(const sweep_grid *g, size_t i, size_t n);

/* sweep_grid_has -- nonzero if the name is varied. */
int sweep_grid_has(const sweep_grid *g, const char *name);

#endif
