/* src/matrices/structure_dampers.c -- Structures with several dampers.     [H 27] */
#include "structure.h"

#include "system/fail.h"

#include <stdlib.h>

static int select_history(size_t d, const double *x, const double *from,
                          const void *params, double *z)
{
    (void)d;
    fvi_history_space_gather(params, x, from, z);
    return FVI_SUCCESS;
}

static int apply_damping(size_t d, double a, const double *z, const void *params,
                         double *p)
{
    (void)d;
    fvi_history_space_apply_damping(params, a, z, p);
    return FVI_SUCCESS;
}

static int apply_damping_to_stages(size_t d, size_t s, double a, const double *z, const void *params, double *p)
{
    (void)d;
    fvi_history_space_apply_to_stages(params, s, a, z, p);
    return FVI_SUCCESS;
}

static int find_diagonal(size_t d, const void *params, double *C)
{
    const fvi_history_space *B = params;
    for (size_t i = 0; i < d; i++)
        C[i] = fvi_sparse_entry(B->C, i, i);
    return FVI_SUCCESS;
}

fvi_damping_matrix fvi_structure_damping_functions(const fvi_history_space *B)
{
    return (fvi_damping_matrix){ B->r, select_history, apply_damping, B, find_diagonal, apply_damping_to_stages };
}

size_t fvi_structure_term_count(const fvi_structure *s)
{
    return 2 + (s->space ? s->mechanism.damper_count : 1);
}

const fvi_sparse *fvi_structure_term(const fvi_structure *s, size_t l)
{
    if (l == 0)
        return s->M;
    if (l == fvi_structure_term_count(s) - 1)
        return s->K;
    if (!s->space)
        return s->C;
    const fvi_sparse *matrix = s->mechanism.damper[l - 1].matrix;
    return matrix ? matrix : s->outer + l - 1;
}

/* Compute row^T row from the nonzero entries of the row. */
static int multiply_row(size_t d, const double *row, fvi_sparse *C)
{
    size_t count = 0;
    for (size_t i = 0; i < d; i++)
        count += row[i] != 0;
    fvi_triplet *t = malloc((count * count + 1) * sizeof *t), *next = t;
    if (!t)
        return FVI_ENOMEM;
    for (size_t j = 0; j < d; j++)
        for (size_t i = 0; row[j] != 0 && i < d; i++)
            if (row[i] != 0)
                *next++ = (fvi_triplet){ (int)i, (int)j, row[i] * row[j] };
    const int status = fvi_sparse_assemble(d, count * count, t, C);
    free(t);
    return status;
}

static int refuse_damper(size_t j, int code, const char *reason, fvi_error *error)
{
    return fvi_at_index(error, j, fvi_fail(error, code, "damper", (double)j + 1, "damper %zu: %s", j + 1, reason));
}

static int find_damper_space(fvi_structure *s, size_t j, fvi_error *error)
{
    const fvi_damper *damper = s->mechanism.damper + j;
    const double *row = damper->of.row;
    const size_t d = s->M->n;
    int status = FVI_SUCCESS, place;
    if (!damper->kernel) /* the start of a run checks the kernel itself */
        return refuse_damper(j, FVI_EFAULT, "it has no kernel", error);
    if (!damper->matrix && !row)
        return refuse_damper(j, FVI_EUNSUP,
                             "a structure has dampers along rows, or by matrices", error);
    if (damper->matrix && damper->matrix->n != d)
        return refuse_damper(j, FVI_EINVAL, "its matrix is not of the size of M", error);
    if (!damper->matrix && !fvi_all_finite(d, row))
        return refuse_damper(j, FVI_EDOM, "its row has an entry that is not finite",
                             error);
    status = damper->matrix ? fvi_sparse_is_symmetric(damper->matrix, &place)
                            : multiply_row(d, row, s->outer + j);
    if (status == FVI_EDOM)
        return refuse_damper(j, status, "its matrix is not symmetric", error);
    if (!status)
        status = damper->matrix
                     ? fvi_history_space_find(s->M, damper->matrix, s->space + j)
                     : fvi_history_space_of_row(s->outer + j, row, s->space + j);
    if (status)
        return refuse_damper(j, status,
                             status == FVI_EDOM ? "its matrix is negative: it would feed "
                                                  "the motion"
                                                : "no memory for its matrix",
                             error);
    s->damper[j] = fvi_structure_damping_functions(s->space + j);
    return FVI_SUCCESS;
}

int fvi_structure_add_dampers(fvi_structure *s, size_t count, const fvi_damper *damper,
                       fvi_error *error)
{
    s->outer = calloc(count, sizeof *s->outer);
    s->space = calloc(count, sizeof *s->space);
    s->damper = calloc(count, sizeof *s->damper);
    if (!s->outer || !s->space || !s->damper)
        return fvi_fail(error, FVI_ENOMEM, "damper", NAN, "no memory for the dampers");
    s->mechanism = (fvi_mechanism){ .damper_count = count, .damper = damper };
    s->matrices.damper_count = count;
    s->matrices.damper = s->damper;
    int status = FVI_SUCCESS;
    for (size_t j = 0; !status && j < count; j++)
        status = find_damper_space(s, j, error);
    return status;
}

void fvi_structure_free_dampers(fvi_structure *s)
{
    for (size_t j = 0; s->damper && j < s->mechanism.damper_count; j++) {
        fvi_history_space_free(s->space + j);
        fvi_sparse_free(s->outer + j);
    }
    free(s->outer);
    free(s->space);
    free(s->damper);
}
