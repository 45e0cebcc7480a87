/* src/newton/band.h -- Solve linear equations with a band matrix.             [H 2]
 *
 * A band matrix J is an n by n matrix with J_ij = 0 for |i - j| > w. Its LU factorisation exchanges rows, because J
 * need not be definite. An exchange may fill w more diagonals on the right. So row i has room for the columns i - w,
 * ..., i + 2 w. If this is n columns or more, the matrix is stored in full. Memory: O(n w) numbers. */
#ifndef FVI_BAND_H
#define FVI_BAND_H

#include <stddef.h>

typedef struct {
    size_t n, w, stride;
    double *entry; /* J_ij is entry[i * stride + j] */
    size_t size;   /* number of doubles in block */
    double *block; /* the allocated memory, owned */
    size_t *pivot; /* row k was exchanged with row pivot[k]; owned */
} fvi_band;

/* fvi_band_alloc -- Allocate J with all entries zero. Free it with fvi_band_free. Return FVI_SUCCESS or FVI_ENOMEM. The
 * function does not call the error handler. */
int fvi_band_alloc(size_t n, size_t w, fvi_band *J);

/* fvi_band_copy -- Copy the entries or the factors to a matrix of the same size. */
void fvi_band_copy(const fvi_band *from, fvi_band *to);

/* fvi_band_clear -- Set all entries to zero. */
void fvi_band_clear(fvi_band *J);

/* fvi_band_row -- Return row i: fvi_band_row(J, i)[j] is J_ij for |i - j| <= w. */
static inline double *fvi_band_row(const fvi_band *J, size_t i)
{
    return J->entry + i * J->stride;
}

/* fvi_band_factorise -- Replace J by its LU factors. Return FVI_SUCCESS, or FVI_ESING if a pivot
 * is zero. Cost: O(n w^2). */
int fvi_band_factorise(fvi_band *J);

/* fvi_band_solve -- Replace v by J^-1 v. J holds its factors. Cost: O(n w). */
void fvi_band_solve(const fvi_band *J, double *v);

/* fvi_band_free -- Free the memory of J. A zeroed J is allowed. */
void fvi_band_free(fvi_band *J);

#endif
