/* src/system/lu.h -- Factors of a small full matrix.                    [H 17] */
#ifndef FVI_LU_H
#define FVI_LU_H

#include <gsl/gsl_matrix.h>
#include <gsl/gsl_permutation.h>

/* fvi_lu_factorise -- P A = L U with row exchanges, in the place of A, n by n; permutation has
 * room for n and becomes P. With both gsl_linalg_LU_svx and gsl_linalg_LU_invert work,
 * which take nothing from the heap. gsl_linalg_LU_decomp, whose digits these are, does: its
 * list of exchanges, and where that is not to be had it ends the process. A pivot
 * that is zero is for the caller to see.  Cost O(n^3) */
void fvi_lu_factorise(gsl_matrix *A, gsl_permutation *permutation);

#endif
