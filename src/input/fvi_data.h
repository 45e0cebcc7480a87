/* src/input/fvi_data.h -- Numbers from files. */
#ifndef FVI_DATA_H
#define FVI_DATA_H

#include "fvi_refuse.h"

/* fvi_data_numbers -- all numbers of a file, in rows as fvi_rows.h reads them, as the value
 * of --option.
 *
 *   most    room in values; more are counted, and not kept
 *   n       output: how many there are
 *
 * Returns 0; 2 after a complaint that names the line and the column; 1 if there is no
 * memory. */
int fvi_data_numbers(const char *option, const char *file, size_t most,
                     double *values, size_t *n, fvi_complaint c);

/* fvi_data_table -- two columns of a file of rows as fvi_rows.h reads them, all of as many
 * numbers.
 *
 *   names   of the columns. A line of words above the numbers in which both stand says
 *           which these are, also behind #, if it has as many words as the first row
 *           has numbers; one without # that has not is refused. If there is none, or NULL
 *           stands for names, the first two
 *   n       output: rows, at least one
 *   t, v    output: n numbers each, one block, free(*t). t increases
 *
 * Returns as fvi_data_numbers. */
int fvi_data_table(const char *option, const char *file,
                   const char *const names[2], size_t *n, double **t,
                   double **v, fvi_complaint c);

#endif
