/* src/stages/lobatto_eigenvalues.h -- What the stages of Lobatto IIIC are made of.   [H 27] */
#ifndef FVI_LOBATTO_EIGENVALUES_H
#define FVI_LOBATTO_EIGENVALUES_H

#include "lobatto_weights.h"

#include <complex.h>

/* An eigenvalue of A^{-1}, and v: v w^T with w_i = b_i v_{s-1-i} is its projector. */
typedef struct {
    double complex lambda, v[FVI_STAGES];
} fvi_lobatto_pair;

/* fvi_lobatto_eigenvalues -- the (s + 1)/2 pairs with Im lambda >= 0; a real one comes first.  [(27.13)]
 *
 *     f(A^{-1}) = sum over the pairs of f(lambda) v w^T, plus its conjugate where lambda is not real
 *
 *   s     stages, 2 to 8
 *   pair  output, room for FVI_STAGES / 2 of them
 *
 * Every number is the nearest double. Returns how many pairs there are; 0 for another s. */
size_t fvi_lobatto_eigenvalues(size_t s, fvi_lobatto_pair *pair);

#endif
