/* src/matrices/cholesky.h -- Factors of a full positive definite matrix.    [H 30] */
#ifndef FVI_CHOLESKY_H
#define FVI_CHOLESKY_H

#include <stddef.h>

/* fvi_cholesky -- A = L L^T. Of A, n by n numbers row by row, only the lower triangle is read. It
 * becomes L. Returns FVI_SUCCESS, or FVI_ESING if a pivot is not positive. */
int fvi_cholesky(size_t n, double *A);

#endif
