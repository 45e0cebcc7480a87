/* src/petsc/petsc_share.h -- What a rank has of a structure.             [H 28]
 *
 * Internal to src/petsc/. Functions that return a PetscErrorCode end all ranks, in words,
 * where something is wrong. */
#ifndef PETSC_SHARE_H
#define PETSC_SHARE_H

#include <fvi/trajectory.h>
#include <fvi/directory.h>

#include <petscksp.h>

_Static_assert(sizeof(PetscScalar) == sizeof(double), "PETSc of real doubles");

/* The rows of this rank. Where nothing is damped there is no C. */
typedef struct {
    PetscInt all, first, rows;
    Mat M, K, C;
    Vec x, y;                 /* without numbers of their own */
    double *room;             /* `rows` numbers */
    fvi_directory *directory; /* NULL: a grid */
    double *forces;           /* NULL, or `all` numbers */
    fvi_force force;
} share;

/* petsc_of_files -- the system of a folder, as `fvi run --system` reads and refuses it, f.tsv
 * included, which must reach to the time `last`. Every rank reads all of it and keeps its
 * rows. */
PetscErrorCode petsc_of_files(const char *folder, double last, share *s);

/* petsc_of_grid -- a string, a membrane or a block of `count` lengths n_1, n_2, n_3 (PETSc's
 * DMDA): M = 1, K the sum of the second differences times (n_i + 1)^2, zero beyond the
 * ends, C = damping K. Nothing is read, and no rank has more than its part. */
PetscErrorCode petsc_of_grid(PetscInt count, const PetscInt n[3],
                             double damping, share *s);

/* petsc_forget -- give all of it back. */
PetscErrorCode petsc_forget(share *s);

/* petsc_matrices -- what the library asks of matrices; s must outlive it. */
fvi_matrices petsc_matrices(const share *s);

/* petsc_write -- x and p of a run as two vectors in PETSc's binary format; those of a grid in
 * the order of the grid, the first index fastest. */
PetscErrorCode petsc_write(const share *s, const char *file,
                           const fvi_stepper *run);

/* petsc_save, petsc_load -- the state of a run, a file for each rank, FILE.0, FILE.1, ...: with
 * as many ranks, the same matrices and the same run it goes on with the same digits. Files
 * of another run are refused; old ones stay until all ranks have written new ones. */
PetscErrorCode petsc_save(const share *s, const char *file, fvi_stepper *run);
PetscErrorCode petsc_load(const share *s, const char *file, fvi_stepper *run);

#endif
