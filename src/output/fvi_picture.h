/* src/output/fvi_picture.h -- A picture of rows of numbers, drawn by gnuplot. */
#ifndef FVI_PICTURE_H
#define FVI_PICTURE_H

#include <stddef.h>
#include <stdio.h>

/* fvi_plot_begin -- a place for the rows; NULL if there is none, or no gnuplot, after it
 * has said so. */
FILE *fvi_plot_begin(void);

/* fvi_plot_row -- one more row: the number t, and `width` others. */
void fvi_plot_row(FILE *rows, double t, size_t width, const double *row);

/* fvi_picture -- what is to become of the rows.
 *
 *   name    FILE.svg or FILE.png
 *   width, height  of the picture, in points
 *   script  writes gnuplot's commands, of which $rows are the rows */
typedef struct {
    const char *name;
    size_t width, height;
    void (*script)(FILE *g, const void *params);
    const void *params;
} fvi_picture;

/* fvi_picture_end -- draw the rows: of more than 5000 each k-th. The picture is complete, or what was
 * there stays. With draw == 0 nothing is drawn. Closes rows; NULL is allowed.
 * Returns 0, or 1 after it has said why not. */
int fvi_picture_end(FILE *rows, const fvi_picture *picture, int draw);

#endif
