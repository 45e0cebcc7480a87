/* src/system/lu.h -- Factorise a small full matrix.                    [H 17] */
#ifndef FVI_LU_H
#define FVI_LU_H

#include <gsl/gsl_matrix.h>
#include <gsl/gsl_permutation.h>

/* fvi_lu_factorise -- Compute P A = L U with row exchanges, in the place of A.
 *
 *   A            n by n matrix
 *   permutation  output, P; room for n numbers
 *
 * gsl_linalg_LU_svx and gsl_linalg_LU_invert accept these factors, and they allocate no memory. The digits are the
 * digits of gsl_linalg_LU_decomp. We do not call gsl_linalg_LU_decomp, because it allocates a list of exchanges and
 * ends the process if memory is short. The function does not test for a zero pivot; the caller must. Cost: O(n^3). */
void fvi_lu_factorise(gsl_matrix *A, gsl_permutation *permutation);

#endif
