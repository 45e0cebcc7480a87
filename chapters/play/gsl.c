/* chapters/play/gsl.c -- GSL, as far as one dimension needs it.
 *
 * The modules of src/ are compiled for the page with GSL's own headers; what they
 * call is here. In one dimension a linear solver divides and an eigenvalue is the
 * number itself, so what needs d > 1 says that it is not here. */
#include "memory_kinds.h"

#include <gsl/gsl_eigen.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_linalg.h>
#include <gsl/gsl_math.h>

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

/* ---- matrices of one number: only stability.c, for its eigenvalue ---- */

static gsl_vector only; /* the one vector that there is at a time */
static double number;
static gsl_eigen_symm_workspace nothing;

gsl_matrix_view gsl_matrix_view_array(double *base, size_t rows, size_t columns)
{
    return (gsl_matrix_view){ { rows, columns, columns, base, NULL, 0 } };
}

gsl_vector *gsl_vector_alloc(size_t n)
{
    only = (gsl_vector){ n, 1, &number, NULL, 0 };
    return n == 1 ? &only : NULL;
}

void gsl_vector_free(gsl_vector *v)
{
    (void)v;
}

double gsl_vector_max(const gsl_vector *v)
{
    return v->data[0];
}

gsl_eigen_symm_workspace *gsl_eigen_symm_alloc(size_t n)
{
    return n == 1 ? &nothing : NULL;
}

int gsl_eigen_symm(gsl_matrix *A, gsl_vector *values,
                   gsl_eigen_symm_workspace *work)
{
    (void)work;
    values->data[0] = A->data[0];
    return GSL_SUCCESS;
}

void gsl_eigen_symm_free(gsl_eigen_symm_workspace *work)
{
    (void)work;
}

/* ---- newton.c asks for these where d > 1 only ---- */

gsl_permutation *gsl_permutation_alloc(size_t n)
{
    (void)n;
    return NULL; /* fvi_newton_alloc then returns GSL_ENOMEM */
}

void gsl_permutation_free(gsl_permutation *p)
{
    (void)p;
}

gsl_vector_view gsl_vector_view_array(double *base, size_t n)
{
    return (gsl_vector_view){ { n, 1, base, NULL, 0 } };
}

int gsl_linalg_LU_decomp(gsl_matrix *A, gsl_permutation *p, int *sign)
{
    (void)A, (void)p, (void)sign;
    return GSL_EUNIMPL;
}

int gsl_linalg_LU_svx(const gsl_matrix *LU, const gsl_permutation *p,
                      gsl_vector *x)
{
    (void)LU, (void)p, (void)x;
    return GSL_EUNIMPL;
}

/* ---- the memory: the page sums directly, the fast ways stay outside ---- */

size_t fvi_blocks_bytes(size_t d, size_t steps)
{
    (void)d, (void)steps;
    return SIZE_MAX;
}

fvi_blocks *fvi_blocks_alloc(double nu, size_t d, size_t steps)
{
    (void)nu, (void)d, (void)steps;
    return NULL; /* fvi_memory_alloc then returns GSL_ENOMEM */
}

void fvi_blocks_push(fvi_blocks *b, const double *term, double *H)
{
    (void)b, (void)term, (void)H;
}

void fvi_blocks_free(fvi_blocks *b)
{
    (void)b;
}

double fvi_exponentials_delta(size_t steps, double tolerance)
{
    (void)steps, (void)tolerance;
    return 0;
}

size_t fvi_exponentials_bytes(double nu, size_t d, size_t steps, double delta)
{
    (void)nu, (void)d, (void)steps, (void)delta;
    return SIZE_MAX;
}

fvi_exponentials *fvi_exponentials_alloc(double nu, size_t d, size_t steps,
                                         double delta)
{
    (void)nu, (void)d, (void)steps, (void)delta;
    return NULL;
}

void fvi_exponentials_push(fvi_exponentials *e, const double *term, double *H)
{
    (void)e, (void)term, (void)H;
}

void fvi_exponentials_free(fvi_exponentials *e)
{
    (void)e;
}
