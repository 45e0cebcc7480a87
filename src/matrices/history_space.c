/* src/matrices/history_space.c -- Choose the numbers of a structure that have a history.          [H 27] */
#include "history_space.h"

#include "factors.h"
#include "system/larger.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { SMALL = 512 /* largest number of unknowns for which the rank of C is found densely */ };

/* ---- functions for a step ---- */

//> select-and-apply
/* z = B^T x - from */
void fvi_history_space_gather(const fvi_history_space *B, const double *x,
                           const double *from, double *z)
{
    for (size_t l = 0; l < B->r; l++) {
        if (B->kind == FVI_HISTORY_SPACE_ALL)
            z[l] = x[l] - from[l];
        if (B->kind == FVI_HISTORY_SPACE_SOME)
            z[l] = x[B->columns.row[l]] - from[l];
        if (B->kind != FVI_HISTORY_SPACE_FEW)
            continue;
        double sum = 0;
        for (int e = B->columns.start[l]; e < B->columns.start[l + 1]; e++)
            sum += B->columns.entry[e] * x[B->columns.row[e]];
        z[l] = sum - from[l];
    }
}

/* p -= a S z, where S is B, or the nonzero columns of C */
void fvi_history_space_apply_damping(const fvi_history_space *B, double a, const double *z,
                         double *p)
{
    const fvi_sparse *C = B->C;
    for (size_t l = 0; l < B->r; l++) {
        if (B->kind == FVI_HISTORY_SPACE_ALL) { /* row l is column l */
            double sum = 0;
            for (int e = C->start[l]; e < C->start[l + 1]; e++)
                sum += C->entry[e] * z[C->row[e]];
            p[l] -= a * sum;
        }
        if (B->kind == FVI_HISTORY_SPACE_SOME) {
            const int j = B->columns.row[l];
            for (int e = C->start[j]; e < C->start[j + 1]; e++)
                p[C->row[e]] -= a * C->entry[e] * z[l];
        }
        if (B->kind == FVI_HISTORY_SPACE_FEW)
            for (int e = B->columns.start[l]; e < B->columns.start[l + 1]; e++)
                p[B->columns.row[e]] -= a * B->columns.entry[e] * z[l];
    }
}
//< select-and-apply

/* Compute p -= a C z for s pairs of vectors. Row l of C is its column l. The compiler knows s. Each entry is read once,
 * and the sums of the vectors are independent. */
static inline __attribute__((always_inline)) void
apply_to_all_unknowns(size_t s, const fvi_sparse *C, double a, const double *restrict z, double *restrict p)
{
    const size_t n = C->n;
    for (size_t l = 0; l < n; l++) {
        double sum[FVI_HISTORY_SPACE_STAGES] = { 0 };
        for (int e = C->start[l]; e < C->start[l + 1]; e++) {
            const double entry = C->entry[e], *of = z + C->row[e];
#pragma GCC unroll 8
            for (size_t i = 0; i < s; i++)
                sum[i] += entry * of[i * n];
        }
#pragma GCC unroll 8
        for (size_t i = 0; i < s; i++)
            p[i * n + l] -= a * sum[i];
    }
}

void fvi_history_space_apply_to_stages(const fvi_history_space *B, size_t s, double a, const double *z, double *p)
{
    const size_t n = B->C ? B->C->n : 0;
    if (B->kind == FVI_HISTORY_SPACE_ALL && s == 8)
        apply_to_all_unknowns(8, B->C, a, z, p);
    else if (B->kind == FVI_HISTORY_SPACE_ALL && s == 3)
        apply_to_all_unknowns(3, B->C, a, z, p);
    else
        for (size_t i = 0; i < s; i++)
            fvi_history_space_apply_damping(B, a, z + i * B->r, p + i * n);
}

/* ---- choice of the history numbers ---- */

static int allocate_columns(size_t r, size_t count, fvi_history_space *B)
{
    B->r = r;
    return fvi_sparse_alloc(r, count, &B->columns);
}

void fvi_history_space_free(fvi_history_space *B)
{
    fvi_sparse_free(&B->columns);
}

/* Select the unknowns that C couples. */
static int select_damped_unknowns(const fvi_sparse *C, fvi_history_space *B)
{
    size_t r = 0;
    for (size_t j = 0; j < C->n; j++)
        r += C->start[j + 1] > C->start[j];
    if (allocate_columns(r, r, B))
        return FVI_ENOMEM;
    B->kind = FVI_HISTORY_SPACE_SOME;
    for (size_t j = 0, l = 0; j < C->n; j++)
        if (C->start[j + 1] > C->start[j])
            B->columns.row[l++] = (int)j;
    return FVI_SUCCESS;
}

static int is_zero(size_t n, const double *D, double noise)
{
    for (size_t i = 0; i < n; i++)
        if (!(fabs(D[i]) <= noise))
            return 0;
    return 1;
}

/* Scale D by powers of two so that its diagonal is between 1/4 and 4, because a small damper beside a large one must
 * not count as a rounding error. If a diagonal entry is not positive, its row must be zero. Return 1, or 0 if such a
 * row is not zero. */
static int scale_diagonal(size_t r, double *D, double *unit)
{
    for (size_t i = 0; i < r; i++) {
        const double size = D[i * r + i];
        unit[i] = size > 0 ? ldexp(1, ilogb(size) / 2) : 1;
        if (!(size > 0) && !is_zero(r, D + i * r, 0))
            return 0;
    }
    for (size_t i = 0; i < r; i++)
        for (size_t j = 0; j < r; j++)
            D[i * r + j] = D[i * r + j] / unit[i] / unit[j];
    return 1;
}

