/* src/matrices/sparse.h -- Symmetric matrices in compressed columns.   [H 27]
 *
 * Internal: what the files of this room share. None of these functions calls the error
 * handler. */
#ifndef FVI_SPARSE_H
#define FVI_SPARSE_H

#include <fvi/structures.h>

/* fvi_sparse_alloc -- arrays for n columns with `count` entries, start all zero.
 * Returns FVI_SUCCESS or FVI_ENOMEM. */
int fvi_sparse_alloc(size_t n, size_t count, fvi_sparse *A);

/* fvi_sparse_entry -- A_ij, 0 where nothing is stored.  Cost: of the length of column j. */
double fvi_sparse_entry(const fvi_sparse *A, size_t i, size_t j);

/* fvi_sparse_is_symmetric -- is A finite and symmetric to the last bit?
 * Returns FVI_SUCCESS; FVI_EDOM, *place being an entry that has not its like; FVI_ENOMEM. */
int fvi_sparse_is_symmetric(const fvi_sparse *A, int *place);

/* fvi_sparse_line -- in which line of a file that fvi_sparse_read takes entry (row, column)
 * stands, or with row < 0 the size; 0 if it does not, or there is no memory to look. */
size_t fvi_sparse_line(const char *file, int row, int column);

/* fvi_sparse_add -- sum = a_0 A_0 + a_1 A_1 + ... of `count` matrices of one size, of which some
 * may be NULL; those with a_l = 0 are left out. Zeros off the diagonal are not stored. Free sum
 * with fvi_sparse_free. Returns FVI_SUCCESS or FVI_ENOMEM. */
int fvi_sparse_add(size_t count, const fvi_sparse *const *A, const double *a,
                   fvi_sparse *sum);

/* fvi_sparse_union -- the pattern of the sum of `count` >= 1 matrices of one size.
 *
 *   place       of each matrix a list as long as its entries: entry e stands at place[l][e]
 *   start, row  outputs, as those of a matrix; the caller frees both, also after an error
 *
 * Returns FVI_SUCCESS or FVI_ENOMEM. */
int fvi_sparse_union(size_t count, const fvi_sparse *const *A, int *const *place,
                     int **start, int **row);

/* fvi_sparse_half_band -- the largest |i - j| of a stored entry. */
size_t fvi_sparse_half_band(const fvi_sparse *A);

#endif
