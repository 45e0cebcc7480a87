/* src/fvi/structures.h -- Sparse matrices, and systems of them.          [H 27]
 *
 *     M x'' + C D^{2 alpha} x + K x = F(t),     x in R^d                  (27.1)
 *
 * with symmetric matrices M, K and C, or with several C's, each with a kernel and a past of its
 * own. Element matrices are summed to them by
 * fvi_sparse_assemble, files are read by fvi_sparse_read; fvi_structure_system is then a system
 * for the methods that take matrices: fvi_fractional, fvi_cq2_shifted, fvi_cq_bdf2, fvi_cq2_midpoint, and
 * for high order fvi_lobatto_d2 to d8 and fvi_variable_step. */
#ifndef FVI_STRUCTURES_H
#define FVI_STRUCTURES_H

#include "dampers.h"
#include "system.h"

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(default)

/* fvi_sparse -- a symmetric n by n matrix in compressed columns, both triangles.
 *
 *   start  n + 1 numbers: column j is at start[j], ..., start[j + 1] - 1 of
 *   row    the rows, which increase in a column, and of
 *   entry  the entries
 *
 * Whoever fills it in without the functions below frees it himself. */
//> sparse
typedef struct fvi_sparse {
    size_t n;
    int *start, *row;
    double *entry;
} fvi_sparse;
//< sparse

/* fvi_triplet -- what is to be added to entry (row, column), both from 0. */
typedef struct {
    int row, column;
    double entry;
} fvi_triplet;

/* fvi_sparse_assemble -- the matrix that a list of triplets sums up to.
 *
 *   n      rows and columns, 1 <= n < 2^31
 *   count  how many triplets, < 2^31; in any order, an entry may be met many times, and
 *          both triangles are given. What sums up to zero stays in the pattern
 *   A      output; free it with fvi_sparse_free
 *
 * Entries are summed in the order of the list: of element matrices that are symmetric to
 * the last bit the sum is, too. Cost O(n + count), and up to the square of the
 * length of a column for each: columns are short.
 * Returns FVI_SUCCESS; FVI_EFAULT if a pointer is NULL; FVI_EINVAL if n or count is out of
 * range; FVI_EDOM if a row or a column is not in 0 ... n - 1, or an entry not finite;
 * FVI_ENOMEM. On error *A is untouched. */
int fvi_sparse_assemble(size_t n, size_t count, const fvi_triplet *triplets,
                   fvi_sparse *A);

/* fvi_misread -- what is wrong in a file: in which line, from 1, or 0 if the file cannot be
 * read at all or ends before its size; why, a static text; and in which column of the line,
 * from 1, or 0 if the line as a whole is wrong. */
typedef struct {
    size_t line;
    const char *reason;
    size_t column;
} fvi_misread;

/* fvi_sparse_read -- a symmetric matrix from a file in Matrix Market's format.
 *
 *   file   its name. The first line is "%%MatrixMarket matrix coordinate real symmetric",
 *          or with `integer` for `real`, or with `general` for `symmetric`; of a symmetric
 *          one either triangle may be given, but no entry twice in both; of a general one,
 *          entry (i, j) must be entry (j, i) to the last bit
 *   A      output; free it with fvi_sparse_free
 *   wrong  output after FVI_EDOM; may be NULL
 *
 * Refused with the line: what is no decimal number, or not finite, a NUL byte, a pattern without numbers, a
 * dense array, an entry that stands twice, a row or column beyond the size, too few entries
 * or too many, a matrix that is not square or not symmetric. Decimal points are points in
 * any locale that strtod is told of: none is set here.
 * Returns FVI_SUCCESS; FVI_EFAULT if file or A is NULL; FVI_EDOM if the file is refused;
 * FVI_ENOMEM. On error *A is untouched; the error handler is not called for FVI_EDOM. */
int fvi_sparse_read(const char *file, fvi_sparse *A, fvi_misread *wrong);

/* fvi_sparse_multiply -- y = A x, n numbers each, y not x. Nothing is checked. */
void fvi_sparse_multiply(const fvi_sparse *A, const double *x, double *y);

/* fvi_sparse_free -- give the arrays back; a zeroed matrix is allowed. */
void fvi_sparse_free(fvi_sparse *A);

