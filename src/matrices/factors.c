/* src/matrices/factors.c -- Equations with a sparse positive definite matrix.
 *                                                               [H 27] */
#include "factors.h"

#include "system/fail.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { NARROW = 8 }; /* a half bandwidth up to which a band is fastest */

struct fvi_factors {
    fvi_way way;
    fvi_sparse A;   /* by gradients; else empty */
    size_t n, w;    /* half bandwidth */
    double *number; /* of a band: row i is L_{i,i-w}, ..., L_{i,i-1}, 1 / D_i */
    double *work;   /* by gradients: r, z, direction, its image */
    fvi_cholmod *cholmod;
};

fvi_way fvi_way_of(const fvi_sparse *A)
{
    const size_t w = fvi_sparse_half_band(A);
    if (w == 0)
        return FVI_BY_DIAGONAL;
    if (w <= NARROW)
        return FVI_BY_BAND;
    if (fvi_cholmod_is_there())
        return FVI_BY_CHOLMOD;
    const double numbers = (double)A->n * (double)(w + 1);
    return numbers <= 0x1p26 && numbers * (double)w <= 0x1p32
               ? FVI_BY_BAND
               : FVI_BY_GRADIENTS;
}

/* ---- bands ---- */

//> band
/* A = L D L^T, row by row: L_ij D_j is what is left of A_ij. */
static int factorise_band(fvi_factors *f)
{
    const size_t w = f->w, row = w + 1;
    for (size_t i = 0; i < f->n; i++) {
        double *a = f->number + i * row, pivot = a[w];
        const size_t first = i > w ? i - w : 0;
        for (size_t j = first; j < i; j++) {
            const double *b = f->number + j * row;
            double left = a[w + j - i];
            for (size_t l = j > w && j - w > first ? j - w : first; l < j; l++)
                left -= a[w + l - i] * b[w + l - j];
            a[w + j - i] = left; /* times D_j, until the row is done */
        }
        for (size_t j = first; j < i; j++) {
            const double left = a[w + j - i], l = left * f->number[j * row + w];
            pivot -= left * l;
            a[w + j - i] = l;
        }
        if (!(pivot > 0))
            return FVI_ESING;
        a[w] = 1 / pivot;
    }
    return FVI_SUCCESS;
}

static void solve_band(const fvi_factors *f, double *r)
{
    const size_t w = f->w, row = w + 1;
    for (size_t i = 0; i < f->n; i++) {
        const double *a = f->number + i * row;
        for (size_t j = i > w ? i - w : 0; j < i; j++)
            r[i] -= a[w + j - i] * r[j];
    }
    for (size_t i = 0; i < f->n; i++)
        r[i] *= f->number[i * row + w];
    for (size_t i = f->n; i-- > 0;) {
        const double *a = f->number + i * row;
        for (size_t j = i > w ? i - w : 0; j < i; j++)
            r[j] -= a[w + j - i] * r[i];
    }
}
//< band

static int begin_band(fvi_factors *f, const fvi_sparse *A)
{
    f->w = fvi_sparse_half_band(A);
    f->number = calloc(f->n * (f->w + 1), sizeof *f->number);
    if (!f->number)
        return FVI_ENOMEM;
    for (size_t j = 0; j < A->n; j++)
        for (int e = A->start[j]; e < A->start[j + 1]; e++) {
            const size_t i = (size_t)A->row[e];
            if (i >= j)
                f->number[i * (f->w + 1) + f->w + j - i] = A->entry[e];
        }
    return factorise_band(f);
}

/* ---- conjugate gradients ---- */

static double dot(size_t n, const double *a, const double *b)
{
    double sum = 0;
    for (size_t i = 0; i < n; i++)
        sum += a[i] * b[i];
    return sum;
}

static int begin_gradients(fvi_factors *f, fvi_sparse *A)
{
    f->work = malloc(4 * f->n * sizeof *f->work);
    f->number = malloc(f->n * sizeof *f->number);
    if (!f->work || !f->number)
        return FVI_ENOMEM;
    f->A = *A;
    *A = (fvi_sparse){ 0 };
    for (size_t i = 0; i < f->n; i++) {
        const double a = fvi_sparse_entry(&f->A, i, i);
        if (!(a > 0))
            return FVI_ESING;
        f->number[i] = 1 / a;
    }
    return FVI_SUCCESS;
}

//> gradients
/* From x = 0 on, preconditioned by the diagonal, until what is left is the rounding of
 * the right-hand side. Beyond some ten times n products rounding has won before. */
static int solve_gradients(fvi_factors *f, double *x)
{
    const size_t n = f->n;
    double *r = f->work, *z = r + n, *p = z + n, *Ap = p + n;
    memcpy(r, x, n * sizeof *r);
    memset(x, 0, n * sizeof *x);
    memset(p, 0, n * sizeof *p);
    double last = 1, enough = -1;
    for (size_t k = 0; k <= 10 * n + 100; k++) {
        for (size_t i = 0; i < n; i++)
            z[i] = f->number[i] * r[i];
        const double rz = dot(n, r, z);
        if (enough < 0)
            enough = DBL_EPSILON * DBL_EPSILON * rz;
        if (rz <= enough)
            return FVI_SUCCESS;
        for (size_t i = 0; i < n; i++)
            p[i] = z[i] + rz / last * p[i];
        fvi_sparse_multiply(&f->A, p, Ap);
        const double curvature = dot(n, p, Ap);
        if (!(curvature > 0))
            return isfinite(rz) ? FVI_ESING : FVI_EOVRFLW;
        for (size_t i = 0; i < n; i++) {
            x[i] += rz / curvature * p[i];
            r[i] -= rz / curvature * Ap[i];
        }
        last = rz;
    }
    return FVI_EMAXITER;
}
//< gradients

/* ---- all of them ---- */

int fvi_factors_alloc(fvi_way way, fvi_sparse *A, fvi_factors **factors)
{
    fvi_factors *f = calloc(1, sizeof *f);
    int status = f ? FVI_SUCCESS : FVI_ENOMEM;
    if (f) {
        f->way = way;
        f->n = A->n;
        status = f->way == FVI_BY_CHOLMOD ? fvi_cholmod_alloc(A, &f->cholmod)
                 : f->way == FVI_BY_GRADIENTS ? begin_gradients(f, A)
                                              : begin_band(f, A);
    }
    fvi_sparse_free(A);
    if (status)
        fvi_factors_free(f);
    else
        *factors = f;
    return status;
}

int fvi_factors_solve(fvi_factors *f, double *r)
{
    switch (f->way) {
    case FVI_BY_DIAGONAL:
        for (size_t i = 0; i < f->n; i++)
            r[i] *= f->number[i];
        return FVI_SUCCESS;
    case FVI_BY_BAND:
        solve_band(f, r);
        return FVI_SUCCESS;
    case FVI_BY_CHOLMOD:
        return fvi_cholmod_solve(f->cholmod, r);
    case FVI_BY_GRADIENTS:
        break;
    }
    return solve_gradients(f, r);
}

void fvi_factors_free(fvi_factors *f)
{
    if (!f)
        return;
    fvi_cholmod_free(f->cholmod);
    fvi_sparse_free(&f->A);
    free(f->number);
    free(f->work);
    free(f);
}
