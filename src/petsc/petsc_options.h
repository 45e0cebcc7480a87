/* src/petsc/petsc_options.h -- Read the options of build/fvi_petsc.         [H 28]
 *
 * Internal to src/petsc. */
#ifndef PETSC_OPTIONS_H
#define PETSC_OPTIONS_H

#include <petscsys.h>

typedef struct {
    char folder[PETSC_MAX_PATH_LEN], file[PETSC_MAX_PATH_LEN],
        checkpoint[PETSC_MAX_PATH_LEN];
    PetscReal alpha, h, x0, p0, damping;
    PetscInt steps, stop, lengths, n[3], dampers;
    const char **damper; /* texts of -damper_1, -damper_2, ..., which belong to PETSc */
    PetscBool has_folder, has_grid, has_alpha, has_damping, writes, saves, stops, resumes;
} petsc_options;

/* petsc_read_options -- Read all options except those of PETSc's solvers, and refuse options that do not go together.
 *
 * petsc_free_options -- Free the list of texts. */
PetscErrorCode petsc_read_options(petsc_options *w);
PetscErrorCode petsc_free_options(petsc_options *w);

#endif
