/* src/matrices/sparse.c -- Symmetric matrices in compressed columns.   [H 27] */
#include "sparse.h"

#include "system/fail.h"

#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

int fvi_sparse_alloc(size_t n, size_t count, fvi_sparse *A)
{
    *A = (fvi_sparse){ .n = n,
                       .start = calloc(n + 1, sizeof *A->start),
                       .row = malloc((count + 1) * sizeof *A->row),
                       .entry = malloc((count + 1) * sizeof *A->entry) };
    if (A->start && A->row && A->entry)
        return FVI_SUCCESS;
    fvi_sparse_free(A);
    return FVI_ENOMEM;
}

void fvi_sparse_free(fvi_sparse *A)
{
    free(A->start);
    free(A->row);
    free(A->entry);
    *A = (fvi_sparse){ 0 };
}

//> product
void fvi_sparse_multiply(const fvi_sparse *A, const double *x, double *y)
{
    for (size_t j = 0; j < A->n; j++) { /* column j is row j */
        double sum = 0;
        for (int e = A->start[j]; e < A->start[j + 1]; e++)
            sum += A->entry[e] * x[A->row[e]];
        y[j] = sum;
    }
}
//< product

double fvi_sparse_entry(const fvi_sparse *A, size_t i, size_t j)
{
    for (int e = A->start[j]; e < A->start[j + 1]; e++)
        if ((size_t)A->row[e] == i)
            return A->entry[e];
    return 0;
}

/* Sort the triplets by columns, in the order of the list within a column. start[j] is the beginning of column j in A,
 * before equal rows are summed. */
static void sort_by_columns(size_t count, const fvi_triplet *t, fvi_sparse *A)
{
    for (size_t l = 0; l < count; l++)
        A->start[t[l].column + 1]++;
    for (size_t j = 0; j < A->n; j++)
        A->start[j + 1] += A->start[j];
    for (size_t l = 0; l < count; l++) {
        const int at = A->start[t[l].column]++;
        A->row[at] = t[l].row;
        A->entry[at] = t[l].entry;
    }
    for (size_t j = A->n; j > 0; j--) /* each start has moved up to the next column */
        A->start[j] = A->start[j - 1];
    A->start[0] = 0;
}

/* Sort the rows of a column by insertion, because columns are short, and sum equal rows in the order of the list.
 * Return the number of rows that remain. */
static int order_column(int count, int *row, double *entry)
{
    int kept = 0;
    for (int e = 0; e < count; e++) {
        const int r = row[e];
        const double value = entry[e];
        int at = kept;
        while (at > 0 && row[at - 1] > r)
            at--;
        if (at > 0 && row[at - 1] == r) {
            entry[at - 1] += value;
            continue;
        }
        const size_t above = (size_t)(kept++ - at);
        memmove(row + at + 1, row + at, above * sizeof *row);
        memmove(entry + at + 1, entry + at, above * sizeof *entry);
        row[at] = r;
        entry[at] = value;
    }
    return kept;
}

//> sum
int fvi_sparse_assemble(size_t n, size_t count, const fvi_triplet *triplets,
                   fvi_sparse *A)
{
    fvi_sparse whole;
    if (!A || (!triplets && count > 0))
        FVI_FAIL("null pointer", FVI_EFAULT);
    if (n < 1 || n >= INT_MAX || count >= INT_MAX)
        FVI_FAIL("a matrix has 1 to 2^31 rows and entries", FVI_EINVAL);
    for (size_t l = 0; l < count; l++)
        if (triplets[l].row < 0 || (size_t)triplets[l].row >= n
            || triplets[l].column < 0 || (size_t)triplets[l].column >= n
            || !isfinite(triplets[l].entry))
            FVI_FAIL("a triplet is outside of the matrix, or not finite", FVI_EDOM);
    if (fvi_sparse_alloc(n, count, &whole))
        FVI_FAIL("no memory for the matrix", FVI_ENOMEM);
    sort_by_columns(count, triplets, &whole);
    int to = 0;
    for (size_t j = 0; j < n; j++) {
        const int from = whole.start[j];
        const int kept = order_column(whole.start[j + 1] - from,
                                      whole.row + from, whole.entry + from);
        memmove(whole.row + to, whole.row + from,
                (size_t)kept * sizeof *whole.row);
        memmove(whole.entry + to, whole.entry + from,
                (size_t)kept * sizeof *whole.entry);
        whole.start[j] = to;
        to += kept;
    }
    whole.start[n] = to;
    *A = whole;
    return FVI_SUCCESS;
}
//< sum

/* The loop visits the entries column by column, with ascending rows. So the mirror entry (j, i) in column i is the next
 * one after the last visit to column i. */
