/* src/system/lu.c -- Factors of a small full matrix.                    [H 17] */
#include "lu.h"

#include <gsl/gsl_machine.h>
#include <math.h>

/* The row from j on whose entry in column j is the largest. */
static size_t find_pivot(const gsl_matrix *A, size_t j)
{
    size_t pivot = j;
    double largest = 0;
    for (size_t i = j; i < A->size1; i++) {
        const double size = fabs(gsl_matrix_get(A, i, j));
        if (size > largest) {
            largest = size;
            pivot = i;
        }
    }
    return pivot;
}

void fvi_lu_factorise(gsl_matrix *A, gsl_permutation *permutation)
{
    const size_t n = A->size1;
    gsl_permutation_init(permutation);
    for (size_t j = 0; j < n; j++) {
        const size_t pivot = find_pivot(A, j);
        gsl_matrix_swap_rows(A, j, pivot);
        gsl_permutation_swap(permutation, j, pivot);
        const double of_j = gsl_matrix_get(A, j, j);
        for (size_t i = j + 1; i < n; i++) {
            double *row = gsl_matrix_ptr(A, i, 0);
            row[j] =
                fabs(of_j) >= GSL_DBL_MIN ? row[j] * (1 / of_j) : row[j] / of_j;
            for (size_t l = j + 1; l < n; l++)
                row[l] -= row[j] * gsl_matrix_get(A, j, l);
        }
    }
}
