/* src/problem/directory_dampers.c -- Read several dampers for the system of a folder. */
#define _GNU_SOURCE /* for PATH_MAX */
#include "directory_state.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Add the number of the damper, from 0, to its error. Return status. */
static int error_of_damper(size_t j, int status, fvi_error *error)
{
    if (status && error)
        error->index = j;
    return status;
}

/* ---- words ---- */

/* Return nonzero if the text names a file, not an elongation. */
static int is_file(const char *text)
{
    const size_t length = strlen(text);
    return length > 4 && strcmp(text + length - 4, ".mtx") == 0;
}

int fvi_directory_parse_dampers(fvi_directory *d, size_t count, const char *const *text,
                                fvi_user_parameters *parameters, fvi_error *error)
{
    int status = FVI_SUCCESS;
    d->each = calloc(count + 1, sizeof *d->each);
    d->damper = calloc(count + 1, sizeof *d->damper);
    fvi_typed_damper *known = calloc(count + 1, sizeof *known);
    if (!d->each || !d->damper || !known)
        status = fvi_no_memory(error, "damper");
    for (size_t j = 0; !status && j < count; j++) {
        fvi_directory_damper *damper = d->each + j;
        d->dampers++;
        status = fvi_parse_damper(text[j], j, known, parameters, &damper->typed,
                                  &damper->file, error);
        known[j] = damper->typed; /* for its name */
        if (!status && is_file(damper->file) && strchr(damper->file, '/'))
            status = fvi_refuse(error, "damper", "'%s' is not the name of a file of the folder", damper->file);
        error_of_damper(j, status, error);
    }
    free(known);
    return status;
}

/* ---- matrices and rows ---- */

static int refuse_text(const char *text, const char *reason, fvi_error *error)
{
    return fvi_refuse(error, "damper", "'%s' %s", text, reason);
}

/* Compute the gradient of a linear elongation. It must be the same at two places, and must not contain t. The last of
 * the d + 1 variables is t; row, y and other have room for d + 1 numbers. */
static int find_row(const char *text, const fvi_expression *e, size_t d, double *row,
                    double *y, double *other, fvi_error *error)
{
    for (size_t i = 0; i <= d; i++)
        y[i] = 0;
    fvi_expression_gradient(e, y, row);
    const double constant = fvi_expression_value(e, y);
    for (size_t i = 0; i <= d; i++)
        y[i] = 0.3 + 1.7 / (double)(i + 1);
    fvi_expression_gradient(e, y, other);
    if (!fvi_all_finite(d + 1, row))
        return refuse_text(text, "is no elongation at x = 0", error);
    if (row[d] != 0 || other[d] != 0)
        return refuse_text(text, "has t in it: a structure stands still", error);
    double sum = constant, size = fabs(constant);
    for (size_t i = 0; i < d; i++) {
        if (row[i] != other[i])
            return refuse_text(text, "is not linear: without --system it may be", error);
        sum += row[i] * y[i];
        size += fabs(row[i] * y[i]);
    }
    return fabs(fvi_expression_value(e, y) - sum) <= 1e-12 * size
               ? FVI_SUCCESS
               : refuse_text(text, "is not linear: without --system it may be", error);
}

static int parse_row(fvi_directory *d, fvi_directory_damper *damper,
                     fvi_user_parameters *parameters, fvi_error *error)
{
    const size_t n = d->M.n;
    const char *text = damper->file;
    fvi_expression *e = NULL;
    int status =
        fvi_parse_state_expression("damper", n, 0, text, parameters, &e, error);
    double *room = malloc(2 * (n + 1) * sizeof *room);
    damper->row = malloc((n + 1) * sizeof *damper->row);
    if (!status)
        status = room && damper->row
                     ? find_row(text, e, n, damper->row, room, room + n + 1, error)
                     : fvi_no_memory(error, "damper");
    free(room);
    fvi_expression_free(e);
    return status;
}

/* Refuse a structure, or one of its dampers. */
static int refuse_structure(const fvi_directory *d, int status, const fvi_error *wrong,
                            fvi_error *error)
{
    if (wrong->field && strcmp(wrong->field, "M") == 0)
        return fvi_directory_refuse_matrix(d, status, "M.mtx", &d->M, error);
    if (wrong->field && strcmp(wrong->field, "K") == 0)
        return fvi_directory_refuse_matrix(d, status, "K.mtx", &d->K, error);
    const fvi_directory_damper *damper = d->each + wrong->index;
    if (damper->file && is_file(damper->file))
        return fvi_directory_refuse_matrix(d, status, damper->file, &damper->C, error);
    fvi_fail(error, status, "damper", NAN, "%s", wrong->text);
    return error_of_damper(wrong->index, status, error);
}

int fvi_directory_read_dampers(fvi_directory *d, fvi_user_parameters *parameters,
                               fvi_error *error)
{
    int status = FVI_SUCCESS;
    fvi_error wrong = { 0 };
    for (size_t j = 0; !status && j < d->dampers; j++) {
        fvi_directory_damper *damper = d->each + j;
        const int by_file = is_file(damper->file);
        status = by_file
                     ? fvi_directory_read_matrix(d, damper->file, &damper->C, error)
                     : error_of_damper(j, parse_row(d, damper, parameters, error), error);
        d->damper[j] = (fvi_damper){ .name = damper->typed.name,
                                     .of = fvi_elongation_row(damper->row),
                                     .matrix = by_file ? &damper->C : NULL,
                                     .kernel = &damper->typed.law.law,
                                     .past = damper->typed.past };
        if (!by_file) { /* an elongation, so the text is no longer needed */
            free(damper->file);
            damper->file = NULL;
        }
    }
    if (status)
        return status;
    status = fvi_structure_alloc_dampers(&d->M, &d->K, d->dampers, d->damper,
                                         &d->structure, &wrong);
    return status ? refuse_structure(d, status, &wrong, error) : FVI_SUCCESS;
}

void fvi_directory_free_dampers(fvi_directory *d)
{
    for (size_t j = 0; d->each && j < d->dampers; j++) {
        fvi_typed_damper_free(&d->each[j].typed);
        fvi_sparse_free(&d->each[j].C);
        free(d->each[j].file);
        free(d->each[j].row);
    }
    free(d->each);
    free(d->damper);
}
