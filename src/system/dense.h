/* src/system/dense.h -- Small full matrices that many vectors are multiplied by.    [H 27] */
#ifndef FVI_DENSE_H
#define FVI_DENSE_H

#include <stddef.h>

/* Rows come in eights, because eight sums run side by side. */
enum { FVI_DENSE_ROWS = 8 };

/* fvi_dense_rows -- n rounded up to eights. */
static inline size_t fvi_dense_rows(size_t n)
{
    return (n + FVI_DENSE_ROWS - 1) / FVI_DENSE_ROWS * FVI_DENSE_ROWS;
}

/* fvi_dense_invert -- A^-1 in the place of A, n by n, row by row: Gauss and Jordan, with exchanges of rows.
 *
 *   order  room for n numbers
 *
 * Returns FVI_SUCCESS, or FVI_ESING if a pivot is zero or no number. Cost n^3 products, 10 us for n = 40. */
int fvi_dense_invert(size_t n, double *A, size_t *order);

/* fvi_dense_multiply -- out = A in.
 *
 *   rows     a multiple of FVI_DENSE_ROWS
 *   A        column after column, `rows` numbers each
 *   in, out  `columns` and `rows` numbers
 *
 * The products of even and of odd columns are summed one after the other, and then both sums are added, whatever the
 * width of the vectors. Cost rows * columns / 16 ns. */
void fvi_dense_multiply(size_t rows, size_t columns, const double *A, const double *in, double *out);

#endif