//> rank
/* Compute C = B B^T by Cholesky elimination with the largest remaining diagonal entry as the pivot, until the remainder
 * is zero. D holds the entries of C for the selected unknowns, with a diagonal of at most 4. The columns of B are
 * written to `out`, r numbers each. If C is not positive semidefinite, more than rounding errors remain when no
 * diagonal entry is positive. Return the rank, or -1 in this case. */
static int factorise_dense(size_t r, double *D, double *out)
{
    const double noise = (double)r * 8 * DBL_EPSILON * 4;
    for (size_t rank = 0;; rank++, out += r) {
        size_t pivot = 0;
        for (size_t i = 0; i < r; i++)
            if (D[i * r + i] > D[pivot * r + pivot])
                pivot = i;
        const double top = D[pivot * r + pivot];
        if (!(top > noise) || rank == r)
            return is_zero(r * r, D, noise) ? (int)rank : -1;
        for (size_t i = 0; i < r; i++)
            out[i] = D[i * r + pivot] / sqrt(top);
        for (size_t i = 0; i < r; i++)
            for (size_t j = 0; j < r && out[i] != 0; j++)
                D[i * r + j] -= out[i] * out[j];
    }
}
//< rank

/* Return the entries of C for the unknowns in B. */
static double *copy_dense(const fvi_history_space *B)
{
    const size_t r = B->r;
    double *D =
        calloc(2 * r * r + r, sizeof *D); /* with room for the columns of B and for the scales */
    for (size_t l = 0; D && l < r; l++)
        for (size_t i = 0; i < r; i++)
            D[l * r + i] = fvi_sparse_entry(B->C, (size_t)B->columns.row[i],
                                            (size_t)B->columns.row[l]);
    return D;
}

/* Replace the unknowns in B by `rank` dense columns, and leave out their zeros. */
static int keep_columns(size_t rank, const double *dense, fvi_history_space *B)
{
    fvi_history_space few = { .C = B->C, .kind = FVI_HISTORY_SPACE_FEW };
    if (allocate_columns(rank, rank * B->r, &few))
        return FVI_ENOMEM;
    for (size_t l = 0; l < rank; l++) {
        int e = few.columns.start[l];
        for (size_t i = 0; i < B->r; i++)
            if (dense[l * B->r + i] != 0) {
                few.columns.row[e] = B->columns.row[i];
                few.columns.entry[e++] = dense[l * B->r + i];
            }
        few.columns.start[l + 1] = e;
    }
    fvi_history_space_free(B);
    *B = few;
    return FVI_SUCCESS;
}

/* Test whether a small C is positive semidefinite. If its rank is so low that B^T x is cheaper, use B^T x. */
static int find_low_rank(fvi_history_space *B)
{
    const size_t r = B->r;
    double *D = copy_dense(B);
    if (!D)
        return FVI_ENOMEM;
    double *columns = D + r * r, *unit = columns + r * r;
    const int rank = scale_diagonal(r, D, unit) ? factorise_dense(r, D, columns) : -1;
    int status = rank < 0 ? FVI_EDOM : FVI_SUCCESS;
    if (rank >= 0 && 2 * (size_t)rank <= r) {
        for (size_t i = 0; i < (size_t)rank * r; i++)
            columns[i] *= unit[i % r];
        status = keep_columns((size_t)rank, columns, B);
    }
    free(D);
    return status;
}

/* Test whether a large C is positive semidefinite. The test is whether C + 1e-9 M, scaled to the size of
 * C, is positive definite. */
static int check_semidefinite(const fvi_sparse *M, const fvi_sparse *C)
{
    double largest = 0;
    for (size_t i = 0; i < C->n; i++) {
        const double damping = fvi_sparse_entry(C, i, i);
        if (damping < 0)
            return FVI_EDOM;
        largest = larger(largest, damping / fvi_sparse_entry(M, i, i));
    }
    const fvi_sparse *const terms[] = { M, C };
    const double a[] = { 1e-9 * largest, 1 };
    fvi_sparse A;
    fvi_factors *f;
    int status = fvi_sparse_add(2, terms, a, &A);
    if (status)
        return status;
    status = fvi_factors_alloc(fvi_choose_factorisation(&A), &A, &f);
    if (!status)
        fvi_factors_free(f);
    return status == FVI_ESING ? FVI_EDOM : status;
}

int fvi_history_space_find(const fvi_sparse *M, const fvi_sparse *C,
                        fvi_history_space *B)
{
    *B = (fvi_history_space){ .C = C };
    if (!C || C->start[C->n] == 0)
        return FVI_SUCCESS;
    int status = select_damped_unknowns(C, B);
    if (!status)
        status = B->r <= SMALL ? find_low_rank(B) : check_semidefinite(M, C);
    if (!status && B->kind == FVI_HISTORY_SPACE_SOME && B->r == C->n) {
        fvi_history_space_free(B);
        B->kind = FVI_HISTORY_SPACE_ALL;
    }
    return status;
}

int fvi_history_space_of_row(const fvi_sparse *C, const double *row, fvi_history_space *B)
{
    fvi_history_space all = { .C = C, .r = C->n };
    if (C->start[C->n] == 0) { /* the row is zero */
        *B = (fvi_history_space){ .C = C };
        return FVI_SUCCESS;
    }
    int status = select_damped_unknowns(C, &all);
    double *dense = status ? NULL : malloc(all.r * sizeof *dense);
    for (size_t l = 0; dense && l < all.r; l++)
        dense[l] = row[all.columns.row[l]];
    if (dense)
        status = keep_columns(1, dense, &all);
    else
        status = FVI_ENOMEM;
    free(dense);
    *B = all;
    return status;
}