/* fvi_structure -- three matrices, and what a run wants to know of them. */
typedef struct fvi_structure fvi_structure;

/* fvi_structure_alloc -- prepare a system with these matrices.
 *
 *   M      positive definite
 *   K      symmetric. A run that is implicit in it does not start (FVI_ESING) where m M + c C
 *          + k K is not positive definite
 *   C      not negative; NULL: no damping
 *   structure  output; free it with fvi_structure_free. It points to the matrices, which
 *          must outlive it
 *   fault  output, NULL or 'M', 'K' or 'C': which matrix an error speaks of, or 0
 *
 * The history has only the unknowns that C couples. If that are few unknowns (up to 512) and C is of
 * half their number in rank, or less, C = B B^T and the history has B^T x; else the
 * unknowns that C touches. (27.4)
 * Cost: that of one factorisation of M, and of one of C if it touches more than 512
 * unknowns.
 * Returns FVI_SUCCESS; FVI_EFAULT if M, K or structure is NULL; FVI_EINVAL if sizes differ;
 * FVI_EDOM if a matrix is not symmetric to the last bit or has an entry that is not finite,
 * a diagonal entry of M that is not positive, or C is negative; FVI_ESING if M is not
 * positive definite; FVI_ENOMEM. On error *structure is untouched.
 *
 * Where memory ends within CHOLMOD it says so, and nothing is left of it. Two libraries under
 * it do not, and both are asked only for factors with more than 250 entries in a column, which
 * large frames in space have. METIS prints lines of its own, on standard output too, and loses
 * what it had allocated; the factors are then made in AMD's order. libgomp, of which CHOLMOD
 * uses one thread, prints a line and ends the process where it does not get some 200 bytes. Under
 * 667 limits of memory neither happened, for both are asked when there is still room. */
int fvi_structure_alloc(const fvi_sparse *M, const fvi_sparse *K,
                        const fvi_sparse *C, fvi_structure **structure,
                        char *fault);

/* fvi_structure_alloc_dampers -- the same with several dampers instead of C:
 *
 *     M x'' + sum_j C_j L_j(D) (x - x_0) + K x = F(t)                       (27.11)
 *
 *   count     dampers, >= 1
 *   damper    of each its kernel L_j, its past, and C_j: a symmetric matrix that is not
 *             negative, or with a row (dampers.h) row^T row. They must outlive the structure
 *   structure  output, as above
 *   error     output, or NULL. Its field is "M", "K" or "damper", then its index
 *             is that of the damper, from 0
 *
 * The history of a damper has only the unknowns that C_j couples, as above.
 *
 *     const fvi_damper dampers[] = { { .matrix = &isolators, .kernel = &springpot },
 *                                    { .of = fvi_elongation_row(roof), .kernel = &dashpot } };
 *     fvi_structure_alloc_dampers(&M, &K, 2, dampers, &structure, &error);
 *     fvi_system system = fvi_structure_system(structure);
 *
 * Returns as fvi_structure_alloc; FVI_EINVAL for no dampers; FVI_EFAULT for one without a
 * kernel, which a run then checks; FVI_EUNSUP for an elongation that is not linear. */
int fvi_structure_alloc_dampers(const fvi_sparse *M, const fvi_sparse *K, size_t count,
                                const fvi_damper *damper, fvi_structure **structure,
                                fvi_error *error);

/* fvi_structure_system -- the system, without a force; its mechanism holds the dampers if there are
 * several. It points to the structure. Runs in several threads may share it, but for its
 * energies, which are those of one at a time. */
fvi_system fvi_structure_system(const fvi_structure *structure);

/* fvi_structure_solver_name -- how m M + c C + k K is solved with: "diagonal", "band" or
 * "CHOLMOD". A matrix with a half bandwidth up to 8 is eliminated as it stands. CHOLMOD
 * factorises a wider matrix, in an order that keeps the factors sparse.
 *
 *   m, c, k  zero or not is all that counts
 *
 * Returns a static text, "" if there is no memory. */
const char *fvi_structure_solver_name(const fvi_structure *structure, double m,
                                 double c, double k);

/* fvi_structure_free -- give everything back but the matrices. NULL is allowed. */
void fvi_structure_free(fvi_structure *structure);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
