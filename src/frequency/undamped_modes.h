/* src/frequency/undamped_modes.h -- K v = lambda M v, the lowest.        [H 30] */
#ifndef FVI_UNDAMPED_MODES_H
#define FVI_UNDAMPED_MODES_H

#include <fvi/structures.h>

/* Up to so many unknowns all modes come from full matrices. */
enum { FVI_FULL_MODES = 256 };

/* fvi_undamped_modes -- the lowest modes of symmetric M > 0 and K, lambda increasing.
 *
 *   count   1 <= count <= n
 *   lambda  output, count numbers
 *   v       output, count vectors of n numbers, with v^T M v = 1
 *
 * Up to FVI_FULL_MODES unknowns, or for more than a fourth of the modes, full matrices are taken
 * apart: 25 n^3 operations. Else subspace iteration with factors of K, in which lambda settles
 * to 1e-9 of itself: they are starts of Newton's method.
 * Returns FVI_SUCCESS; FVI_ESING if M is not positive definite; FVI_EMAXITER; FVI_ENOMEM. */
int fvi_undamped_modes(const fvi_sparse *M, const fvi_sparse *K, size_t count,
                       double *lambda, double *v);

#endif
