/* src/matrices/factors.c -- Solve equations with a sparse positive definite matrix.    [H 27] */
#include "factors.h"


#include <stdlib.h>

enum { NARROW = 8 }; /* largest half bandwidth for which a band is the fastest solver */

struct fvi_factors {
    fvi_factorisation factorisation;
    size_t n, w;    /* w: half bandwidth */
    double *number; /* the band: row i is L_{i,i-w}, ..., L_{i,i-1}, 1 / D_i */
    fvi_cholmod *cholmod;
};

fvi_factorisation fvi_choose_factorisation_of_band(size_t w)
{
    return w == 0 ? FVI_BY_DIAGONAL : w <= NARROW ? FVI_BY_BAND : FVI_BY_CHOLMOD;
}

fvi_factorisation fvi_choose_factorisation(const fvi_sparse *A)
{
    return fvi_choose_factorisation_of_band(fvi_sparse_half_band(A));
}

/* ---- bands ---- */

#define NUMBER double

static inline void subtract_product(double *to, const double *a, const double *b)
{
    *to -= *a * *b;
}

static inline void multiply(double *to, const double *a, const double *b)
{
    *to = *a * *b;
}

static inline void invert(double *to, const double *a)
{
    *to = 1 / *a;
}

static inline int is_positive(const double *a)
{
    return *a > 0;
}

#include "band_elimination.h"

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
    return factorise_band(f->n, f->w, f->number);
}

/* ---- all solvers ---- */

int fvi_factors_alloc(fvi_factorisation factorisation, fvi_sparse *A, fvi_factors **factors)
{
    fvi_factors *f = calloc(1, sizeof *f);
    int status = f ? FVI_SUCCESS : FVI_ENOMEM;
    if (f) {
        f->factorisation = factorisation;
        f->n = A->n;
        status = factorisation == FVI_BY_CHOLMOD ? fvi_cholmod_alloc(A, &f->cholmod)
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
    switch (f->factorisation) {
    case FVI_BY_DIAGONAL:
        for (size_t i = 0; i < f->n; i++)
            r[i] *= f->number[i];
        return FVI_SUCCESS;
    case FVI_BY_BAND:
        solve_band(f->n, f->w, f->number, r);
        return FVI_SUCCESS;
    case FVI_BY_CHOLMOD:
        break;
    }
    return fvi_cholmod_solve(f->cholmod, r);
}

void fvi_factors_free(fvi_factors *f)
{
    if (!f)
        return;
    fvi_cholmod_free(f->cholmod);
    free(f->number);
    free(f);
}
