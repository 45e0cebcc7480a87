/* src/petsc/petsc_systems.c -- Make the rows of a rank, from files or for a grid.   [H 28] */
#include "petsc_share.h"


#include <petscdmda.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- from files ---- */

/* Make the rows of this rank. They are columns of `all`, because A is symmetric. */
static PetscErrorCode rows_of(const fvi_sparse *all, const share *s, Mat *A)
{
    const int *start = all->start + s->first;
    const PetscInt count = start[s->rows] - start[0];
    PetscInt *begin, *column;
    PetscFunctionBeginUser;
    PetscCall(PetscMalloc2(s->rows + 1, &begin, count, &column));
    for (PetscInt i = 0; i <= s->rows; i++)
        begin[i] = start[i] - start[0];
    for (PetscInt i = 0; i < count; i++)
        column[i] = all->row[start[0] + i];
    PetscCall(MatCreateMPIAIJWithArrays(PETSC_COMM_WORLD, s->rows, s->rows,
                                        s->all, s->all, begin, column,
                                        all->entry + start[0], A));
    PetscCall(PetscFree2(begin, column));
    PetscFunctionReturn(0);
}

/* Compute the forces on all unknowns, and return those of this rank. */
static int forces_of_rows(double t, size_t d, void *params, double *F)
{
    const share *s = params;
    const fvi_force all = fvi_directory_system(s->directory).force;
    const int status = all.value(t, (size_t)s->all, all.params, s->forces);
    for (size_t i = 0; i < d && !status; i++)
        F[i] = s->forces[(size_t)s->first + i];
    return status;
}

/* Make M, K and C, and the matrices of the dampers. */
static PetscErrorCode matrices_of_files(share *s)
{
    const fvi_sparse *A[3];
    Mat *const of[] = { &s->M, &s->K, &s->C }, C;
    PetscFunctionBeginUser;
    fvi_directory_matrices(s->directory, A);
    for (int l = 0; l < 3; l++)
        if (A[l]->n > 0) /* without C.mtx nothing is damped */
            PetscCall(rows_of(A[l], s, of[l]));
    if (fvi_directory_system(s->directory).mechanism)
        PetscCall(petsc_add_dampers(fvi_directory_system(s->directory).mechanism, s));
    for (size_t j = 0; s->mechanism && j < s->mechanism->damper_count; j++) {
        PetscCall(rows_of(fvi_directory_damping(s->directory, j), s, &C));
        PetscCall(petsc_set_damper(s, (PetscInt)j, C));
        PetscCall(MatDestroy(&C));
    }
    PetscFunctionReturn(0);
}

PetscErrorCode petsc_of_files(const char *folder, double last, PetscInt count,
                              const char *const *damper, share *s)
{
    fvi_error error;
    PetscMPIInt ranks;
    int forced = 0;
    PetscFunctionBeginUser;
    if (fvi_directory_open_dampers(folder, (size_t)count, damper, NULL, &s->directory, &error)
        || fvi_directory_force(s->directory, last, &forced, &error))
        PetscCall(petsc_refuse(&error));
    s->all = (PetscInt)fvi_directory_system(s->directory).d;
    PetscCallMPI(MPI_Comm_size(PETSC_COMM_WORLD, &ranks));
    PetscCheck(ranks <= s->all, PETSC_COMM_WORLD, PETSC_ERR_USER,
               "%d ranks are more than the %d unknowns", ranks, (int)s->all);
    s->rows = PETSC_DECIDE;
    PetscCall(PetscSplitOwnership(PETSC_COMM_WORLD, &s->rows, &s->all));
    PetscCallMPI(MPI_Exscan(&s->rows, &s->first, 1, MPIU_INT, MPI_SUM,
                            PETSC_COMM_WORLD));
    PetscCall(matrices_of_files(s));
    PetscCall(VecCreateMPIWithArray(PETSC_COMM_WORLD, 1, s->rows, s->all, NULL,
                                    &s->x));
    if (forced) {
        PetscCall(PetscMalloc1(s->all, &s->forces));
        s->force = (fvi_force){ .value = forces_of_rows, .params = s };
    }
    PetscFunctionReturn(0);
}

/* ---- of a grid ---- */

/* Set the row of K for the point with the indices `at`. */
static PetscErrorCode set_grid_row(Mat K, PetscInt count, const PetscInt n[3],
                                   const PetscInt at[3])
{
    MatStencil here = { .i = at[0], .j = at[1], .k = at[2] }, beside[7];
    double entry[7] = { 0 };
    PetscInt entries = 1;
    PetscFunctionBeginUser;
    beside[0] = here;
    for (PetscInt a = 0; a < count; a++) {
        const double k = ((double)n[a] + 1) * ((double)n[a] + 1);
        entry[0] += 2 * k;
        for (PetscInt step = -1; step <= 1; step += 2) {
            if (at[a] + step < 0 || at[a] + step >= n[a])
                continue;
            beside[entries] = here;
            *(a == 0   ? &beside[entries].i
              : a == 1 ? &beside[entries].j
                       : &beside[entries].k) += step;
            entry[entries++] = -k;
        }
    }
    PetscCall(MatSetValuesStencil(K, 1, &here, entries, beside, entry,
                                  INSERT_VALUES));
    PetscFunctionReturn(0);
}

