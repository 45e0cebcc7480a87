/* src/stages/lobatto_eigenvalues.h -- The eigenvalues and eigenvectors of the Lobatto IIIC matrix.   [H 27] */
#ifndef FVI_LOBATTO_EIGENVALUES_H
#define FVI_LOBATTO_EIGENVALUES_H

#include "lobatto_weights.h"

#include <complex.h>

/* An eigenvalue lambda of A^{-1} and its eigenvector v. The projector on v is v w^T with w_i = b_i v_{s-1-i}. */
typedef struct {
    double complex lambda, v[FVI_STAGES];
} fvi_lobatto_pair;

/* fvi_lobatto_eigenvalues -- Write the (s + 1)/2 eigenvalues with Im lambda >= 0 and their eigenvectors to pair. A real
 * eigenvalue comes first. [(27.13)]
 *
 *     f(A^{-1}) = sum over the pairs of f(lambda) v w^T, plus its conjugate if lambda is not real
 *
 *   s     number of stages, 2 to 8
 *   pair  output, room for FVI_STAGES / 2 pairs
 *
 * Every number is the nearest double. Return the number of pairs, or 0 if s is not in 2, ..., 8. */
size_t fvi_lobatto_eigenvalues(size_t s, fvi_lobatto_pair *pair);

#endif
