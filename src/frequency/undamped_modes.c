/* src/frequency/undamped_modes.c -- Find the lowest modes of K v = lambda M v.        [H 30] */
#include "undamped_modes.h"
#include "system/seeded.h"

#include "matrices/factors.h"
#include "matrices/sparse.h"
#include "system/arrays.h"
#include "system/fail.h"

#include <gsl/gsl_blas.h>
#include <gsl/gsl_eigen.h>
#include <gsl/gsl_linalg.h>
#include <gsl/gsl_matrix.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- full matrices ---- */

/* Compute all modes of full symmetric matrices, which are overwritten, from those of L^-1 K L^-T with M = L L^T. Row i
 * of V becomes mode i. `room` has 5 n numbers. */
static int full_modes(size_t n, double *K, double *M, double *lambda, double *V,
                      double *room)
{
    gsl_matrix_view A = gsl_matrix_view_array(K, n, n), L = gsl_matrix_view_array(M, n, n),
                    vectors = gsl_matrix_view_array(V, n, n);
    gsl_vector_view values = gsl_vector_view_array(lambda, n);
    gsl_eigen_symmv_workspace work = { .size = n, /* fail.h says why the workspace is not allocated by GSL */
                                       .d = room,
                                       .sd = room + n,
                                       .gc = room + 2 * n,
                                       .gs = room + 3 * n };
    fvi_quiet();
    int status = gsl_linalg_cholesky_decomp1(&L.matrix) ? FVI_ESING : FVI_SUCCESS;
    if (!status) {
        gsl_eigen_gensymm_standardize(&A.matrix, &L.matrix);
        status = gsl_eigen_symmv(&A.matrix, &values.vector, &vectors.matrix, &work) ? FVI_EMAXITER : FVI_SUCCESS;
    }
    if (!status) {
        gsl_eigen_symmv_sort(&values.vector, &vectors.matrix, GSL_EIGEN_SORT_VAL_ASC);
        gsl_blas_dtrsm(CblasLeft, CblasLower, CblasTrans, CblasNonUnit, 1, &L.matrix, &vectors.matrix);
        gsl_matrix_transpose(&vectors.matrix);
    }
    fvi_loud();
    return status;
}

static void expand_matrix(const fvi_sparse *A, double *full)
{
    memset(full, 0, A->n * A->n * sizeof *full);
    for (size_t j = 0; j < A->n; j++)
        for (int e = A->start[j]; e < A->start[j + 1]; e++)
            full[j * A->n + (size_t)A->row[e]] = A->entry[e];
}

static int all_modes(const fvi_sparse *M, const fvi_sparse *K, size_t count,
                     double *lambda, double *v)
{
    const size_t n = M->n;
    double *room = malloc((3 * n + 6) * n * sizeof *room);
    if (!room)
        return FVI_ENOMEM;
    double *of_K = room, *of_M = of_K + n * n, *V = of_M + n * n,
           *values = V + n * n;
    expand_matrix(K, of_K);
    expand_matrix(M, of_M);
    const int status = full_modes(n, of_K, of_M, values, V, values + n);
    if (!status) {
        memcpy(lambda, values, count * sizeof *lambda);
        memcpy(v, V, count * n * sizeof *v);
    }
    free(room);
    return status;
}

/* ---- subspaces ---- */

enum { PIECE = 256 };

/* A subspace of q vectors that converges to the lowest modes. */
typedef struct {
    const fvi_sparse *M, *K;
    size_t n, q;
    fvi_factors *factors; /* factors of K + shift M */
    double shift;
    double *X, *Y, *MX;   /* X and Y have q vectors each, MX has one */
    double *of_K, *of_M, *V, *values, *room;
} subspace;

/* Find the factors of K or, if it is not positive definite, of K plus a small multiple of M. */
static int shift_stiffness(subspace *s)
{
    const fvi_sparse *const terms[] = { s->K, s->M };
    double of_K = 0, of_M = 0;
    for (size_t i = 0; i < s->n; i++) {
        of_K += fabs(fvi_sparse_entry(s->K, i, i));
        of_M += fvi_sparse_entry(s->M, i, i);
    }
    int status = FVI_ESING;
    for (int i = 0; status == FVI_ESING && i < 8; i++) {
        s->shift = i > 0 ? 1e-10 * pow(100, i - 1) * of_K / of_M : 0;
        const double a[] = { 1, s->shift };
        fvi_sparse A;
        status = fvi_sparse_add(2, terms, a, &A);
        if (!status)
            status = fvi_factors_alloc(fvi_choose_factorisation(&A), &A, &s->factors);
    }
    return status;
}

