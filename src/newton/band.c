/* src/newton/band.c -- Solve linear equations with a band matrix.             [H 2] */
#include "band.h"

#include "system/fail.h"
#include "system/larger.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

int fvi_band_alloc(size_t n, size_t w, fvi_band *J)
{
    const int full = 3 * w + 1 >= n;
    const size_t row = full ? n : 3 * w + 1;
    *J = (fvi_band){ .n = n, .w = smaller_count(w, n - 1) };
    if (n > SIZE_MAX / sizeof(double) / row)
        return FVI_ENOMEM;
    J->stride = full ? n : 3 * w;
    J->size = n * row;
    J->block = calloc(J->size, sizeof *J->block);
    J->pivot = calloc(n, sizeof *J->pivot);
    if (!J->block || !J->pivot) {
        fvi_band_free(J);
        return FVI_ENOMEM;
    }
    J->entry = J->block + (full ? 0 : w);
    return FVI_SUCCESS;
}

void fvi_band_copy(const fvi_band *from, fvi_band *to)
{
    memcpy(to->block, from->block, from->size * sizeof *to->block);
    memcpy(to->pivot, from->pivot, from->n * sizeof *to->pivot);
}

void fvi_band_free(fvi_band *J)
{
    free(J->block);
    free(J->pivot);
    *J = (fvi_band){ 0 };
}

void fvi_band_clear(fvi_band *J)
{
    memset(J->block, 0, J->size * sizeof *J->block);
}

/* Return the row that has the largest entry of column k, among the rows from k to below - 1. */
static size_t pivot_row(const fvi_band *J, size_t k, size_t below)
{
    size_t best = k;
    for (size_t i = k + 1; i < below; i++)
        if (fabs(fvi_band_row(J, i)[k]) > fabs(fvi_band_row(J, best)[k]))
            best = i;
    return best;
}

//> factorise
int fvi_band_factorise(fvi_band *J)
{
    if (J->w == 0) { /* a diagonal matrix is its own factor */
        for (size_t k = 0; k < J->n; k++)
            if (fvi_band_row(J, k)[k] == 0)
                return FVI_ESING;
        return FVI_SUCCESS;
    }
    size_t right = 0; /* first column behind the nonzero entries of the rows up to k */
    for (size_t k = 0; k < J->n; k++) {
        const size_t below = smaller_count(J->n, k + J->w + 1);
        const size_t p = J->pivot[k] = pivot_row(J, k, below);
        double *top = fvi_band_row(J, k), *other = fvi_band_row(J, p);
        right = larger_count(right, smaller_count(J->n, p + J->w + 1));
        if (other[k] == 0)
            return FVI_ESING;
        for (size_t j = k; p != k && j < right; j++) {
            double swap = top[j];
            top[j] = other[j];
            other[j] = swap;
        }
        for (size_t i = k + 1; i < below; i++) {
            double *row = fvi_band_row(J, i), l = row[k] /= top[k];
#pragma omp simd
            for (size_t j = k + 1; j < right; j++)
                row[j] -= l * top[j];
        }
    }
    return FVI_SUCCESS;
}
//< factorise

void fvi_band_solve(const fvi_band *J, double *v)
{
    const size_t n = J->n, w = J->w;
    if (w == 0) { /* a diagonal matrix */
        for (size_t k = 0; k < n; k++)
            v[k] /= fvi_band_row(J, k)[k];
        return;
    }
    for (size_t k = 0; k < n; k++) {
        const size_t below = smaller_count(n, k + w + 1), p = J->pivot[k];
        double top = v[p];
        v[p] = v[k];
        v[k] = top;
        for (size_t i = k + 1; i < below; i++)
            v[i] -= fvi_band_row(J, i)[k] * top;
    }
    for (size_t k = n; k-- > 0;) {
        const size_t right = smaller_count(n, k + 2 * w + 1);
        const double *row = fvi_band_row(J, k);
        double sum = v[k];
        for (size_t j = k + 1; j < right; j++)
            sum -= row[j] * v[j];
        v[k] = sum / row[k];
    }
}
