/* src/system/lu.c -- Factorise a small full matrix.                    [H 17] */
#include "lu.h"

#include <gsl/gsl_machine.h>
#include <math.h>

/* Return the row, from row j on, that has the largest entry in column j. The rows of A begin `stride` numbers apart. */
static size_t find_pivot(const double *A, size_t n, size_t stride, size_t j)
{
    size_t pivot = j;
    double largest = 0;
    for (size_t i = j; i < n; i++) {
        const double size = fabs(A[i * stride + j]);
        if (size > largest) {
            largest = size;
            pivot = i;
        }
    }
    return pivot;
}

/* Compute row[l] -= factor * of_j[l] for l = first, ..., n - 1. */
static void subtract_row(double *restrict row, const double *restrict of_j,
                         double factor, size_t first, size_t n)
{
    for (size_t l = first; l < n; l++)
        row[l] -= factor * of_j[l];
}

static void swap_rows(double *A, size_t n, size_t stride, size_t i, size_t j)
{
    for (size_t l = 0; i != j && l < n; l++) {
        const double kept = A[i * stride + l];
        A[i * stride + l] = A[j * stride + l];
        A[j * stride + l] = kept;
    }
}

/* The loops access the array directly, because a function call for each entry would cost more than the arithmetic. A
 * run with stages factorises some hundred matrices of at most 8 rows at its start. */
void fvi_lu_factorise(gsl_matrix *matrix, gsl_permutation *permutation)
{
    const size_t n = matrix->size1, stride = matrix->tda;
    double *A = matrix->data;
    gsl_permutation_init(permutation);
    for (size_t j = 0; j < n; j++) {
        const size_t pivot = find_pivot(A, n, stride, j);
        swap_rows(A, n, stride, j, pivot);
        gsl_permutation_swap(permutation, j, pivot);
        const double *of_j = A + j * stride;
        for (size_t i = j + 1; i < n; i++) {
            double *row = A + i * stride;
            row[j] = fabs(of_j[j]) >= GSL_DBL_MIN ? row[j] * (1 / of_j[j]) : row[j] / of_j[j];
            subtract_row(row, of_j, row[j], j + 1, n);
        }
    }
}
