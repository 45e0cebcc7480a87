/* src/matrices/sparse_union.c -- Compute the pattern of a sum of sparse matrices.        [H 27] */
#include "sparse.h"

#include <stdlib.h>
#include <string.h>

/* Write the rows of column j of the sum to list, in order. mark[i] is j + 1 if row i is in the list.
 * Return the number of rows. */
static size_t column_of_sum(size_t count, const fvi_sparse *const *A, size_t j,
                            size_t *mark, int *list)
{
    size_t found = 0;
    for (size_t l = 0; l < count; l++)
        for (int e = A[l]->start[j]; e < A[l]->start[j + 1]; e++) {
            const int row = A[l]->row[e];
            if (mark[row] == j + 1)
                continue;
            mark[row] = j + 1;
            size_t at = found++;
            for (; at > 0 && list[at - 1] > row; at--)
                list[at] = list[at - 1];
            list[at] = row;
        }
    return found;
}

/* Write the positions of the entries of column j. The rows of this column begin at `first` in the sum. */
static void merge_column(size_t count, const fvi_sparse *const *A, size_t j, int first,
                         const int *rows, int *const *place)
{
    for (size_t l = 0; l < count; l++)
        for (int at = 0, e = A[l]->start[j]; e < A[l]->start[j + 1]; e++) {
            while (rows[at] != A[l]->row[e])
                at++;
            place[l][e] = first + at;
        }
}

int fvi_sparse_union(size_t count, const fvi_sparse *const *A, int *const *place,
                     int **start, int **row)
{
    const size_t n = A[0]->n;
    size_t most = 0;
    for (size_t l = 0; l < count; l++)
        most += (size_t)A[l]->start[n];
    size_t *mark = calloc(n, sizeof *mark);
    int *list = malloc(n * sizeof *list);
    *start = calloc(n + 1, sizeof **start);
    *row = most <= (size_t)1 << 30 ? malloc((most + 1) * sizeof **row) : NULL;
    const int status = mark && list && *start && *row ? FVI_SUCCESS : FVI_ENOMEM;
    for (size_t j = 0; !status && j < n; j++) {
        const size_t found = column_of_sum(count, A, j, mark, list);
        const int first = (*start)[j];
        memcpy(*row + first, list, found * sizeof *list);
        (*start)[j + 1] = first + (int)found;
        merge_column(count, A, j, first, list, place);
    }
    free(mark);
    free(list);
    return status;
}
