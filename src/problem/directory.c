/* src/problem/directory.c -- Read a system from the files of a folder. */
#define _GNU_SOURCE /* for PATH_MAX */
#include "directory_state.h"

#include "matrices/sparse.h"
#include "matrices/structure.h"

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

const char *fvi_directory_path(const fvi_directory *d, const char *file, char *place)
{
    snprintf(place, PATH_MAX + 8, "%s/%s", d->name, file);
    return place;
}

int fvi_file_is_there(const char *place)
{
    struct stat file;
    return lstat(place, &file) == 0;
}

/* ---- matrices ---- */

int fvi_directory_read_matrix(const fvi_directory *d, const char *file, fvi_sparse *A,
                              fvi_error *error)
{
    char place[PATH_MAX + 8];
    fvi_misread wrong = { 0, "", 0 };
    int status = fvi_sparse_read(fvi_directory_path(d, file, place), A, &wrong);
    if (status == FVI_ENOMEM)
        return fvi_no_memory(error, "system");
    if (status && wrong.line == 0)
        return fvi_refuse(error, "system", "%s: %s", place, wrong.reason);
    if (status && wrong.column == 0)
        return fvi_refuse(error, "system", "%s:%zu: %s", place, wrong.line, wrong.reason);
    return status ? fvi_refuse(error, "system", "%s:%zu:%zu: %s", place, wrong.line, wrong.column, wrong.reason)
                  : 0;
}

/* Find an entry that proves that A is not positive definite, or not semidefinite: one of the diagonal, or one that is
 * too large for the diagonal entries of its row and column. Return 0 if there is none. */
static int find_indefinite_entry(const fvi_sparse *A, int semidefinite, int *row,
                                 int *column)
{
    for (size_t j = 0; j < A->n; j++)
        for (int e = A->start[j]; e < A->start[j + 1]; e++) {
            const size_t i = (size_t)A->row[e];
            const double a = A->entry[e], both = fvi_sparse_entry(A, i, i)
                                                 * fvi_sparse_entry(A, j, j);
            if (i == j ? (semidefinite ? a < 0 : a <= 0)
                       : (semidefinite ? a * a > both : a * a >= both)) {
                *row = (int)i;
                *column = (int)j;
                return 1;
            }
        }
    return 0;
}

int fvi_directory_refuse_matrix(const fvi_directory *d, int status, const char *file,
                                const fvi_sparse *A, fvi_error *error)
{
    const int is_mass = A == &d->M;
    const char *reason =
        status == FVI_EINVAL ? "not of the size of M.mtx"
        : is_mass            ? "not positive definite"
        : A != &d->K ? "not positive semidefinite: it would feed the motion"
                     : "not a matrix of a system";
    if (status == FVI_ENOMEM)
        return fvi_no_memory(error, "system");
    char place[PATH_MAX + 8];
    int row = -1, column = -1;
    size_t line = 0;
    fvi_directory_path(d, file, place);
    if (status == FVI_EINVAL || find_indefinite_entry(A, !is_mass, &row, &column))
        line = fvi_sparse_line(place, row, column);
    return line ? fvi_refuse(error, "system", "%s:%zu: %s", place, line, reason)
                : fvi_refuse(error, "system", "%s: %s", place, reason);
}

static int refuse_one_of_three(const fvi_directory *d, int status, char fault,
                               fvi_error *error)
{
    const char name[] = { fault, '.', 'm', 't', 'x', '\0' };
    return fvi_directory_refuse_matrix(d, status, name,
                                       fault == 'M'   ? &d->M
                                       : fault == 'K' ? &d->K
                                                      : &d->C,
                                       error);
}

static int read_all(fvi_directory *d, fvi_user_parameters *parameters, fvi_error *error)
{
    char place[PATH_MAX + 8], fault;
    int status = fvi_directory_read_matrix(d, "M.mtx", &d->M, error);
    if (!status)
        status = fvi_directory_read_matrix(d, "K.mtx", &d->K, error);
    if (!status && d->dampers > 0)
        return fvi_directory_read_dampers(d, parameters, error);
    const int damped = fvi_file_is_there(fvi_directory_path(d, "C.mtx", place));
    if (!status && damped)
        status = fvi_directory_read_matrix(d, "C.mtx", &d->C, error);
    if (status)
        return status;
    status = fvi_structure_alloc(&d->M, &d->K, damped ? &d->C : NULL,
                                 &d->structure, &fault);
    return status ? refuse_one_of_three(d, status, fault, error) : 0;
}

/* ---- files that are not read ---- */

/* Return nonzero for a file that looks like an input and is not read: a name that ends with .mtx, or a table whose name
 * stands for a matrix or a force. */
