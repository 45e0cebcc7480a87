/* src/matrices/cholesky.c -- Factorise a full positive definite matrix.    [H 30] */
#include "cholesky.h"

#include <fvi/error.h>

#include <math.h>

int fvi_cholesky(size_t n, double *A)
{
    for (size_t j = 0; j < n; j++)
        for (size_t i = j; i < n; i++) {
            double left = A[i * n + j];
            for (size_t l = 0; l < j; l++)
                left -= A[i * n + l] * A[j * n + l];
            if (i == j && !(left > 0))
                return FVI_ESING;
            A[i * n + j] = i == j ? sqrt(left) : left / A[j * n + j];
        }
    return FVI_SUCCESS;
}