/* Read damper j from its text. Its matrix stands before its law. */
static PetscErrorCode read_damper(share *s, PetscInt j, const char *text)
{
    fvi_error error = { .index = (size_t)j };
    char *of = NULL;
    fvi_typed_damper *typed = s->typed + j;
    PetscFunctionBeginUser;
    int status = fvi_parse_damper(text, (size_t)j, s->typed, NULL, typed, &of, &error);
    const int is_mass = of && strcmp(of, "M") == 0;
    if (!status && !is_mass && strcmp(of, "K") != 0)
        status = fvi_fail(&error, FVI_EINVAL, "damper", NAN,
                          "'%s' is neither M nor K, which are the matrices of a grid", of);
    free(of);
    error.index = (size_t)j;
    if (status)
        PetscCall(petsc_refuse(&error));
    s->kernel[j] = (fvi_damper){ .name = typed->name,
                                 .kernel = &typed->law.law,
                                 .past = typed->past };
    PetscCall(petsc_set_damper(s, j, is_mass ? s->M : s->K));
    PetscFunctionReturn(0);
}

static PetscErrorCode damp_grid(double damping, PetscInt count, const char *const *damper,
                                share *s)
{
    PetscFunctionBeginUser;
    if (count == 0 && damping > 0) {
        PetscCall(MatDuplicate(s->K, MAT_COPY_VALUES, &s->C));
        PetscCall(MatScale(s->C, damping));
    }
    if (count == 0)
        PetscFunctionReturn(0);
    PetscCall(PetscCalloc1(count, &s->typed));
    PetscCall(PetscCalloc1(count, &s->kernel));
    s->of_grid = (fvi_mechanism){ .damper_count = (size_t)count, .damper = s->kernel };
    PetscCall(petsc_add_dampers(&s->of_grid, s));
    for (PetscInt j = 0; j < count; j++)
        PetscCall(read_damper(s, j, damper[j]));
    PetscFunctionReturn(0);
}

PetscErrorCode petsc_of_grid(PetscInt lengths, const PetscInt n[3], double damping,
                             PetscInt count, const char *const *damper, share *s)
{
    DM grid;
    PetscInt from[3], size[3], at[3];
    PetscFunctionBeginUser;
    PetscCall(DMDACreate(PETSC_COMM_WORLD, &grid));
    PetscCall(DMSetDimension(grid, lengths));
    PetscCall(DMDASetSizes(grid, n[0], n[1], n[2]));
    PetscCall(DMDASetDof(grid, 1));
    PetscCall(DMDASetStencilType(grid, DMDA_STENCIL_STAR));
    PetscCall(DMDASetStencilWidth(grid, 1));
    PetscCall(DMSetUp(grid));
    PetscCall(DMCreateMatrix(grid, &s->K));
    PetscCall(DMDAGetCorners(grid, &from[0], &from[1], &from[2], &size[0],
                             &size[1], &size[2]));
    for (at[2] = from[2]; at[2] < from[2] + size[2]; at[2]++)
        for (at[1] = from[1]; at[1] < from[1] + size[1]; at[1]++)
            for (at[0] = from[0]; at[0] < from[0] + size[0]; at[0]++)
                PetscCall(set_grid_row(s->K, lengths, n, at));
    PetscCall(MatAssemblyBegin(s->K, MAT_FINAL_ASSEMBLY));
    PetscCall(MatAssemblyEnd(s->K, MAT_FINAL_ASSEMBLY));
    PetscCall(DMCreateMatrix(grid, &s->M));
    PetscCall(MatShift(s->M, 1));
    PetscCall(DMCreateGlobalVector(grid, &s->x)); /* this vector knows the grid */
    PetscCall(VecGetSize(s->x, &s->all));
    PetscCall(VecGetLocalSize(s->x, &s->rows));
    PetscCall(VecGetOwnershipRange(s->x, &s->first, NULL));
    PetscCall(damp_grid(damping, count, damper, s));
    PetscCall(DMDestroy(&grid));
    PetscFunctionReturn(0);
}

PetscErrorCode petsc_free_share(share *s)
{
    PetscFunctionBeginUser;
    PetscCall(VecDestroy(&s->x));
    PetscCall(VecDestroy(&s->y));
    PetscCall(MatDestroy(&s->M));
    PetscCall(MatDestroy(&s->K));
    PetscCall(MatDestroy(&s->C));
    PetscCall(petsc_free_dampers(s));
    PetscCall(PetscFree(s->forces));
    fvi_directory_close(s->directory);
    PetscFunctionReturn(0);
}
