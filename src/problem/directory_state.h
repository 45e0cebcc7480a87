/* src/problem/directory_state.h -- What a folder has become. */
#ifndef FVI_DIRECTORY_STATE_H
#define FVI_DIRECTORY_STATE_H

#include <fvi/directory.h>

#include "typed_mechanism.h"

#include <limits.h>

/* Forces on some unknowns, in rows of t and `width` numbers. */
typedef struct {
    size_t rows, width;
    size_t *unknown; /* of each column, from 0 */
    double *t;       /* each row in one piece */
} loads;

/* One of several dampers: a file of the folder, or a row. */
typedef struct {
    fvi_typed_damper typed;
    char *file;     /* or NULL; while words are parsed the text of a row, too */
    fvi_sparse C;   /* of the file */
    double *row;    /* else */
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

/* fvi_directory_path -- DIR/file into place, PATH_MAX + 8 characters; returns it.
 * fvi_file_is_there -- a link that leads nowhere is there, and cannot be read. */
const char *fvi_directory_path(const fvi_directory *d, const char *file, char *place);
int fvi_file_is_there(const char *place);

/* fvi_directory_typed_force -- the forces that were read. */
fvi_force fvi_directory_typed_force(const fvi_directory *d);

/* fvi_directory_read_matrix -- a file of the folder. */
int fvi_directory_read_matrix(const fvi_directory *d, const char *file, fvi_sparse *A,
                              fvi_error *error);

/* fvi_directory_refuse_matrix -- a matrix that was read, but does not make a system, with the line of
 * the size, or of the entry that gives it away, where one does. */
int fvi_directory_refuse_matrix(const fvi_directory *d, int status, const char *file,
                                const fvi_sparse *A, fvi_error *error);

/* fvi_directory_parse_dampers -- names, laws and files of all of them; of a row its text alone.
 * fvi_directory_read_dampers -- their matrices and rows, when M is there, and the structure.
 * fvi_directory_free_dampers -- give them back. */
int fvi_directory_parse_dampers(fvi_directory *d, size_t count, const char *const *text,
                                fvi_user_parameters *parameters, fvi_error *error);
int fvi_directory_read_dampers(fvi_directory *d, fvi_user_parameters *parameters,
                               fvi_error *error);
void fvi_directory_free_dampers(fvi_directory *d);

#endif
