/* tests/program/petsc_failures.c -- Where PETSc fails, is what was made given back?  (make petsc)
 *
 * A word that PETSc does not know makes the factors of a step fail after the matrix and the solver have
 * been made. Run with -malloc_debug, so that PETSc counts its bytes. PETSc 3.18 itself loses the 32 bytes
 * of a text there; a matrix that is lost has more than 2000. */
#include "petsc/petsc_share.h"

#include <fvi/error.h>

#include <stdio.h>

/* Makes the factors of M + C_1 + C_2 + K, and gives them back if there are any. */
static int make_once(const fvi_matrices *m, const share *s)
{
    const double c[] = { 1, 1 };
    void *factors;
    const int status = m->factorise((size_t)s->rows, 1, c, 1, m->params, &factors);
    if (!status)
        m->free_factors(factors);
    return status;
}

/* The code of factors that fail, and by how many bytes PETSc has grown. */
static PetscErrorCode fail(const fvi_matrices *m, const share *s, int *status, double *bytes)
{
    PetscLogDouble before, after;
    PetscFunctionBeginUser;
    PetscCall(PetscOptionsSetValue(NULL, "-ksp_type", "nonsense"));
    PetscCall(PetscMallocGetCurrentUsage(&before));
    PetscCall(PetscPushErrorHandler(PetscReturnErrorHandler, NULL));
    *status = make_once(m, s);
    PetscCall(PetscPopErrorHandler());
    PetscCall(PetscMallocGetCurrentUsage(&after));
    PetscCall(PetscOptionsClearValue(NULL, "-ksp_type"));
    *bytes = after - before;
    PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
    static const char *const dampers[] = { "K : viscous:1", "M : power:1,0.3" };
    const PetscInt n[3] = { 5, 1, 1 };
    share s = { 0 };
    int first, status;
    double bytes;
    PetscFunctionBeginUser;
    PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
    PetscCall(petsc_of_grid(1, n, 0, 2, dampers, &s));
    const fvi_matrices m = petsc_matrices(&s);
    first = make_once(&m, &s); /* and what PETSc keeps for all solvers */
    PetscCall(fail(&m, &s, &status, &bytes));
    PetscCall(fail(&m, &s, &status, &bytes)); /* the lists of words have been made */
    printf("petsc: factors: %s, then %s, and %g bytes are left\n", fvi_error_name(first),
           fvi_error_name(status), bytes);
    const int is_right = !first && status == FVI_EBADFUNC && bytes < 1000;
    PetscCall(petsc_free_share(&s));
    PetscCall(PetscFinalize());
    return is_right ? 0 : 1;
}
