/* src/output/fvi_plot.h -- A picture of a table, drawn by gnuplot. */
#ifndef FVI_PLOT_H
#define FVI_PLOT_H

#include "options/fvi_option_list.h"

#include <stdio.h>

/* fvi_plot_begin -- a place for the rows; NULL if there is none, or no gnuplot, after it
 * has said so. */
FILE *fvi_plot_begin(void);

/* fvi_plot_row -- one more row of `width` numbers, of the time t. */
void fvi_plot_row(FILE *rows, double t, size_t width, const double *row);

/* fvi_plot_end -- draw the rows into o->plot: a panel over t for x, for energy and for y if they
 * are columns, for p if x is not, and the phase if x and p are. Of more than 5000 rows
 * each k-th is drawn, of more than 6 coordinates the first 6. The picture is complete, or
 * what was there stays. With draw == 0 nothing is drawn. Closes rows; NULL is allowed.
 * Returns 0, or 1 after it has said why not. */
int fvi_plot_end(FILE *rows, const fvi_options *o, int draw);

#endif
