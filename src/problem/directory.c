/* src/problem/directory.c -- A system from the files of a folder. */
#define _GNU_SOURCE /* PATH_MAX */
#include "directory_state.h"

#include "polygon.h"
#include "rows.h"
#include "matrices/sparse.h"

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

static int no_memory(fvi_error *error)
{
    return fvi_fail(error, FVI_ENOMEM, "system", NAN, "not enough memory");
}

/* DIR/file. */
static const char *path(const fvi_directory *d, const char *file,
                        char place[PATH_MAX + 8])
{
    snprintf(place, PATH_MAX + 8, "%s/%s", d->name, file);
    return place;
}

/* A link that leads nowhere is there, and cannot be read. */
static int is_there(const char *place)
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
    int status = fvi_sparse_read(path(d, file, place), A, &wrong);
    if (status == FVI_ENOMEM)
        return no_memory(error);
    if (status && wrong.line == 0)
        return fvi_fail(error, FVI_EINVAL, "system", NAN, "%s: %s", place, wrong.reason);
    if (status && wrong.column == 0)
        return fvi_fail(error, FVI_EINVAL, "system", NAN, "%s:%zu: %s", place, wrong.line,
                          wrong.reason);
    return status ? fvi_fail(error, FVI_EINVAL, "system", NAN, "%s:%zu:%zu: %s", place, wrong.line,
                               wrong.column, wrong.reason)
                  : 0;
}

/* An entry for which A cannot be positive definite, or not even semidefinite: one of the
 * diagonal, or one that is too large for those of its row and column. 0 if there is none. */
static int gives_away(const fvi_sparse *A, int semidefinite, int *row,
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
        return no_memory(error);
    char place[PATH_MAX + 8];
    int row = -1, column = -1;
    size_t line = 0;
    path(d, file, place);
    if (status == FVI_EINVAL || gives_away(A, !is_mass, &row, &column))
        line = fvi_sparse_line(place, row, column);
    return line ? fvi_fail(error, FVI_EINVAL, "system", NAN, "%s:%zu: %s", place, line, reason)
                : fvi_fail(error, FVI_EINVAL, "system", NAN, "%s: %s", place, reason);
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
    const int damped = is_there(path(d, "C.mtx", place));
    if (!status && damped)
        status = fvi_directory_read_matrix(d, "C.mtx", &d->C, error);
    if (status)
        return status;
    status = fvi_structure_alloc(&d->M, &d->K, damped ? &d->C : NULL,
                                 &d->structure, &fault);
    return status ? refuse_one_of_three(d, status, fault, error) : 0;
}

/* ---- files that are not read ---- */

/* Does this look like an input, and is it none? All that ends with .mtx, and tables of
 * numbers whose names stand for a matrix or a force. */
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

/* Of several the first by its name. A folder that cannot be listed has none. */
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
               ? fvi_fail(error, FVI_EINVAL, "system", NAN,
                          "%s/%s would not be read: M.mtx, K.mtx, f.tsv and the files that "
                          "a damper names are",
                          d->name, first)
               : fvi_fail(error, FVI_EINVAL, "system", NAN, "%s/%s would not be read: M.mtx, "
                               "K.mtx, C.mtx and f.tsv are",
                               d->name, first);
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
        return no_memory(error);
    int status = 0;
    if (strlen(name) >= sizeof d->name)
        status = fvi_fail(error, FVI_EINVAL, "system", NAN, "'%s' is too long", name);
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

/* ---- forces ---- */

static const char between[] = " \t\r,;";

/* Columns 1 to d. */
static int all_columns(loads *l, size_t d)
{
    l->unknown = malloc(d * sizeof *l->unknown);
    for (l->width = 0; l->unknown && l->width < d; l->width++)
        l->unknown[l->width] = l->width;
    return l->unknown ? FVI_SUCCESS : FVI_ENOMEM;
}

/* Is a line behind # no comment, but "t f3 f7"? */
static int names_columns(const char *line)
{
    const char *at = line + strspn(line, "# \t");
    const char *next = at + 1 + (*at == 't' ? strspn(at + 1, between) : 0);
    return *at == 't' && next > at + 1 && *next == 'f' && next[1] >= '0'
           && next[1] <= '9';
}

/* A fault in the line of names. */
static int refuse_name(const fvi_rows *r, const char *at, const char *reason)
{
    return fvi_fail(r->error, FVI_EINVAL, "system", NAN, "%s:%zu:%zu: %s", r->name,
                      r->lines.number, (size_t)(at - r->lines.text) + 1,
                      reason);
}

