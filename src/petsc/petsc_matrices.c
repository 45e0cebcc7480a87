/* src/petsc/petsc_matrices.c -- Give the library what it needs of matrices, with PETSc. [H 28] */
#include "petsc_share.h"

#include <fvi/error.h>

/* Return a code to the library after an error of which PETSc has printed the reason. */
#define TRY(call)                                                              \
    do {                                                                       \
        if (call)                                                              \
            return FVI_EBADFUNC;                                               \
    } while (0)

//> product
/* Compute y = A x. Each rank has its rows of A, x and y, and gets the numbers of x that it lacks from other ranks. */
int petsc_product(Mat A, Vec from, const double *x, Vec to, double *y)
{
    TRY(VecPlaceArray(from, x));
    TRY(VecPlaceArray(to, y));
    const PetscErrorCode wrong = MatMult(A, from, to);
    TRY(VecResetArray(from));
    TRY(VecResetArray(to));
    return wrong ? FVI_EBADFUNC : FVI_SUCCESS;
}
//< product

static int select_history(size_t d, const double *x, const double *from,
                          const void *params, double *z)
{
    (void)params;
    for (size_t i = 0; i < d; i++)
        z[i] = x[i] - from[i];
    return FVI_SUCCESS;
}

static int apply_damping(size_t d, double a, const double *z, const void *params,
                         double *p)
{
    const share *s = params;
    const int status = petsc_product(s->C, s->x, z, s->y, s->room);
    for (size_t i = 0; i < d && !status; i++)
        p[i] -= a * s->room[i];
    return status;
}

static int stiffness(size_t d, const double *x, const void *params, double *y)
{
    const share *s = params;
    (void)d;
    return petsc_product(s->K, s->x, x, s->y, y);
}

/* ---- the equation of a step ---- */

typedef struct {
    const share *s;
    KSP gradients;
} factors;

static void free_factors(void *of)
{
    factors *f = of;
    KSPDestroy(&f->gradients);
    free(f);
}

/* Compute A += c C, if C exists. */
static int add_matrix(Mat A, double c, Mat C)
{
    if (c != 0 && C)
        TRY(MatAXPY(A, c, C, DIFFERENT_NONZERO_PATTERN));
    return FVI_SUCCESS;
}

/* Compute *A = m M + sum_j c_j C_j + k K. *A is NULL or must be destroyed by the caller, also after an error. */
static int sum_matrices(const share *s, double m, size_t count, const double *c, const Mat *C, double k,
                        Mat *A)
{
    int status = FVI_SUCCESS;
    TRY(MatDuplicate(s->M, MAT_COPY_VALUES, A));
    TRY(MatScale(*A, m));
    for (size_t j = 0; c && j < count && !status; j++)
        status = add_matrix(*A, c[j], C[j]);
    return status ? status : add_matrix(*A, k, s->K);
}

/* Nothing is factorised: the equation is solved by conjugate gradients with a preconditioner of PETSc. */
static int make_gradients(Mat A, KSP *gradients)
{
    PC jacobi;
    TRY(KSPCreate(PETSC_COMM_WORLD, gradients));
    TRY(KSPSetOperators(*gradients, A, A)); /* it keeps a reference to A */
    TRY(KSPSetType(*gradients, KSPCG));
    TRY(KSPGetPC(*gradients, &jacobi));
    TRY(PCSetType(jacobi, PCJACOBI));
    TRY(KSPSetTolerances(*gradients, 1e-15, 1e-300, PETSC_DEFAULT, 10000));
    TRY(KSPSetFromOptions(*gradients));
    return FVI_SUCCESS;
}

static int make_factors(const share *s, double m, size_t count, const double *c, const Mat *C,
                        double k, void **out)
{
    factors *f = calloc(1, sizeof *f);
    Mat A = NULL;
    if (!f)
        return FVI_ENOMEM;
    f->s = s;
    int status = sum_matrices(s, m, count, c, C, k, &A);
    if (!status)
        status = make_gradients(A, &f->gradients);
    if (MatDestroy(&A) && !status)
        status = FVI_EBADFUNC;
    if (status)
        free_factors(f);
    else
        *out = f;
    return status;
}

static int factorise(size_t d, double m, const double *c, double k, const void *params, void **out)
{
    const share *s = params;
    (void)d;
    return s->mechanism ? make_factors(s, m, s->mechanism->damper_count, c, s->damper_matrices, k, out)
                        : make_factors(s, m, 1, c, &s->C, k, out);
}

static int solve(size_t d, void *of, double *r)
{
    (void)d;
    factors *f = of;
    const share *s = f->s;
    KSPConvergedReason reason;
    TRY(VecPlaceArray(s->x, r));
    const PetscErrorCode wrong = KSPSolve(f->gradients, s->x, s->x);
    TRY(VecResetArray(s->x));
    TRY(wrong);
    TRY(KSPGetConvergedReason(f->gradients, &reason));
    return reason > 0                              ? FVI_SUCCESS
           : reason == KSP_DIVERGED_INDEFINITE_MAT ? FVI_ESING
                                                   : FVI_EMAXITER;
}

fvi_matrices petsc_matrices(const share *s)
{
    return (fvi_matrices){ .damping = { .history_size = s->C ? (size_t)s->rows : 0,
                                        .select_history = select_history,
                                        .apply_damping = apply_damping,
                                        .params = s },
                           .stiffness = stiffness,
                           .factorise = factorise,
                           .solve = solve,
                           .free_factors = free_factors,
                           .params = s,
                           .damper_count = s->mechanism ? s->mechanism->damper_count : 0,
                           .damper = s->damping };
}
