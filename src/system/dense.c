/* src/system/dense.c -- Invert small full matrices and multiply them by vectors.    [H 27] */
#include "dense.h"

#include "vectors.h"
#include <fvi/error.h>

#include <math.h>

/* ---- inverse ---- */

/* Compute row -= factor * pivot_row, n numbers each. */
FVI_VECTORS static void subtract_multiple(size_t n, double factor, const double *restrict pivot_row,
                                          double *restrict row)
{
#pragma omp simd
    for (size_t l = 0; l < n; l++)
        row[l] -= factor * pivot_row[l];
}

static void exchange(double *x, double *y)
{
    const double kept = *x;
    *x = *y;
    *y = kept;
}

/* Find the row, from row j on, that has the largest entry in column j. Exchange this row with row j,
 * and return its old index. */
static size_t bring_pivot(size_t n, double *A, size_t j)
{
    size_t pivot = j;
    for (size_t i = j + 1; i < n; i++)
        if (fabs(A[i * n + j]) > fabs(A[pivot * n + j]))
            pivot = i;
    for (size_t l = 0; pivot != j && l < n; l++)
        exchange(&A[j * n + l], &A[pivot * n + l]);
    return pivot;
}

int fvi_dense_invert(size_t n, double *A, size_t *order)
{
    for (size_t j = 0; j < n; j++) {
        double *row = A + j * n;
        order[j] = bring_pivot(n, A, j);
        const double pivot = row[j];
        if (!(fabs(pivot) > 0 && isfinite(pivot)))
            return FVI_ESING;
        row[j] = 1;
        for (size_t l = 0; l < n; l++)
            row[l] /= pivot;
        for (size_t i = 0; i < n; i++)
            if (i != j) {
                const double factor = A[i * n + j];
                A[i * n + j] = 0;
                subtract_multiple(n, factor, row, A + i * n);
            }
    }
    for (size_t j = n; j-- > 0;) /* an exchange of two rows of A is an exchange of two columns of the inverse */
        for (size_t i = 0; order[j] != j && i < n; i++)
            exchange(&A[i * n + j], &A[i * n + order[j]]);
    return FVI_SUCCESS;
}

/* ---- product ---- */

/* four doubles side by side, at any address that suits a double */
typedef double four __attribute__((vector_size(32), aligned(8), may_alias));

/* Compute 4 * count rows of the product. The compiler knows count, so it unrolls the loops. */
static inline __attribute__((always_inline)) void
multiply_rows(size_t count, size_t rows, size_t columns, const double *A, const double *in, double *out)
{
    four even[6] = { { 0 } }, odd[6] = { { 0 } };
    size_t j = 0;
    for (; j + 1 < columns; j += 2, A += 2 * rows)
#pragma GCC unroll 6
        for (size_t i = 0; i < count; i++) {
            even[i] += *(const four *)(A + 4 * i) * in[j];
            odd[i] += *(const four *)(A + rows + 4 * i) * in[j + 1];
        }
#pragma GCC unroll 6
    for (size_t i = 0; i < count; i++) {
        if (j < columns)
            even[i] += *(const four *)(A + 4 * i) * in[j];
        *(four *)(out + 4 * i) = even[i] + odd[i];
    }
}

FVI_VECTORS static void multiply_dense(size_t rows, size_t columns, const double *A, const double *in, double *out)
{
    size_t i = 0;
    for (; i + 24 <= rows; i += 24)
        multiply_rows(6, rows, columns, A + i, in, out + i);
    if (i + 16 <= rows)
        multiply_rows(4, rows, columns, A + i, in, out + i);
    else if (i < rows)
        multiply_rows(2, rows, columns, A + i, in, out + i);
}

void fvi_dense_multiply(size_t rows, size_t columns, const double *A, const double *in, double *out)
{
    multiply_dense(rows, columns, A, in, out);
}
