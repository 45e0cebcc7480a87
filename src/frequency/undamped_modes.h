/* src/frequency/undamped_modes.h -- Find the lowest modes of K v = lambda M v.        [H 30] */
#ifndef FVI_UNDAMPED_MODES_H
#define FVI_UNDAMPED_MODES_H

#include <fvi/structures.h>

/* Up to this number of unknowns all modes are computed from full matrices. */
enum { FVI_FULL_MODES = 256 };

/* fvi_undamped_modes -- Find the lowest modes of symmetric K and M, M positive definite, with increasing lambda.
 *
 *   count   1 <= count <= n
 *   lambda  output, count numbers
 *   v       output, count vectors of n numbers, with v^T M v = 1
 *
 * For up to FVI_FULL_MODES unknowns, or for more than a fourth of the modes, full matrices are decomposed with 25 n^3
 * operations. Otherwise subspace iteration with factors of K is used. lambda is then accurate to 1e-9, which is enough
 * to start Newton's method.
 * Return FVI_SUCCESS; FVI_ESING if M is not positive definite; FVI_EMAXITER; FVI_ENOMEM. */
int fvi_undamped_modes(const fvi_sparse *M, const fvi_sparse *K, size_t count,
                       double *lambda, double *v);

#endif
