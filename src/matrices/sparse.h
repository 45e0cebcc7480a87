/* src/matrices/sparse.h -- Functions for symmetric matrices in compressed columns.   [H 27]
 *
 * This header is internal to src/matrices. Its functions do not call the error handler. */
#ifndef FVI_SPARSE_H
#define FVI_SPARSE_H

#include <fvi/structures.h>

/* fvi_sparse_alloc -- Allocate the arrays for n columns with `count` entries. `start` is all zero. Return FVI_SUCCESS
 * or FVI_ENOMEM. */
int fvi_sparse_alloc(size_t n, size_t count, fvi_sparse *A);

/* fvi_sparse_entry -- Return A_ij, or 0 if the entry is not stored. Cost: proportional to the length of column j. */
double fvi_sparse_entry(const fvi_sparse *A, size_t i, size_t j);

/* fvi_sparse_is_symmetric -- Test whether A is finite and symmetric to the last bit. Return FVI_SUCCESS; FVI_EDOM, and
 * then *place is an entry that differs from its mirror entry or is not finite; FVI_ENOMEM. */
int fvi_sparse_is_symmetric(const fvi_sparse *A, int *place);

/* fvi_sparse_line -- Return the line of entry (row, column) in a file that fvi_sparse_read accepts; with row < 0 the
 * line of the size. Return 0 if there is no such entry, or if memory is short. */
size_t fvi_sparse_line(const char *file, int row, int column);

/* fvi_sparse_add -- Compute sum = a_0 A_0 + a_1 A_1 + ... of `count` matrices of one size. Matrices that are NULL or
 * have a_l = 0 are left out. Zeros off the diagonal are not stored. Free sum with fvi_sparse_free. Return FVI_SUCCESS
 * or FVI_ENOMEM. */
int fvi_sparse_add(size_t count, const fvi_sparse *const *A, const double *a,
                   fvi_sparse *sum);

/* fvi_sparse_union -- Compute the pattern of the sum of `count` matrices with n rows.
 *
 *   place       output: the positions of all entries in the sum, those of A[0] first, then those of A[1] and so on
 *   start, row  outputs, compressed columns
 *
 * The caller frees the outputs, also after an error. Return FVI_SUCCESS or FVI_ENOMEM. */
int fvi_sparse_union(size_t n, size_t count, const fvi_sparse *const *A, int **place, int **start, int **row);

/* fvi_sparse_half_band -- Return the largest |i - j| of a stored entry. */
size_t fvi_sparse_half_band(const fvi_sparse *A);

#endif
