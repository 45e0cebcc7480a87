/* src/matrices/complex_factors.h -- Solve equations with a complex matrix.   [H 30] */
#ifndef FVI_COMPLEX_FACTORS_H
#define FVI_COMPLEX_FACTORS_H

#include <complex.h>
#include <stddef.h>

typedef struct fvi_complex_factors fvi_complex_factors;

/* fvi_complex_factors_alloc -- Allocate a solver for n by n matrices with this pattern of compressed columns
 * (fvi_sparse). The arrays must outlive the solver. start = NULL and row = NULL: dense matrices. Return
 * FVI_SUCCESS or FVI_ENOMEM. */
int fvi_complex_factors_alloc(size_t n, const int *start, const int *row,
                              fvi_complex_factors **factors);

/* fvi_complex_factors_of -- Factorise A: the entries of its pattern, or all n * n entries of a dense matrix. Return
 * FVI_SUCCESS, FVI_ESING or FVI_ENOMEM. */
int fvi_complex_factors_of(fvi_complex_factors *f, const double complex *A);

/* fvi_complex_factors_solve -- Replace x by A^-1 x. Return FVI_SUCCESS or FVI_ENOMEM. */
int fvi_complex_factors_solve(const fvi_complex_factors *f, double complex *x);

/* fvi_complex_factors_phase -- Return arg det A of a dense matrix, up to a multiple of 2 pi. */
double fvi_complex_factors_phase(const fvi_complex_factors *f);

/* fvi_complex_factors_free -- Free the solver. NULL is allowed. */
void fvi_complex_factors_free(fvi_complex_factors *f);

#endif
