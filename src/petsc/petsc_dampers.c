/* src/petsc/petsc_dampers.c -- Set up several dampers, each with its own matrix. [H 28] */
#include "petsc_share.h"

#include <stdio.h>
#include <string.h>

/* ---- what the library asks of one ---- */

static int select_damped_rows(size_t d, const double *x, const double *from,
                              const void *params, double *z)
{
    const petsc_damper *damper = params;
    (void)d;
    for (PetscInt i = 0; i < damper->count; i++)
        z[i] = x[damper->index[i]] - from[i];
    return FVI_SUCCESS;
}

static int apply_damper_of_rows(size_t d, double a, const double *z, const void *params, double *p)
{
    const petsc_damper *damper = params;
    (void)d;
    const int status =
        petsc_product(damper->damped_rows, damper->z, z, damper->y, damper->product);
    for (PetscInt i = 0; i < damper->count && !status; i++)
        p[damper->index[i]] -= a * damper->product[i];
    return status;
}

/* Unknowns without an entry in the damper's matrix get 0. */
static int find_diagonal(size_t d, const void *params, double *C)
{
    const petsc_damper *damper = params;
    memset(C, 0, d * sizeof *C);
    if (VecPlaceArray(damper->z, damper->product))
        return FVI_EBADFUNC;
    const PetscErrorCode wrong = MatGetDiagonal(damper->damped_rows, damper->z);
    if (VecResetArray(damper->z) || wrong)
        return FVI_EBADFUNC;
    for (PetscInt i = 0; i < damper->count; i++)
        C[damper->index[i]] = damper->product[i];
    return FVI_SUCCESS;
}

/* ---- which rows it has ---- */

//> rows
/* Find the rows of this rank in which C has entries. If there are none, but other ranks have some, take the first
 * row. */
static PetscErrorCode find_rows(const share *s, Mat C, petsc_damper *damper)
{
    PetscInt entries, any = 0, on_all;
    PetscFunctionBeginUser;
    PetscCall(PetscMalloc1(s->rows + 1, &damper->index));
    for (PetscInt i = 0; i < s->rows; i++) {
        PetscCall(MatGetRow(C, s->first + i, &entries, NULL, NULL));
        if (entries > 0)
            damper->index[any++] = i;
        PetscCall(MatRestoreRow(C, s->first + i, &entries, NULL, NULL));
    }
    PetscCallMPI(MPI_Allreduce(&any, &on_all, 1, MPIU_INT, MPI_SUM, PETSC_COMM_WORLD));
    damper->count = any;
    if (any == 0 && on_all > 0 && s->rows > 0)
        damper->index[damper->count++] = 0;
    PetscFunctionReturn(0);
}
//< rows

/* Make `damped_rows`: C itself, or a copy without empty rows and columns. */
static PetscErrorCode find_damped_matrix(const share *s, Mat C, petsc_damper *damper)
{
    PetscInt all;
    IS rows;
    PetscFunctionBeginUser;
    PetscCallMPI(MPI_Allreduce(&damper->count, &all, 1, MPIU_INT, MPI_SUM, PETSC_COMM_WORLD));
    if (all == s->all) {
        PetscCall(PetscObjectReference((PetscObject)C));
        damper->damped_rows = C;
        PetscFunctionReturn(0);
    }
    PetscCall(ISCreateGeneral(PETSC_COMM_WORLD, damper->count, damper->index,
                              PETSC_COPY_VALUES, &rows));
    PetscCall(ISShift(rows, s->first, rows));
    PetscCall(MatCreateSubMatrix(C, rows, rows, MAT_INITIAL_MATRIX,
                                 &damper->damped_rows));
    PetscCall(ISDestroy(&rows));
    PetscFunctionReturn(0);
}

PetscErrorCode petsc_set_damper(share *s, PetscInt j, Mat C)
{
    petsc_damper *damper = s->damper + j;
    PetscFunctionBeginUser;
    PetscCall(PetscObjectReference((PetscObject)C));
    s->damper_matrices[j] = C;
    PetscCall(find_rows(s, C, damper));
    PetscCall(find_damped_matrix(s, C, damper));
    PetscCall(PetscMalloc1(damper->count + 1, &damper->product));
    PetscCall(MatCreateVecs(damper->damped_rows, &damper->z, &damper->y));
    s->damping[j] = (fvi_damping_matrix){ .history_size = (size_t)damper->count,
                                          .select_history = select_damped_rows,
                                          .apply_damping = apply_damper_of_rows,
                                          .params = damper,
                                          .diagonal = find_diagonal };
    PetscFunctionReturn(0);
}

/* ---- all of them ---- */

PetscErrorCode petsc_add_dampers(const fvi_mechanism *mechanism, share *s)
{
    PetscFunctionBeginUser;
    s->mechanism = mechanism;
    PetscCall(PetscCalloc1(mechanism->damper_count, &s->damper_matrices));
    PetscCall(PetscCalloc1(mechanism->damper_count, &s->damper));
    PetscCall(PetscCalloc1(mechanism->damper_count, &s->damping));
    PetscFunctionReturn(0);
}

PetscErrorCode petsc_free_dampers(share *s)
{
    PetscFunctionBeginUser;
    for (size_t j = 0; s->damper && j < s->mechanism->damper_count; j++) {
        PetscCall(VecDestroy(&s->damper[j].z));
        PetscCall(VecDestroy(&s->damper[j].y));
        PetscCall(MatDestroy(&s->damper[j].damped_rows));
        PetscCall(MatDestroy(s->damper_matrices + j));
        PetscCall(PetscFree(s->damper[j].index));
        PetscCall(PetscFree(s->damper[j].product));
        if (s->typed)
            fvi_typed_damper_free(s->typed + j);
    }
    PetscCall(PetscFree(s->damper_matrices));
    PetscCall(PetscFree(s->damper));
    PetscCall(PetscFree(s->damping));
    PetscCall(PetscFree(s->typed));
    PetscCall(PetscFree(s->kernel));
    PetscFunctionReturn(0);
}

/* ---- what is refused ---- */

/* Return nonzero if the field of an error is the name of an option. */
static int is_option(const char *field)
{
    static const char *const names[] = { "system", "alpha", "h", "steps", "x0", "p0" };
    for (size_t i = 0; field && i < sizeof names / sizeof *names; i++)
        if (strcmp(field, names[i]) == 0)
            return 1;
    return 0;
}

PetscErrorCode petsc_refuse(const fvi_error *error)
{
    char option[40] = "", number[40];
    const char *text = error->text;
    PetscFunctionBeginUser;
    if (is_option(error->field))
        snprintf(option, sizeof option, "-%s: ", error->field);
    if (error->field && strcmp(error->field, "damper") == 0)
        snprintf(option, sizeof option, "-damper_%zu: ", error->index + 1);
    snprintf(number, sizeof number, "damper %zu: ", error->index + 1);
    if (strncmp(text, number, strlen(number)) == 0) /* the option contains the number */
        text += strlen(number);
    SETERRQ(PETSC_COMM_SELF, PETSC_ERR_USER, "%s%s", option,
            *text ? text : fvi_error_name(error->code));
}
