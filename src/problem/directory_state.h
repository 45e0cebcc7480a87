/* src/problem/directory_state.h -- Hold what was read from a folder. */
#ifndef FVI_DIRECTORY_STATE_H
#define FVI_DIRECTORY_STATE_H

#include <fvi/directory.h>

#include "typed_mechanism.h"

#include <limits.h>

/* Forces on some unknowns, in rows of t and `width` numbers. */
typedef struct {
    size_t rows, width;
    size_t *unknown; /* unknown of each column, from 0 */
    double *t;       /* rows of width + 1 numbers, one row after the other */
} loads;

/* One of several dampers: a file of the folder, or an elongation, which is a row. */
typedef struct {
    fvi_typed_damper typed;
    char *file;     /* name of the file, or NULL; while options are parsed also the text of an elongation */
    fvi_sparse C;   /* matrix of the file */
    double *row;    /* row of the elongation */
} fvi_directory_damper;

struct fvi_directory {
    char name[PATH_MAX], force_name[PATH_MAX + 12];
    fvi_sparse M, K, C;
    fvi_structure *structure;
    size_t dampers;
    fvi_directory_damper *each;
    fvi_damper *damper;
    loads loads;
};

/* fvi_directory_path -- Write DIR/file to `place`, which has room for PATH_MAX + 8 characters, and return it.
 * fvi_file_is_there -- Return nonzero if the file exists. A link to a name that does not exist counts as a file that
 * cannot be read. */
const char *fvi_directory_path(const fvi_directory *d, const char *file, char *place);
int fvi_file_is_there(const char *place);

/* fvi_directory_typed_force -- Return the forces that were read. */
fvi_force fvi_directory_typed_force(const fvi_directory *d);

/* fvi_directory_read_matrix -- Read a file of the folder. Return 0, or a code with the error filled in. */
int fvi_directory_read_matrix(const fvi_directory *d, const char *file, fvi_sparse *A,
                              fvi_error *error);

/* fvi_directory_refuse_matrix -- Refuse a matrix that was read but does not make a system. The message names the line
 * of the size, or the line of an entry that proves the fault, if there is one. Return a code. */
int fvi_directory_refuse_matrix(const fvi_directory *d, int status, const char *file,
                                const fvi_sparse *A, fvi_error *error);

/* fvi_directory_parse_dampers -- Parse names, laws and files of all dampers; of an elongation only keep the text.
 * fvi_directory_read_dampers -- Read their matrices, parse their elongations, and make the structure. M must have been
 * read.
 * fvi_directory_free_dampers -- Free all of this. */
int fvi_directory_parse_dampers(fvi_directory *d, size_t count, const char *const *text,
                                fvi_user_parameters *parameters, fvi_error *error);
int fvi_directory_read_dampers(fvi_directory *d, fvi_user_parameters *parameters,
                               fvi_error *error);
void fvi_directory_free_dampers(fvi_directory *d);

#endif
