/* src/output/fvi_picture.h -- Draw rows of numbers with gnuplot. */
#ifndef FVI_PICTURE_H
#define FVI_PICTURE_H

#include <stddef.h>
#include <stdio.h>

/* fvi_plot_begin -- Return a temporary file for the rows. NULL after a message if the file cannot be made or gnuplot is
 * not installed. */
FILE *fvi_plot_begin(void);

/* fvi_plot_row -- Write a row: the number t, and `width` other numbers. */
void fvi_plot_row(FILE *rows, double t, size_t width, const double *row);

/* fvi_picture -- What fvi_picture_end draws.
 *
 *   name           FILE.svg or FILE.png
 *   width, height  size of the picture, in points
 *   script         writes the commands of gnuplot, in which $rows are the rows; params is its second argument */
typedef struct {
    const char *name;
    size_t width, height;
    void (*script)(FILE *g, const void *params);
    const void *params;
} fvi_picture;

/* fvi_picture_end -- Draw the rows. Of more than 5000 rows only each k-th is drawn. The picture is complete, or the old
 * file stays. With draw == 0 nothing is drawn. The file `rows` is closed; it may be NULL. Return 0, or 1 after a
 * message. */
int fvi_picture_end(FILE *rows, const fvi_picture *picture, int draw);

#endif
