/* src/matrices/complex_factors.h -- Equations with a complex matrix.   [H 30] */
#ifndef FVI_COMPLEX_FACTORS_H
#define FVI_COMPLEX_FACTORS_H

#include <complex.h>
#include <stddef.h>

typedef struct fvi_complex_factors fvi_complex_factors;

/* fvi_complex_factors_alloc -- room for factors of n by n matrices with this pattern, columns as
 * those of fvi_sparse; the arrays must outlive it. Dense factors take no pattern: NULL.
 * Returns FVI_SUCCESS or FVI_ENOMEM. */
int fvi_complex_factors_alloc(size_t n, const int *start, const int *row,
                              fvi_complex_factors **factors);

/* fvi_complex_factors_of -- factorise A: its entries in the pattern, or all n * n of them.
 * Returns FVI_SUCCESS, FVI_ESING or FVI_ENOMEM. */
int fvi_complex_factors_of(fvi_complex_factors *f, const double complex *A);

/* fvi_complex_factors_solve -- x becomes A^-1 x. Returns FVI_SUCCESS or FVI_ENOMEM. */
int fvi_complex_factors_solve(const fvi_complex_factors *f, double complex *x);

/* fvi_complex_factors_phase -- arg det A, by whole turns; of dense factors. */
double fvi_complex_factors_phase(const fvi_complex_factors *f);

/* fvi_complex_factors_free -- give everything back. NULL is allowed. */
void fvi_complex_factors_free(fvi_complex_factors *f);

#endif
