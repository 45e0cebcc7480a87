/* src/problem/data.h -- Read numbers from files. */
#ifndef FVI_DATA_H
#define FVI_DATA_H

#include <fvi/error.h>

/* fvi_data_numbers -- Read all numbers of a file, in the format of rows.h. `field` is for the error.
 *
 *   most    room in values; further numbers are counted but not kept
 *   n       output: number of numbers in the file
 *
 * Return FVI_SUCCESS; FVI_EINVAL with an error that names the line and the column; FVI_ENOMEM. */
int fvi_data_numbers(const char *field, const char *file, size_t most,
                     double *values, size_t *n, fvi_error *error);

#endif
