/* chapters/play/gsl.c -- GSL, as far as one dimension needs it.
 *
 * The modules of src/ are compiled for the page with GSL's own headers; what they
 * call is here. In one dimension an eigenvalue is the number itself, and linear
 * equations come from the stages of H 17 only: at most four. What neither this nor
 * wasm.py's modules have is listed there as absent: no page reaches it. */
#include "memory/history_kinds.h"

#include <fvi/error.h>
#include <gsl/gsl_eigen.h>
#include <gsl/gsl_linalg.h>
#include <gsl/gsl_math.h>
#include <stdlib.h>

/* The page looks at what is returned. */
void gsl_error(const char *reason, const char *file, int line, int code)
{
    (void)reason, (void)file, (void)line, (void)code;
}

int gsl_finite(const double x)
{
    return isfinite(x);
}

double gsl_pow_2(const double x)
{
    return x * x;
}

/* ---- views ---- */

gsl_matrix_view gsl_matrix_view_array_with_tda(double *base, size_t rows,
                                               size_t columns, size_t tda)
{
    return (gsl_matrix_view){ { rows, columns, tda, base, NULL, 0 } };
}

gsl_matrix_view gsl_matrix_view_array(double *base, size_t rows, size_t columns)
{
    return gsl_matrix_view_array_with_tda(base, rows, columns, columns);
}

gsl_vector_view gsl_vector_view_array(double *base, size_t n)
{
    return (gsl_vector_view){ { n, 1, base, NULL, 0 } };
}

/* ---- matrices of one number: only stability.c, for its eigenvalue ---- */

double gsl_vector_max(const gsl_vector *v)
{
    return v->data[0];
}

int gsl_eigen_symm(gsl_matrix *A, gsl_vector *values,
                   gsl_eigen_symm_workspace *work)
{
    (void)work;
    values->data[0] = A->data[0];
    return FVI_SUCCESS;
}

/* ---- what lu.c asks for, and what is done with its factors ----
 *
 * Each sum is taken in the order in which GSL 2.7 and its BLAS take it: the digits
 * are theirs. The callers look for zero pivots themselves. */

enum { MOST = 4 };

gsl_permutation *gsl_permutation_alloc(size_t n)
{
    gsl_permutation *p = malloc(sizeof *p + MOST * sizeof *p->data);
    if (p && n <= MOST)
        *p = (gsl_permutation){ n, (size_t *)(p + 1) };
    return p && n <= MOST ? p : NULL;
}

void gsl_permutation_free(gsl_permutation *p)
{
    free(p);
}

void gsl_permutation_init(gsl_permutation *p)
{
    for (size_t i = 0; i < p->size; i++)
        p->data[i] = i;
}

int gsl_permutation_swap(gsl_permutation *p, size_t i, size_t j)
{
    const size_t old = p->data[i];
    p->data[i] = p->data[j];
    p->data[j] = old;
    return FVI_SUCCESS;
}

int gsl_matrix_swap_rows(gsl_matrix *A, size_t i, size_t j)
{
    for (size_t k = 0; i != j && k < A->size2; k++) {
        const double old = A->data[i * A->tda + k];
        A->data[i * A->tda + k] = A->data[j * A->tda + k];
        A->data[j * A->tda + k] = old;
    }
    return FVI_SUCCESS;
}

double gsl_matrix_get(const gsl_matrix *A, size_t i, size_t j)
{
    return A->data[i * A->tda + j];
}

double *gsl_matrix_ptr(gsl_matrix *A, size_t i, size_t j)
{
    return A->data + i * A->tda + j;
}

int gsl_linalg_LU_svx(const gsl_matrix *LU, const gsl_permutation *p,
                      gsl_vector *x)
{
    const size_t n = LU->size1;
    double y[MOST] = { 0 };
    for (size_t i = 0; i < n; i++) {
        y[i] = x->data[p->data[i]];
        for (size_t j = 0; j < i; j++)
            y[i] -= LU->data[i * LU->tda + j] * y[j];
    }
    for (size_t i = n; i-- > 0;) {
        for (size_t j = i + 1; j < n; j++)
            y[i] -= LU->data[i * LU->tda + j] * y[j];
        y[i] /= LU->data[i * LU->tda + i];
        x->data[i] = y[i];
    }
    return FVI_SUCCESS;
}

/* V becomes the inverse of U, and below its diagonal that of L, in place: the
 * columns of U from the first on, those of L from the last on. */
static void invert_triangles(size_t n, double V[MOST][MOST])
{
    for (size_t j = 0; j < n; j++) {
        V[j][j] = 1 / V[j][j];
        for (size_t i = 0; i < j; i++) {
            double sum = 0;
            for (size_t k = i + 1; k < j; k++)
                sum += V[k][j] * V[i][k];
            V[i][j] = (sum + V[i][j] * V[i][i]) * -V[j][j];
        }
    }
    for (size_t j = n; j-- > 0;)
        for (size_t i = n; i-- > j + 1;) {
            double sum = 0;
            for (size_t k = j + 1; k < i; k++)
                sum += V[k][j] * V[i][k];
            V[i][j] = -(V[i][j] + sum);
        }
}

/* U^(-1) L^(-1), its columns in the order that P says. */
int gsl_linalg_LU_invert(const gsl_matrix *LU, const gsl_permutation *p,
                         gsl_matrix *inverse)
{
    const size_t n = LU->size1;
    double V[MOST][MOST];
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < n; j++)
            V[i][j] = LU->data[i * LU->tda + j];
    invert_triangles(n, V);
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < n; j++) {
            double sum = 0; /* L has ones on its diagonal */
            for (size_t k = GSL_MAX(i, j + 1); k < n; k++)
                sum += V[i][k] * V[k][j];
            inverse->data[i * inverse->tda + p->data[j]] =
                i <= j ? V[i][j] + sum : sum;
        }
    return FVI_SUCCESS;
}

/* ---- nobody is told of an error ---- */

gsl_error_handler_t *gsl_set_error_handler_off(void)
{
    return NULL;
}

gsl_error_handler_t *gsl_set_error_handler(gsl_error_handler_t *handler)
{
    return handler;
}
