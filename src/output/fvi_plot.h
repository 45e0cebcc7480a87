/* src/output/fvi_plot.h -- Draw a trajectory with gnuplot. */
#ifndef FVI_PLOT_H
#define FVI_PLOT_H

#include "fvi_picture.h"
#include "options/fvi_option_list.h"

#include <stdio.h>

/* fvi_plot_end -- Draw the rows to the file o->plot. There is a panel over t for each of x, energy and y that is a
 * column, for p if x is no column, and for each typed column, and a panel of p over x if both are columns. Two typed
 * columns and no others make a single panel, the second over the first. At most 6 coordinates are drawn. Otherwise as
 * fvi_picture_end. */
int fvi_plot_end(FILE *rows, const fvi_options *o, int draw);

#endif
