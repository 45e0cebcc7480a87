/* src/petsc/petsc_share.h -- Declare what a rank has of a structure.             [H 28]
 *
 * Internal to src/petsc. If something is wrong, a function that returns a PetscErrorCode ends all ranks with a
 * message. */
#ifndef PETSC_SHARE_H
#define PETSC_SHARE_H

#include <fvi/trajectory.h>
#include <fvi/directory.h>

#include "problem/typed_mechanism.h"

#include <petscksp.h>

_Static_assert(sizeof(PetscScalar) == sizeof(double), "PETSc of real doubles");

/* One of several dampers. A rank has the history of the unknowns that C couples.
 *
 *   damped_rows   C without its empty rows and columns; C itself if it has none
 *   count, index  the rows of `damped_rows` on this rank, and their positions among the rank's rows. A rank
 *                 whose rows are all empty has its first row there, because it must take part in the
 *                 product with `damped_rows`, for which the other ranks wait. No rank has a row if C is 0
 *   z, y          vectors for the product with `damped_rows`: its input and its output
 *   product       `count` numbers */
typedef struct {
    Mat damped_rows;
    PetscInt count, *index;
    Vec z, y;
    double *product;
} petsc_damper;

/* The rows of this rank. C is NULL if nothing is damped, and with several dampers. */
typedef struct {
    PetscInt all, first, rows;
    Mat M, K, C;
    Vec x, y;                 /* vectors without numbers of their own */
    double *room;             /* `rows` numbers */
    fvi_directory *directory; /* NULL for a grid */
    double *forces;           /* NULL, or `all` numbers */
    fvi_force force;
    const fvi_mechanism *mechanism; /* NULL, or the kernels and pasts of several dampers */
    Mat *damper_matrices;           /* their matrices C_j */
    petsc_damper *damper;           /* their histories */
    fvi_damping_matrix *damping;    /* the functions of each damper that the library calls */
    fvi_typed_damper *typed;        /* for a grid: the texts that were read */
    fvi_damper *kernel;
    fvi_mechanism of_grid;
} share;

/* petsc_of_files -- Read the system of a folder, as `fvi run --system` reads and refuses it, with f.tsv, which must
 * reach to the time `last`. Every rank reads all of it and keeps its rows.
 *
 *   count, damper  the texts of several dampers, as for `fvi run --damper`; 0: C.mtx, if it exists */
PetscErrorCode petsc_of_files(const char *folder, double last, PetscInt count,
                              const char *const *damper, share *s);

/* petsc_of_grid -- Make a string, a membrane or a block with `lengths` lengths n_1, n_2, n_3 (PETSc's DMDA): M = 1, and
 * K is the sum of the second differences times (n_i + 1)^2, with zeros beyond the ends. Nothing is read, and no rank
 * has more than its part.
 *
 *   damping        C = damping K; not read with several dampers
 *   count, damper  texts '[NAME=] G : LAW [: PAST]', where G is M or K */
PetscErrorCode petsc_of_grid(PetscInt lengths, const PetscInt n[3], double damping,
                             PetscInt count, const char *const *damper, share *s);

/* petsc_refuse -- End with the library's message about an input. If the field of the error is an option of this
 * program, the message begins with it: -system, or -damper_2 by the error's index. */
PetscErrorCode petsc_refuse(const fvi_error *error);

/* petsc_add_dampers -- Allocate the dampers of this mechanism, which must outlive s.
 *
 * petsc_set_damper -- Set damper j by its matrix C, to which a reference is kept.
 *
 * petsc_free_dampers -- Free them. */
PetscErrorCode petsc_add_dampers(const fvi_mechanism *mechanism, share *s);
PetscErrorCode petsc_set_damper(share *s, PetscInt j, Mat C);
PetscErrorCode petsc_free_dampers(share *s);

/* petsc_free_share -- Free everything in s. */
PetscErrorCode petsc_free_share(share *s);

/* petsc_product -- Compute y = A x. `from` and `to` are vectors without numbers, of the sizes of A. All ranks must call
 * it. Return FVI_SUCCESS, or FVI_EBADFUNC after PETSc has printed the reason. */
int petsc_product(Mat A, Vec from, const double *x, Vec to, double *y);

/* petsc_matrices -- Return the matrices for the library; s must outlive them. */
fvi_matrices petsc_matrices(const share *s);

/* petsc_write -- Write x and p of a run as two vectors in PETSc's binary format. Those of a grid are in the order of
 * the grid, with the first index fastest. */
PetscErrorCode petsc_write(const share *s, const char *file,
                           const fvi_stepper *run);

/* petsc_save, petsc_load -- Write and read the state of a run, in one file for each rank: FILE.0, FILE.1, ... With the
 * same number of ranks, the same matrices, dampers and run, it goes on with the same digits. Files of another run are
 * refused with the reason. Old files stay until all ranks have written new ones. */
PetscErrorCode petsc_save(const share *s, const char *file, fvi_stepper *run);
PetscErrorCode petsc_load(const share *s, const char *file, fvi_stepper *run);

#endif
