/* src/matrices/cholesky.h -- Factorise a full positive definite matrix.    [H 30] */
#ifndef FVI_CHOLESKY_H
#define FVI_CHOLESKY_H

#include <stddef.h>

/* fvi_cholesky -- Compute A = L L^T. A is n by n, row by row; only its lower triangle is read, and L overwrites it.
 * Return FVI_SUCCESS, or FVI_ESING if a pivot is not positive. */
int fvi_cholesky(size_t n, double *A);

#endif
