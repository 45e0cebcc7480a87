/* src/system/damping_matrix.h -- Multiply by a damping matrix that is given as functions.  [H 27] */
#ifndef FVI_DAMPING_MATRIX_H
#define FVI_DAMPING_MATRIX_H

#include <fvi/system.h>

/* fvi_damping_multiply -- Compute y += factor C x, d numbers each. Return FVI_SUCCESS; FVI_ENOMEM; or the code of the
 * matrix. */
int fvi_damping_multiply(const fvi_damping_matrix *C, size_t d, double factor, const double *x, double *y);

#endif