/* Fill x with pseudo-random numbers between -1/2 and 1/2, so that no mode is orthogonal to the start. */
static void fill_random(size_t count, double *x)
{
    uint64_t state = 1;
    for (size_t i = 0; i < count; i++)
        x[i] = fvi_seeded_uniform(&state, 0, 1) - 0.5;
}

/* Eight independent sums are computed side by side, so that no addition waits for the one before. */
static double dot_product(size_t n, const double *x, const double *y)
{
    enum { SIDE = 8 };
    double part[SIDE] = { 0 }, sum = 0;
    size_t i = 0;
    for (; i + SIDE <= n; i += SIDE)
        for (size_t k = 0; k < SIDE; k++)
            part[k] += x[i + k] * y[i + k];
    for (; i < n; i++)
        sum += x[i] * y[i];
    for (size_t k = 0; k < SIDE; k++)
        sum += part[k];
    return sum;
}

/* Compute the Gram matrices of K and M for the vectors Y, and write the Ritz vectors of Y to X. */
static int ritz(subspace *s)
{
    const size_t n = s->n, q = s->q;
    for (int of_mass = 0; of_mass < 2; of_mass++)
        for (size_t j = 0; j < q; j++) {
            double *image = s->MX;
            fvi_sparse_multiply(of_mass ? s->M : s->K, s->Y + j * n, image);
            for (size_t i = 0; i <= j; i++) {
                double *gram = of_mass ? s->of_M : s->of_K;
                gram[i * q + j] = gram[j * q + i] = dot_product(n, s->Y + i * n, image);
            }
        }
    const int status =
        full_modes(q, s->of_K, s->of_M, s->values, s->V, s->room);
    memset(s->X, 0, q * n * sizeof *s->X);
    for (size_t from = 0; !status && from < n; from += PIECE) /* in pieces that stay in the cache */
        for (size_t j = 0; j < q; j++)
            for (size_t i = 0; i < q; i++)
                for (size_t l = from; l < n && l < from + PIECE; l++)
                    s->X[j * n + l] += s->V[j * q + i] * s->Y[i * n + l];
    return status;
}

//> subspace
/* Iterate Y = (K + shift M)^-1 M X, and take the modes of K and M within Y, until the wanted ones do not change. */
static int iterate(subspace *s, size_t wanted)
{
    enum { MOST_ITERATIONS = 200 };
    double *before = s->room + 5 * s->q;
    fill_random(s->q * s->n, s->X);
    for (int i = 0; i < MOST_ITERATIONS; i++) {
        for (size_t j = 0; j < s->q; j++) {
            fvi_sparse_multiply(s->M, s->X + j * s->n, s->Y + j * s->n);
            if (fvi_factors_solve(s->factors, s->Y + j * s->n))
                return FVI_ENOMEM;
        }
        memcpy(before, s->values, s->q * sizeof *before);
        int status = fvi_interrupted();
        if (!status)
            status = ritz(s);
        if (status)
            return status;
        size_t settled = 0;
        while (settled < wanted
               && fabs(s->values[settled] - before[settled])
                      <= 1e-9 * fabs(s->values[settled] + s->shift))
            settled++;
        if (i > 0 && settled == wanted)
            return FVI_SUCCESS;
    }
    return FVI_EMAXITER;
}
//< subspace

static int lowest_modes(const fvi_sparse *M, const fvi_sparse *K, size_t count,
                        double *lambda, double *v)
{
    const size_t n = M->n, q = count + (count > 8 ? count : 8);
    subspace s = { .M = M, .K = K, .n = n, .q = q };
    double *room = FVI_ARRAYS({ &s.X, q * n }, { &s.Y, q * n }, { &s.MX, n }, { &s.of_K, q * q }, { &s.of_M, q * q },
                              { &s.V, q * q }, { &s.values, q }, { &s.room, 7 * q });
    if (!room)
        return FVI_ENOMEM;
    int status = shift_stiffness(&s);
    if (!status)
        status = iterate(&s, count);
    if (!status) {
        memcpy(lambda, s.values, count * sizeof *lambda);
        memcpy(v, s.X, count * n * sizeof *v);
    }
    fvi_factors_free(s.factors);
    free(room);
    return status == FVI_ESING ? FVI_EMAXITER : status;
}

int fvi_undamped_modes(const fvi_sparse *M, const fvi_sparse *K, size_t count,
                       double *lambda, double *v)
{
    return M->n <= FVI_FULL_MODES || 4 * count > M->n
               ? all_modes(M, K, count, lambda, v)
               : lowest_modes(M, K, count, lambda, v);
}