static int is_stranger(const fvi_directory *d, const char *name)
{
    static const char *const stems[] = {
        "M", "K", "C", "f", "mass", "stiffness", "damping", "force"
    };
    static const char *const ends[] = { ".tsv", ".csv", ".txt", ".dat" };
    const char *end = strrchr(name, '.');
    const char *read;
    for (size_t i = 0; (read = fvi_directory_file(d, i)); i++)
        if (strcmp(name, read) == 0)
            return 0;
    if (!end || *name == '.')
        return 0;
    int is_table = 0, is_stem = 0;
    for (size_t i = 0; i < sizeof ends / sizeof *ends; i++)
        is_table = is_table || strcasecmp(end, ends[i]) == 0;
    for (size_t i = 0; i < sizeof stems / sizeof *stems; i++)
        is_stem = is_stem
                  || (strlen(stems[i]) == (size_t)(end - name)
                      && strncasecmp(name, stems[i], strlen(stems[i])) == 0);
    return strcasecmp(end, ".mtx") == 0 || (is_table && is_stem);
}

/* Refuse the first such file, in the order of the names. A folder that cannot be listed has none. */
static int refuse_strangers(const fvi_directory *d, fvi_error *error)
{
    char first[NAME_MAX + 1] = "";
    DIR *folder = opendir(d->name);
    for (struct dirent *file; folder && (file = readdir(folder));)
        if (is_stranger(d, file->d_name)
            && (!*first || strcmp(file->d_name, first) < 0))
            snprintf(first, sizeof first, "%s", file->d_name);
    if (folder)
        closedir(folder);
    if (!*first)
        return 0;
    return d->dampers > 0
               ? fvi_refuse(error, "system", "%s/%s would not be read: M.mtx, K.mtx, f.tsv and the files that "
                          "a damper names are",
                          d->name, first)
               : fvi_refuse(error, "system", "%s/%s would not be read: M.mtx, K.mtx, C.mtx and f.tsv are", d->name,
                            first);
}

const char *fvi_directory_file(const fvi_directory *d, size_t i)
{
    static const char *const always[] = { "M.mtx", "K.mtx", "f.tsv" };
    enum { ALWAYS = sizeof always / sizeof *always };
    if (i < ALWAYS)
        return always[i];
    i -= ALWAYS;
    if (d->dampers == 0)
        return i == 0 ? "C.mtx" : NULL;
    for (size_t j = 0; j < d->dampers; j++)
        if (d->each[j].file && i-- == 0)
            return d->each[j].file;
    return NULL;
}

int fvi_directory_open_dampers(const char *name, size_t count, const char *const *damper,
                               fvi_user_parameters *parameters, fvi_directory **directory,
                               fvi_error *error)
{
    fvi_directory *d = calloc(1, sizeof *d);
    if (!d)
        return fvi_no_memory(error, "system");
    int status = 0;
    if (strlen(name) >= sizeof d->name)
        status = fvi_refuse(error, "system", "'%s' is too long", name);
    else
        strcpy(d->name, name);
    snprintf(d->force_name, sizeof d->force_name, "f.tsv of %s", d->name);
    if (!status)
        status = fvi_directory_parse_dampers(d, count, damper, parameters, error);
    if (!status)
        status = read_all(d, parameters, error);
    if (!status)
        status = refuse_strangers(d, error);
    if (status)
        fvi_directory_close(d);
    else
        *directory = d;
    return status;
}

int fvi_directory_open(const char *name, fvi_directory **directory,
                       fvi_error *error)
{
    return fvi_directory_open_dampers(name, 0, NULL, NULL, directory, error);
}

const char *fvi_directory_force_name(const fvi_directory *d)
{
    return d->force_name;
}

/* ---- the system ---- */

fvi_system fvi_directory_system(const fvi_directory *d)
{
    fvi_system s = fvi_structure_system(d->structure);
    if (d->loads.rows > 0)
        s.force = fvi_directory_typed_force(d);
    return s;
}

const fvi_sparse *fvi_directory_damping(const fvi_directory *d, size_t j)
{
    return fvi_structure_term(d->structure, j + 1);
}

void fvi_directory_matrices(const fvi_directory *d, const fvi_sparse *A[3])
{
    A[0] = &d->M;
    A[1] = &d->K;
    A[2] = &d->C;
}

const char *fvi_directory_solver(const fvi_directory *d, double m, double c,
                                 double k)
{
    return fvi_structure_solver_name(d->structure, m, c, k);
}

void fvi_directory_close(fvi_directory *d)
{
    if (!d)
        return;
    fvi_structure_free(d->structure);
    fvi_directory_free_dampers(d);
    fvi_sparse_free(&d->M);
    fvi_sparse_free(&d->K);
    fvi_sparse_free(&d->C);
    free(d->loads.unknown);
    free(d->loads.t);
    free(d);
}
