/* src/problem/data.h -- Numbers from files. */
#ifndef FVI_DATA_H
#define FVI_DATA_H

#include <fvi/error.h>

/* fvi_data_numbers -- all numbers of a file, in rows as rows.h reads them, as the value of the
 * field.
 *
 *   most    room in values; more are counted, and not kept
 *   n       output: how many there are
 *
 * Returns FVI_SUCCESS; FVI_EINVAL with an error that names the line and the column;
 * FVI_ENOMEM. */
int fvi_data_numbers(const char *field, const char *file, size_t most,
                     double *values, size_t *n, fvi_error *error);

#endif
