/* src/petsc/petsc_matrices.c -- What the library asks of matrices, by PETSc. [H 28] */
#include "petsc_share.h"

#include <fvi/error.h>

/* Where the library wants a code; PETSc has said what is wrong. */
#define TRY(call)                                                              \
    do {                                                                       \
        if (call)                                                              \
            return FVI_EBADFUNC;                                               \
    } while (0)

//> product
/* y = A x: each rank has its rows of all three, and gets from others what it lacks of x. */
static int product(const share *s, Mat A, const double *x, double *y)
{
    TRY(VecPlaceArray(s->x, x));
    TRY(VecPlaceArray(s->y, y));
    TRY(MatMult(A, s->x, s->y));
    TRY(VecResetArray(s->x));
    TRY(VecResetArray(s->y));
    return FVI_SUCCESS;
}
//< product

static int remember(size_t d, const double *x, const double *from,
                    const void *params, double *z)
{
    (void)params;
    for (size_t i = 0; i < d; i++)
        z[i] = x[i] - from[i];
    return FVI_SUCCESS;
}

static int damp(size_t d, double a, const double *z, const void *params,
                double *p)
{
    const share *s = params;
    const int status = product(s, s->C, z, s->room);
    for (size_t i = 0; i < d && !status; i++)
        p[i] -= a * s->room[i];
    return status;
}

static int stiffness(size_t d, const double *x, const void *params, double *y)
{
    (void)d;
    return product(params, ((const share *)params)->K, x, y);
}

typedef struct {
    share *s;
    KSP gradients;
} factors;

/* Nothing is factorised: m M + c C + k K, and a preconditioner of PETSc's. */
static int factorise(size_t d, double m, double c, double k, const void *params,
                     void **out)
{
    (void)d;
    share *s = (share *)params;
    factors *f = malloc(sizeof *f);
    Mat A;
    if (!f)
        return FVI_ENOMEM;
    *out = f;
    f->s = s;
    TRY(MatDuplicate(s->M, MAT_COPY_VALUES, &A));
    TRY(MatScale(A, m));
    if (c != 0)
        TRY(MatAXPY(A, c, s->C, DIFFERENT_NONZERO_PATTERN));
    if (k != 0)
        TRY(MatAXPY(A, k, s->K, DIFFERENT_NONZERO_PATTERN));
    TRY(KSPCreate(PETSC_COMM_WORLD, &f->gradients));
    TRY(KSPSetOperators(f->gradients, A, A));
    TRY(MatDestroy(&A)); /* the solver keeps it */
    PC jacobi;
    TRY(KSPSetType(f->gradients, KSPCG));
    TRY(KSPGetPC(f->gradients, &jacobi));
    TRY(PCSetType(jacobi, PCJACOBI));
    TRY(KSPSetTolerances(f->gradients, 1e-15, 1e-300, PETSC_DEFAULT, 10000));
    TRY(KSPSetFromOptions(f->gradients));
    return FVI_SUCCESS;
}

static int solve(size_t d, void *of, double *r)
{
    (void)d;
    factors *f = of;
    share *s = f->s;
    KSPConvergedReason reason;
    TRY(VecPlaceArray(s->x, r));
    TRY(KSPSolve(f->gradients, s->x, s->x));
    TRY(VecResetArray(s->x));
    TRY(KSPGetConvergedReason(f->gradients, &reason));
    return reason > 0                              ? FVI_SUCCESS
           : reason == KSP_DIVERGED_INDEFINITE_MAT ? FVI_ESING
                                                   : FVI_EMAXITER;
}

static void forget(void *of)
{
    factors *f = of;
    KSPDestroy(&f->gradients);
    free(f);
}

fvi_matrices petsc_matrices(const share *s)
{
    return (fvi_matrices){ .remembered = s->C ? (size_t)s->rows : 0,
                           .remember = remember,
                           .damp = damp,
                           .stiffness = stiffness,
                           .factorise = factorise,
                           .solve = solve,
                           .forget = forget,
                           .params = s };
}