int fvi_sparse_is_symmetric(const fvi_sparse *A, int *place)
{
    int *next = malloc(A->n * sizeof *next), status = FVI_SUCCESS;
    if (!next)
        return FVI_ENOMEM;
    memcpy(next, A->start, A->n * sizeof *next);
    for (size_t j = 0; !status && j < A->n; j++)
        for (int e = A->start[j]; !status && e < A->start[j + 1]; e++) {
            const int i = A->row[e], at = next[i]++;
            if (at >= A->start[i + 1] || A->row[at] != (int)j
                || A->entry[at] != A->entry[e] || !isfinite(A->entry[e])) {
                status = FVI_EDOM;
                *place = e;
            }
        }
    free(next);
    return status;
}

/* Return the smallest remaining row of column j in all matrices; the next entry of matrix l is at[l]. Return INT_MAX if
 * no row remains. */
static int next_row_of_columns(size_t j, size_t count, const fvi_sparse *const *A, const int *at)
{
    int row = INT_MAX;
    for (size_t l = 0; l < count; l++)
        if (at[l] < A[l]->start[j + 1] && A[l]->row[at[l]] < row)
            row = A[l]->row[at[l]];
    return row;
}

/* The rows of a column increase in each matrix, so the columns are merged. */
int fvi_sparse_union(size_t n, size_t count, const fvi_sparse *const *A, int **place, int **start, int **row)
{
    size_t most = 0;
    for (size_t l = 0; l < count; l++)
        most += (size_t)A[l]->start[n];
    int *at = malloc((count + 1) * sizeof *at), to = 0;
    *place = malloc((most + 1) * sizeof **place);
    *start = calloc(n + 1, sizeof **start);
    *row = malloc((most + 1) * sizeof **row);
    const int status = at && *place && *start && *row && most < INT_MAX ? FVI_SUCCESS : FVI_ENOMEM;
    for (size_t j = 0; !status && j < n; j++) {
        for (size_t l = 0; l < count; l++)
            at[l] = A[l]->start[j];
        for (int next; (next = next_row_of_columns(j, count, A, at)) < INT_MAX; to++) {
            int *of = *place;
            for (size_t l = 0; l < count; of += A[l++]->start[n])
                if (at[l] < A[l]->start[j + 1] && A[l]->row[at[l]] == next)
                    of[at[l]++] = to;
            (*row)[to] = next;
        }
        (*start)[j + 1] = to;
    }
    free(at);
    return status;
}

/* Remove the zeros off the diagonal, because a stored zero would widen the band. */
static void remove_zeros(fvi_sparse *A)
{
    int to = 0;
    for (int j = 0, e = 0; j < (int)A->n; j++) {
        for (; e < A->start[j + 1]; e++) {
            if (A->entry[e] == 0 && A->row[e] != j)
                continue;
            A->row[to] = A->row[e];
            A->entry[to++] = A->entry[e];
        }
        A->start[j + 1] = to;
    }
}

/* Add matrices that are not NULL. */
static int add_terms(size_t n, size_t count, const fvi_sparse *const *A, const double *a, fvi_sparse *sum)
{
    int *place;
    *sum = (fvi_sparse){ .n = n };
    int status = fvi_sparse_union(n, count, A, &place, &sum->start, &sum->row);
    if (!status)
        sum->entry = calloc((size_t)sum->start[n] + 1, sizeof *sum->entry);
    if (sum->entry) {
        const int *to = place;
        for (size_t l = 0; l < count; l++)
            for (int e = 0; e < A[l]->start[n]; e++)
                sum->entry[*to++] += a[l] * A[l]->entry[e];
        remove_zeros(sum);
    } else {
        fvi_sparse_free(sum);
        status = FVI_ENOMEM;
    }
    free(place);
    return status;
}

int fvi_sparse_add(size_t count, const fvi_sparse *const *A, const double *a,
                   fvi_sparse *sum)
{
    size_t terms = 0, n = 0;
    const fvi_sparse **kept = malloc((count + 1) * sizeof *kept);
    double *factor = malloc((count + 1) * sizeof *factor);
    int status = kept && factor ? FVI_SUCCESS : FVI_ENOMEM;
    for (size_t l = 0; !status && l < count; l++) {
        n = A[l] ? A[l]->n : n;
        if (!A[l] || a[l] == 0)
            continue;
        kept[terms] = A[l];
        factor[terms++] = a[l];
    }
    if (!status)
        status = add_terms(n, terms, kept, factor, sum);
    free(kept);
    free(factor);
    return status;
}

size_t fvi_sparse_half_band(const fvi_sparse *A)
{
    size_t width = 0;
    for (size_t j = 0; j < A->n; j++)
        if (A->start[j + 1] > A->start[j]) {
            const size_t last = (size_t)A->row[A->start[j + 1] - 1];
            if (last > j && last - j > width)
                width = last - j;
        }
    return width;
}
