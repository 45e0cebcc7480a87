/* src/fvi/directory.h -- Read a system M x'' + C D^{2 alpha} x + K x = F(t) from the files of a folder.
 *
 * The folder holds M.mtx and K.mtx, and may hold C.mtx and f.tsv.
 *
 *     fvi_directory *directory;
 *     if (fvi_directory_open("building", &directory, &error) == FVI_SUCCESS)
 *         system = fvi_directory_system(directory); */
#ifndef FVI_DIRECTORY_H
#define FVI_DIRECTORY_H

#include "error.h"
#include "parse.h"
#include "structures.h"

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(default)

typedef struct fvi_directory fvi_directory;

/* fvi_directory_open -- read M.mtx, K.mtx and, if it is there, C.mtx from a folder (fvi_sparse_read, structures.h).
 *
 *   name       the folder
 *   directory  output; close it with fvi_directory_close
 *   error      output, or NULL: what is wrong. Its field is "system", and its text names the file and the line
 *
 * Another file in the folder that looks like an input is refused by its name, because it would not be read: any other
 * name.mtx, and tables such as F.tsv, f.csv or stiffness.txt.
 *
 * Returns FVI_SUCCESS; FVI_EINVAL if a file or the folder is refused; FVI_ENOMEM. On error *directory is untouched. */
int fvi_directory_open(const char *name, fvi_directory **directory,
                       fvi_error *error);

/* fvi_directory_open_dampers -- open a folder with several dampers instead of C.mtx.
 *
 *     const char *const damper[] = { "C.mtx : power:1,0.3", "roof=x5-x4 : zener:2,0.3,1" };
 *     status = fvi_directory_open_dampers("building", 2, damper, NULL, &directory, &error);
 *
 *   name       the folder
 *   count, damper  texts '[NAME=] G : LAW [: PAST]', as the dampers of a mechanism (parse.h). G is the name of a .mtx
 *              file of the folder, a symmetric positive semidefinite matrix; or an expression in x1, ..., xd that is
 *              linear. With count = 0 the function is fvi_directory_open
 *   parameters  names with values for the expressions, or NULL
 *   directory, error  outputs, as for fvi_directory_open
 *
 * A C.mtx that no damper names is refused, like all other files that would not be read. If the field of the error is
 * "damper", its index is the number of the damper, from 0.
 * Returns as fvi_directory_open; also what fvi_structure_alloc_dampers returns. */
int fvi_directory_open_dampers(const char *name, size_t count, const char *const *damper,
                               fvi_user_parameters *parameters, fvi_directory **directory,
                               fvi_error *error);

/* fvi_directory_file -- return the name of file number i, from 0, of all files that were read or would be read if they
 * were there: "M.mtx", ...; NULL if i is too large. The name belongs to the directory. */
const char *fvi_directory_file(const fvi_directory *directory, size_t i);

/* fvi_directory_force -- read the forces f.tsv of the folder, if it is there.
 *
 * Each row is t, f_1, ..., f_d. Or a first line names the columns, "t f3 f7", and all other unknowns are free. Between
 * two rows the force is linear.
 *
 *   last   the time that the rows must reach; they must begin at t <= 0
 *   found  output: nonzero if there is such a file
 *   error  output, or NULL, as for fvi_directory_open
 *
 * Call it at most once, before fvi_directory_system. Returns FVI_SUCCESS, also without a file; FVI_EINVAL if the file
 * is refused; FVI_ENOMEM. */
int fvi_directory_force(fvi_directory *directory, double last, int *found,
                        fvi_error *error);

/* fvi_directory_force_name -- return "f.tsv of NAME", for the head of a table. The text belongs to the directory. */
const char *fvi_directory_force_name(const fvi_directory *directory);

/* fvi_directory_system -- return the system, with the force that fvi_directory_force has read. It points into the
 * directory, which must outlive every run of the system. */
fvi_system fvi_directory_system(const fvi_directory *directory);

/* fvi_directory_damping -- return C_j of damper j, from 0, of a folder that was opened with dampers: the matrix that
 * was read, or row^T row of a linear expression. It belongs to the directory. */
const fvi_sparse *fvi_directory_damping(const fvi_directory *directory, size_t j);

/* fvi_directory_matrices -- give M, K and C as they were read, in this order. C is empty if there is no C.mtx. They
 * belong to the directory. */
void fvi_directory_matrices(const fvi_directory *directory,
                            const fvi_sparse *A[3]);

/* fvi_directory_solver -- return how m M + c C + k K is solved with, for the head of a table, as
 * fvi_structure_solver_name (structures.h): "diagonal", "band" or "CHOLMOD". */
const char *fvi_directory_solver(const fvi_directory *directory, double m,
                                 double c, double k);

/* fvi_directory_close -- free a directory. NULL is allowed. */
void fvi_directory_close(fvi_directory *directory);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