/* "t f3 f7", perhaps behind #. */
static int named_columns(const fvi_rows *r, loads *l, size_t d)
{
    char *at = r->lines.text + strspn(r->lines.text, "# \t"), *stop;
    if (*at != 't' || !at[1] || !strchr(between, at[1]))
        return refuse_name(r, at, "names are t, then f1, f2, ...");
    l->unknown = malloc(d * sizeof *l->unknown);
    if (!l->unknown)
        return FVI_ENOMEM;
    for (at++; *(at += strspn(at, between)); at = stop) {
        const int digit = *at == 'f' && at[1] >= '0' && at[1] <= '9';
        const size_t i = digit ? strtoul(at + 1, &stop, 10) : 0;
        if (!digit || !strchr(between, *stop) || i < 1 || i > d)
            return refuse_name(r, at, "a name that is none of the unknowns'");
        for (size_t k = 0; k < l->width; k++)
            if (l->unknown[k] == i - 1)
                return refuse_name(r, at, "an unknown that is named twice");
        l->unknown[l->width++] = i - 1;
    }
    return l->width > 0 ? 0
                        : refuse_name(r, at, "names are t, then f1, f2, ...");
}

/* One row of numbers; t increases. */
static int take_row(const fvi_rows *r, loads *l, size_t *room)
{
    const size_t width = l->width + 1, n = l->rows;
    const int status = fvi_rows_check_width(r, width);
    if (status)
        return status;
    if (n == *room) {
        *room = 2 * *room + 64;
        double *more = realloc(l->t, *room * width * sizeof *more);
        if (!more)
            return FVI_ENOMEM;
        l->t = more;
    }
    memcpy(l->t + n * width, r->values, width * sizeof *l->t);
    if (n > 0 && !(l->t[n * width] > l->t[(n - 1) * width]))
        return fvi_rows_refuse(r, 0, "t does not increase");
    l->rows++;
    return 0;
}

static int read_rows(fvi_rows *r, loads *l, size_t d)
{
    fvi_rows_kind kind;
    size_t room = 0;
    int status;
    while (!(status = fvi_rows_next(r, &kind)) && kind != FVI_ROWS_END) {
        const char *text = r->lines.text;
        const int is_name =
            !l->unknown
            && (kind == FVI_ROWS_COMMENT ? names_columns(text) : *text == 't');
        if (kind == FVI_ROWS_COMMENT && !is_name)
            continue;
        if (is_name)
            status = named_columns(r, l, d);
        else if (kind == FVI_ROWS_WORDS)
            status = fvi_rows_refuse(r, 0, FVI_ROWS_NO_NUMBER);
        else if (!l->unknown)
            status = all_columns(l, d);
        if (!status && !is_name)
            status = take_row(r, l, &room);
        if (status)
            return status;
    }
    return status;
}

int fvi_directory_force(fvi_directory *d, double last, int *found,
                        fvi_error *error)
{
    char place[PATH_MAX + 8];
    loads *l = &d->loads;
    fvi_rows r;
    *found = is_there(path(d, "f.tsv", place));
    if (!*found)
        return 0;
    int status = fvi_rows_open(&r, "system", place, error);
    if (!status)
        status = read_rows(&r, l, d->M.n);
    fvi_rows_close(&r);
    if (status)
        return status == FVI_ENOMEM ? no_memory(error) : status;
    if (l->rows == 0)
        return fvi_fail(error, FVI_EINVAL, "system", NAN, "%s: has no rows", place);
    const double end = l->t[(l->rows - 1) * (l->width + 1)];
    if (l->t[0] > 0 || end < last * (1 - 1e-12))
        return fvi_fail(error, FVI_EINVAL, "system", NAN, "%s: from t = %g to %g, the run from 0 to %g", place,
            l->t[0], end, last);
    return 0;
}

/* Linear between two rows; outside, which is a rounding away, the nearest. */
static int value(double t, size_t d, void *params, double *F)
{
    const loads *l = &((const fvi_directory *)params)->loads;
    const size_t width = l->width + 1;
    const fvi_polygon rows = { l->rows, width, width, l->t, NULL };
    const size_t low = fvi_polygon_row(&rows, t);
    const double *before = l->t + low * width,
                 *after = low + 1 < l->rows ? before + width : before;
    const double part = after > before ? (t - *before) / (*after - *before) : 0;
    memset(F, 0, d * sizeof *F);
    for (size_t i = 0; i < l->width; i++)
        F[l->unknown[i]] =
            before[1 + i]
            + fmin(fmax(part, 0), 1) * (after[1 + i] - before[1 + i]);
    return 0;
}

/* Masses without a column are free. */
static int bound(double from, double to, size_t order, size_t d, void *params,
                 double *most)
{
    const loads *l = &((const fvi_directory *)params)->loads;
    memset(most, 0, (order + 1) * d * sizeof *most);
    for (size_t i = 0; i < l->width; i++) {
        const fvi_polygon rows = { l->rows, l->width + 1, l->width + 1, l->t, l->t + 1 + i };
        fvi_polygon_bound(&rows, from, to, order, d, most + l->unknown[i]);
    }
    return 0;
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
        s.force = (fvi_force){ value, (void *)d, .bound = bound };
    return s;
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
