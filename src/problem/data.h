/* src/problem/data.h -- Read numbers from files. */
#ifndef FVI_DATA_H
#define FVI_DATA_H

#include <fvi/error.h>

/* fvi_data_numbers -- Read all numbers of a file, in the format of rows.h. The file is read once, so it may be a pipe.
 * `field` is for the error.
 *
 *   n       output: number of numbers in the file
 *   values  output: the numbers; free them with free, also after an error
 *
 * Return FVI_SUCCESS; FVI_EINVAL with an error that names the line and the column; FVI_ENOMEM. */
int fvi_data_numbers(const char *field, const char *file, size_t *n, double **values, fvi_error *error);

#endif
