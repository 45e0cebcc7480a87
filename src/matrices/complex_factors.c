/* src/matrices/complex_factors.c -- Solve equations with a complex matrix.   [H 30] */
#include "complex_factors.h"

#include <fvi/error.h>

#include <gsl/gsl_math.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <suitesparse/umfpack.h>

struct fvi_complex_factors {
    size_t n;
    const int *start, *row; /* NULL for a dense matrix */
    double complex *LU;     /* dense: the factors, row by row; sparse: the entries */
    size_t *pivot;          /* dense: row j was exchanged with row pivot[j]; sparse: NULL */
    int exchanges;
    void *symbolic, *numeric; /* the objects of UMFPACK, and the workspace that it needs for a solution */
    double *room;
    int *index;
    double control[UMFPACK_CONTROL];
};

static int status_of(int status)
{
    return status == UMFPACK_OK                        ? FVI_SUCCESS
           : status == UMFPACK_ERROR_out_of_memory     ? FVI_ENOMEM
           : status == UMFPACK_WARNING_singular_matrix ? FVI_ESING
                                                       : FVI_EINVAL;
}

/* Find the order of elimination. The pattern is symmetric, so UMFPACK may take pivots from the diagonal. */
static int find_elimination_order(fvi_complex_factors *f)
{
    umfpack_zi_defaults(f->control);
    f->control[UMFPACK_PRL] = 0;
    f->control[UMFPACK_STRATEGY] = UMFPACK_STRATEGY_SYMMETRIC;
    f->control[UMFPACK_IRSTEP] = 0;
    const int n = (int)f->n;
    return status_of(umfpack_zi_symbolic(n, n, f->start, f->row, NULL, NULL,
                                         &f->symbolic, f->control, NULL));
}

int fvi_complex_factors_alloc(size_t n, const int *start, const int *row,
                              fvi_complex_factors **factors)
{
    fvi_complex_factors *f = calloc(1, sizeof *f);
    if (!f)
        return FVI_ENOMEM;
    const size_t entries = start ? (size_t)start[n] : n * n;
    *f = (fvi_complex_factors){ .n = n, .start = start, .row = row };
    f->LU = malloc(entries * sizeof *f->LU);
    f->pivot = start ? NULL : malloc(n * sizeof *f->pivot);
    f->room = start ? malloc(6 * n * sizeof *f->room) : NULL;
    f->index = start ? malloc(n * sizeof *f->index) : NULL;
    int status = f->LU && (start ? f->room && f->index : f->pivot != NULL)
                     ? FVI_SUCCESS
                     : FVI_ENOMEM;
    if (!status && start)
        status = find_elimination_order(f);
    if (status)
        fvi_complex_factors_free(f);
    else
        *factors = f;
    return status;
}

/* ---- dense matrices ---- */

/* Compute a -= factor b, n numbers. The product is written out, because C's complex product tests for NaN. */
static void subtract(size_t n, double complex factor, const double complex *b,
                     double complex *a)
{
    const double re = creal(factor), im = cimag(factor);
    const double *from = (const double *)b;
    double *to = (double *)a;
    for (size_t i = 0; i < 2 * n; i += 2) {
        to[i] -= re * from[i] - im * from[i + 1];
        to[i + 1] -= re * from[i + 1] + im * from[i];
    }
}

static void exchange_rows(fvi_complex_factors *f, size_t j, size_t pivot)
{
    f->pivot[j] = pivot;
    f->exchanges ^= pivot != j;
    for (size_t l = 0; l < f->n && pivot != j; l++) {
        const double complex kept = f->LU[j * f->n + l];
        f->LU[j * f->n + l] = f->LU[pivot * f->n + l];
        f->LU[pivot * f->n + l] = kept;
    }
}

//> elimination
/* Compute P A = L U row by row, with the largest entry of each column as the pivot. */
static int eliminate(fvi_complex_factors *f)
{
    const size_t n = f->n;
    f->exchanges = 0;
    for (size_t j = 0; j < n; j++) {
        size_t pivot = j;
        for (size_t i = j; i < n; i++)
            if (cabs(f->LU[i * n + j]) > cabs(f->LU[pivot * n + j]))
                pivot = i;
        exchange_rows(f, j, pivot);
        const double complex *top = f->LU + j * n;
        if (!(cabs(top[j]) > 0))
            return FVI_ESING;
        for (size_t i = j + 1; i < n; i++) {
            double complex *row = f->LU + i * n;
            row[j] /= top[j];
            subtract(n - j - 1, row[j], top + j + 1, row + j + 1);
        }
    }
    return FVI_SUCCESS;
}
//< elimination

static void substitute(const fvi_complex_factors *f, double complex *x)
{
    const size_t n = f->n;
    for (size_t j = 0; j < n; j++) {
        const double complex kept = x[j];
        x[j] = x[f->pivot[j]];
        x[f->pivot[j]] = kept;
    }
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < i; j++)
            subtract(1, f->LU[i * n + j], x + j, x + i);
    for (size_t i = n; i-- > 0;) {
        for (size_t j = i + 1; j < n; j++)
            subtract(1, f->LU[i * n + j], x + j, x + i);
        x[i] /= f->LU[i * n + i];
    }
}

double fvi_complex_factors_phase(const fvi_complex_factors *f)
{
    double sum = f->exchanges ? M_PI : 0;
    for (size_t j = 0; j < f->n; j++)
        sum += carg(f->LU[j * f->n + j]);
    return sum;
}

/* ---- dense and sparse matrices ---- */

int fvi_complex_factors_of(fvi_complex_factors *f, const double complex *A)
{
    const size_t entries = f->start ? (size_t)f->start[f->n] : f->n * f->n;
    memcpy(f->LU, A, entries * sizeof *A);
    if (!f->start)
        return eliminate(f);
    if (f->numeric)
        umfpack_zi_free_numeric(&f->numeric);
    return status_of(umfpack_zi_numeric(f->start, f->row, (double *)f->LU, NULL,
                                        f->symbolic, &f->numeric, f->control,
                                        NULL));
}

int fvi_complex_factors_solve(const fvi_complex_factors *f, double complex *x)
{
    if (!f->start) {
        substitute(f, x);
        return FVI_SUCCESS;
    }
    double *b = f->room + 4 * f->n;
    memcpy(b, x, 2 * f->n * sizeof *b);
    return status_of(umfpack_zi_wsolve(
        UMFPACK_A, f->start, f->row, (double *)f->LU, NULL, (double *)x, NULL, b,
        NULL, f->numeric, f->control, NULL, f->index, f->room));
}

void fvi_complex_factors_free(fvi_complex_factors *f)
{
    if (!f)
        return;
    if (f->numeric)
        umfpack_zi_free_numeric(&f->numeric);
    if (f->symbolic)
        umfpack_zi_free_symbolic(&f->symbolic);
    free(f->LU);
    free(f->pivot);
    free(f->room);
    free(f->index);
    free(f);
}
