/* src/output/fvi_plot.h -- A picture of a trajectory. */
#ifndef FVI_PLOT_H
#define FVI_PLOT_H

#include "fvi_picture.h"
#include "options/fvi_option_list.h"

#include <stdio.h>

/* fvi_plot_end -- draw the rows into o->plot: a panel over t for x, for energy and for y if they
 * are columns, for p if x is not, and the phase if x and p are. Of more than 6
 * coordinates the first 6 are drawn. Else as fvi_picture_end. */
int fvi_plot_end(FILE *rows, const fvi_options *o, int draw);

#endif
