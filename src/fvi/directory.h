/* src/fvi/directory.h -- A system from the files of a folder.
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

/* fvi_directory_open -- M.mtx, K.mtx and, if it is there, C.mtx of a folder. A file that looks
 * like an input, but is not read, is refused by its name: another name.mtx, F.tsv, f.csv,
 * stiffness.txt.
 *
 *   directory  output; close it with fvi_directory_close
 *
 * Returns FVI_SUCCESS; FVI_EINVAL with an error that names the file and the line;
 * FVI_ENOMEM. */
int fvi_directory_open(const char *name, fvi_directory **directory,
                       fvi_error *error);

/* fvi_directory_open_dampers -- the same with several dampers in place of C:
 *
 *     const char *const damper[] = { "C.mtx : power:1,0.3", "roof=x5-x4 : zener:2,0.3,1" };
 *
 *   count, damper  texts '[NAME=] G : LAW [: PAST]' as those of a mechanism (parse.h). G is a file of
 *              the folder, a symmetric matrix that is not negative, or an expression in x1, ...,
 *              xd that is linear. With count 0 as fvi_directory_open
 *   parameters  of the expressions, or NULL
 *
 * A C.mtx that no damper names is refused, as all other files that would not be read. The index of an
 * error with the field "damper" is the damper's, from 0. */
int fvi_directory_open_dampers(const char *name, size_t count, const char *const *damper,
                               fvi_user_parameters *parameters, fvi_directory **directory,
                               fvi_error *error);

/* fvi_directory_file -- the name of file number i, from 0, that was read of the folder, or would be:
 * "M.mtx", ...; NULL if there are not so many. */
const char *fvi_directory_file(const fvi_directory *directory, size_t i);

/* fvi_directory_force -- f.tsv of the folder, if it is there: rows t, f_1, ..., f_d, or of the
 * unknowns that a first line names, "t f3 f7"; linear in between. All others are free.
 *
 *   last   the time up to which it must reach
 *   found  output: nonzero if there is such a file
 *
 * Returns as fvi_directory_open. */
int fvi_directory_force(fvi_directory *directory, double last, int *found,
                        fvi_error *error);

/* fvi_directory_force_name -- "f.tsv of DIR", for the head of a table; the directory's. */
const char *fvi_directory_force_name(const fvi_directory *directory);

/* fvi_directory_system -- the system, with that force. It points into the directory. */
fvi_system fvi_directory_system(const fvi_directory *directory);

/* fvi_directory_damping -- C_j of damper j, from 0, of a folder that was opened with dampers: as it was
 * read, or row^T row. It belongs to the directory. */
const fvi_sparse *fvi_directory_damping(const fvi_directory *directory, size_t j);

/* fvi_directory_matrices -- M, K and C as they were read; C is empty if there is none. */
void fvi_directory_matrices(const fvi_directory *directory,
                            const fvi_sparse *A[3]);

/* fvi_directory_solver -- how a step of that method is solved, for the head of a table. */
const char *fvi_directory_solver(const fvi_directory *directory, double m,
                                 double c, double k);

/* fvi_directory_close -- give everything back. NULL is allowed. */
void fvi_directory_close(fvi_directory *directory);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
