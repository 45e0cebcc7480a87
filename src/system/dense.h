/* src/system/dense.h -- Invert small full matrices and multiply them by vectors.    [H 27] */
#ifndef FVI_DENSE_H
#define FVI_DENSE_H

#include <stddef.h>

/* The number of rows is a multiple of eight, because the product computes eight sums side by side. */
enum { FVI_DENSE_ROWS = 8 };

/* fvi_dense_rows -- Return n rounded up to the next multiple of FVI_DENSE_ROWS. */
static inline size_t fvi_dense_rows(size_t n)
{
    return (n + FVI_DENSE_ROWS - 1) / FVI_DENSE_ROWS * FVI_DENSE_ROWS;
}

/* fvi_dense_invert -- Replace A by A^-1, by Gauss-Jordan elimination with row exchanges.
 *
 *   n      number of rows and of columns
 *   A      n * n numbers, row by row
 *   order  workspace for n numbers
 *
 * Return FVI_SUCCESS, or FVI_ESING if a pivot is zero or not finite. Cost: n^3 products, which take 10 us for n =
 * 40. */
int fvi_dense_invert(size_t n, double *A, size_t *order);

/* fvi_dense_multiply -- Compute out = A in.
 *
 *   rows     number of rows, a multiple of FVI_DENSE_ROWS
 *   A        the matrix column by column, `rows` numbers for each column
 *   in, out  `columns` numbers and `rows` numbers
 *
 * The function sums the products of the even columns, sums the products of the odd columns, and adds both sums. So the
 * digits of the result do not depend on the width of the vectors. Cost: rows * columns / 16 ns. */
void fvi_dense_multiply(size_t rows, size_t columns, const double *A, const double *in, double *out);

#endif
