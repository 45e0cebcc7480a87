/* src/petsc/petsc_share.h -- What a rank has of a structure.             [H 28]
 *
 * Internal to src/petsc/. Functions that return a PetscErrorCode end all ranks, in words,
 * where something is wrong. */
#ifndef PETSC_SHARE_H
#define PETSC_SHARE_H

#include <fvi/trajectory.h>
#include <fvi/directory.h>

#include "problem/typed_mechanism.h"

#include <petscksp.h>

_Static_assert(sizeof(PetscScalar) == sizeof(double), "PETSc of real doubles");

/* One of several dampers. A rank has the history of the unknowns that C couples.
 *
 *   damped_rows  C without the rows and columns that are empty; C itself if none is
 *   count, index  the rows of `damped_rows` on this rank, and their places among the rank's rows. A rank
 *            whose rows are all empty has its first row there: it takes part in the product with
 *            `damped_rows`, for which the other ranks wait. No rank has a row if C is 0
 *   z, y     vectors that `damped_rows` is multiplied with, and gives
 *   product  `count` numbers */
typedef struct {
    Mat damped_rows;
    PetscInt count, *index;
    Vec z, y;
    double *product;
} petsc_damper;

/* The rows of this rank. Where nothing is damped there is no C, and with several dampers, too. */
typedef struct {
    PetscInt all, first, rows;
    Mat M, K, C;
    Vec x, y;                 /* without numbers of their own */
    double *room;             /* `rows` numbers */
    fvi_directory *directory; /* NULL: a grid */
    double *forces;           /* NULL, or `all` numbers */
    fvi_force force;
    const fvi_mechanism *mechanism; /* NULL, or the kernels and pasts of several dampers, */
    Mat *damper_matrices;           /* their matrices C_j, */
    petsc_damper *damper;           /* their histories, */
    fvi_damping_matrix *damping;    /* and what the library asks of them */
    fvi_typed_damper *typed;        /* of a grid: the texts that were read */
    fvi_damper *kernel;
    fvi_mechanism of_grid;
} share;

/* petsc_of_files -- the system of a folder, as `fvi run --system` reads and refuses it, f.tsv
 * included, which must reach to the time `last`. Every rank reads all of it and keeps its
 * rows.
 *
 *   count, damper  the texts of several dampers, as those of `fvi run --damper`; 0: C.mtx, if it is
 *                  there */
PetscErrorCode petsc_of_files(const char *folder, double last, PetscInt count,
                              const char *const *damper, share *s);

/* petsc_of_grid -- a string, a membrane or a block of `lengths` lengths n_1, n_2, n_3 (PETSc's
 * DMDA): M = 1, K the sum of the second differences times (n_i + 1)^2, zero beyond the
 * ends. Nothing is read, and no rank has more than its part.
 *
 *   damping        C = damping K; of several dampers not read
 *   count, damper  texts '[NAME=] G : LAW [: PAST]', where G is M or K */
PetscErrorCode petsc_of_grid(PetscInt lengths, const PetscInt n[3], double damping,
                             PetscInt count, const char *const *damper, share *s);

/* petsc_refuse -- end with what the library says of an input. Where its field is one of this program's
 * options the text begins with that: -system, or -damper_2 by the error's index. */
PetscErrorCode petsc_refuse(const fvi_error *error);

/* petsc_add_dampers -- room for `count` dampers of this mechanism, which must outlive s.
 * petsc_set_damper -- damper j of them by its matrix C, of which it keeps a reference.
 * petsc_forget_dampers -- give them back. */
PetscErrorCode petsc_add_dampers(const fvi_mechanism *mechanism, share *s);
PetscErrorCode petsc_set_damper(share *s, PetscInt j, Mat C);
PetscErrorCode petsc_free_dampers(share *s);

/* petsc_forget -- give all of it back. */
PetscErrorCode petsc_free_share(share *s);

/* petsc_product -- y = A x, where `from` and `to` are vectors without numbers of A's sizes. All
 * ranks call it. Returns FVI_SUCCESS or FVI_EBADFUNC, of which PETSc has said the reason. */
int petsc_product(Mat A, Vec from, const double *x, Vec to, double *y);

/* petsc_matrices -- what the library asks of matrices; s must outlive it. */
fvi_matrices petsc_matrices(const share *s);

/* petsc_write -- x and p of a run as two vectors in PETSc's binary format; those of a grid in
 * the order of the grid, the first index fastest. */
PetscErrorCode petsc_write(const share *s, const char *file,
                           const fvi_stepper *run);

/* petsc_save, petsc_load -- the state of a run, a file for each rank, FILE.0, FILE.1, ...: with
 * as many ranks, the same matrices, the same dampers and the same run it goes on with the same
 * digits. Files of another run are refused, with the reason; old ones stay until all ranks have
 * written new ones. */
PetscErrorCode petsc_save(const share *s, const char *file, fvi_stepper *run);
PetscErrorCode petsc_load(const share *s, const char *file, fvi_stepper *run);

#endif
