/* src/newton/band.h -- Linear equations with a band matrix.             [H 2]
 *
 * An n by n matrix J with J_ij = 0 for |i - j| > w, and its LU factors with row
 * exchanges, which a matrix that is not definite needs. An exchange may fill w
 * diagonals more on the right, so row i has room for the columns i - w, ...,
 * i + 2w; where that is more than n, the matrix is full.  O(n w) numbers. */
#ifndef FVI_BAND_H
#define FVI_BAND_H

#include <stddef.h>

typedef struct {
    size_t n, w, stride;
    double *entry; /* J_ij at entry[i * stride + j] */
    size_t size;   /* numbers from *block on */
    double *block; /* owned */
    size_t *pivot; /* row k was exchanged with row pivot[k]; owned */
} fvi_band;

/* fvi_band_alloc -- room for J, all zero. Free it with fvi_band_free.
 * Returns 0 or FVI_ENOMEM; the caller tells the error handler. */
int fvi_band_alloc(size_t n, size_t w, fvi_band *J);

/* fvi_band_copy -- the entries, or factors, of a matrix of the same sizes. */
void fvi_band_copy(const fvi_band *from, fvi_band *to);

/* fvi_band_clear -- all entries zero, to be filled anew. */
void fvi_band_clear(fvi_band *J);

/* fvi_band_row -- row i: fvi_band_row(J, i)[j] is J_ij, |i - j| <= w. */
static inline double *fvi_band_row(const fvi_band *J, size_t i)
{
    return J->entry + i * J->stride;
}

/* fvi_band_factorise -- J becomes its LU factors.  Cost O(n w^2).
 * Returns 0, or FVI_ESING if a pivot is zero. */
int fvi_band_factorise(fvi_band *J);

/* fvi_band_solve -- v becomes the inverse of J times v, by the factors.
 * Cost O(n w). */
void fvi_band_solve(const fvi_band *J, double *v);

/* fvi_band_free -- give everything back; a zeroed band is allowed. */
void fvi_band_free(fvi_band *J);

#endif
