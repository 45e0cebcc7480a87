/* src/fvi/structures.h -- Structures: linear systems with sparse matrices.                               [H 27]
 *
 *     M x'' + C D^{2 alpha} x + K x = F(t),     x in R^d                                               (27.1)
 *
 * M, K and C are symmetric matrices. There may be several matrices C, each with its own kernel and past.
 * fvi_sparse_assemble adds up element matrices, and fvi_sparse_read reads a matrix from a file. fvi_structure_system
 * makes a system of them for the methods that take matrices: fvi_fractional, fvi_cq2_shifted, fvi_cq_bdf2,
 * fvi_cq2_midpoint, and, with high order, fvi_lobatto_d2 to fvi_lobatto_d8 and fvi_variable_step.
 *
 *     fvi_structure *structure;
 *     if (fvi_structure_alloc(&M, &K, &C, &structure, NULL) == FVI_SUCCESS)
 *         system = fvi_structure_system(structure); */
#ifndef FVI_STRUCTURES_H
#define FVI_STRUCTURES_H

#include "dampers.h"
#include "system.h"

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(default)

/* fvi_sparse -- a symmetric n by n matrix in compressed columns, with both triangles.
 *
 *   start  n + 1 numbers: column j has the places start[j], ..., start[j + 1] - 1 of row and entry
 *   row    the row of each entry, from 0; rows increase within a column
 *   entry  the entries
 *
 * If the caller fills in the arrays without the functions below, the caller frees them. */
//> sparse
typedef struct fvi_sparse {
    size_t n;
    int *start, *row;
    double *entry;
} fvi_sparse;
//< sparse

/* fvi_triplet -- a number that is added to entry (row, column) of a matrix. Rows and columns count from 0. */
typedef struct {
    int row, column;
    double entry;
} fvi_triplet;

/* fvi_sparse_assemble -- Add up a list of triplets to a matrix.
 *
 *   n      number of rows and of columns, 1 <= n < 2^31 - 1
 *   count, triplets  number of triplets, < 2^31 - 1, and the triplets, in any order. An entry may occur many times. The
 *          list has both triangles. An entry whose sum is zero stays in the pattern
 *   A      output; free it with fvi_sparse_free
 *
 *     const fvi_triplet spring[] = { { 0, 0, k }, { 0, 1, -k }, { 1, 0, -k }, { 1, 1, k } };
 *     fvi_sparse K;
 *     status = fvi_sparse_assemble(2, 4, spring, &K);
 *
 * The function adds the triplets of an entry in the order of the list. So if all element matrices are symmetric to the
 * last bit, the sum is, too. Cost O(n + count), and for each column up to the square of its length, because columns are
 * short.
 * Returns FVI_SUCCESS; FVI_EFAULT if a pointer is NULL; FVI_EINVAL if n or count is out of range; FVI_EDOM if a row or
 * a column is not in 0 ... n - 1, or an entry is not finite; FVI_ENOMEM. On error *A is untouched. */
int fvi_sparse_assemble(size_t n, size_t count, const fvi_triplet *triplets,
                   fvi_sparse *A);

/* fvi_misread -- an error in a file.
 *
 *   line    number of the line, from 1; 0 if the file cannot be read at all, or ends before its size
 *   reason  a static text
 *   column  column of the line, from 1; 0 if the line as a whole is wrong */
typedef struct {
    size_t line;
    const char *reason;
    size_t column;
} fvi_misread;

/* fvi_sparse_read -- Read a symmetric matrix from a file in the Matrix Market format.
 *
 *   file   its name. The first line is "%%MatrixMarket matrix coordinate real symmetric", or the same with `integer`
 *          for `real`, or with `general` for `symmetric`. A symmetric file gives each entry in one of the two
 *          triangles, not in both. In a general file entry (i, j) must equal entry (j, i) to the last bit
 *   A      output; free it with fvi_sparse_free
 *   wrong  output after FVI_EDOM, or NULL
 *
 * The function refuses, and names the line: a text that is no decimal number, a number that is not finite, a NUL byte,
 * a pattern without numbers, a dense array, an entry that occurs twice, a row or column beyond the size, too few or too
 * many entries, a matrix that is not square or not symmetric. The decimal point is '.' under every locale.
 * Returns FVI_SUCCESS; FVI_EFAULT if file or A is NULL; FVI_EDOM if the file is refused; FVI_ENOMEM. On error *A is
 * untouched. The error handler is not called for FVI_EDOM. */
int fvi_sparse_read(const char *file, fvi_sparse *A, fvi_misread *wrong);

/* fvi_sparse_multiply -- Compute y = A x, n numbers each. y must not be x. Nothing is checked. Cost: one product for
 * each entry. */
void fvi_sparse_multiply(const fvi_sparse *A, const double *x, double *y);

/* fvi_sparse_free -- Free the arrays. A zeroed matrix is allowed. */
void fvi_sparse_free(fvi_sparse *A);

/* fvi_structure -- the matrices of a system, with the factors and functions that a run needs. */
typedef struct fvi_structure fvi_structure;

/* fvi_structure_alloc -- Prepare a system with three matrices.
 *
 *   M      symmetric, positive definite
 *   K      symmetric. A run whose steps solve with m M + c C + k K does not start if this sum is not positive definite
 *          (FVI_ESING)
 *   C      symmetric, positive semidefinite; NULL: no damping
 *   structure  output; free it with fvi_structure_free. It points to the matrices, so they must outlive it
 *   fault  output, or NULL: the matrix of an error, 'M', 'K' or 'C'; 0 if the error is of no single matrix
 *
 * The history of a run has only the unknowns with an entry in C. If these are up to 512 unknowns, and the rank of C is
 * at most half their number, C = B B^T and the history has B^T x, which is shorter. (27.4)
 * Cost: one factorisation of M, and one of C if more than 512 unknowns have an entry in C.
 * Returns FVI_SUCCESS; FVI_EFAULT if M, K or structure is NULL; FVI_EINVAL if the sizes differ; FVI_EDOM if a matrix is
 * not symmetric to the last bit or has an entry that is not finite, if a diagonal entry of M is not positive, or if C
 * is not positive semidefinite; FVI_ESING if M is not positive definite; FVI_ENOMEM. On error *structure is untouched.
 *
 * Lack of memory. CHOLMOD reports it, and all its memory is freed. Two libraries that CHOLMOD calls do not report it.
 * Both are called only for factors with more than 250 entries in a column, as large frames in space have. METIS prints
 * lines, also on standard output, and does not free its memory; the factors are then made in the order of AMD. libgomp,
 * of which CHOLMOD uses one thread, prints a line and ends the process if it cannot get some 200 bytes. A test with 667
 * limits of memory saw neither, because both are called while memory is left. */
int fvi_structure_alloc(const fvi_sparse *M, const fvi_sparse *K,
                        const fvi_sparse *C, fvi_structure **structure,
                        char *fault);

/* fvi_structure_alloc_dampers -- Prepare a system with several dampers instead of C:
 *
 *     M x'' + sum_j C_j L_j(D) (x - x_0) + K x = F(t)                                                   (27.11)
 *
 *   count     number of dampers, >= 1
 *   damper    for each damper (dampers.h) its kernel L_j, its past, and its C_j: a symmetric positive semidefinite
 *             matrix, or a row, and then C_j = row^T row. The dampers must outlive the structure
 *   structure  output; free it with fvi_structure_free
 *   error     output, or NULL. Its field is "M", "K" or "damper"; for "damper" its index is the number of the damper,
 *             from 0
 *
 * The history of damper j has only the unknowns with an entry in C_j, as above.
 *
 *     const fvi_damper dampers[] = { { .matrix = &isolators, .kernel = &springpot },
 *                                    { .of = fvi_elongation_row(roof), .kernel = &dashpot } };
 *     fvi_structure_alloc_dampers(&M, &K, 2, dampers, &structure, &error);
 *     fvi_system system = fvi_structure_system(structure);
 *
 * Returns as fvi_structure_alloc; FVI_EINVAL if count == 0; FVI_EFAULT for a damper without a kernel (the start of a
 * run checks the kernel itself); FVI_EUNSUP for an elongation that is not linear. */
int fvi_structure_alloc_dampers(const fvi_sparse *M, const fvi_sparse *K, size_t count,
                                const fvi_damper *damper, fvi_structure **structure,
                                fvi_error *error);

/* fvi_structure_system -- Return the system, without a force. If there are several dampers, they are in its mechanism.
 * The system points to the structure. Runs in several threads may share it, but only one thread at a time may compute
 * energies. */
fvi_system fvi_structure_system(const fvi_structure *structure);

/* fvi_structure_solver_name -- Return the name of the solver for equations with m M + c C + k K, a static text:
 * "diagonal", "band" for a half bandwidth of up to 8, or "CHOLMOD", which factorises in an order that keeps the factors
 * sparse. Return "" if there is no memory.
 *
 *   m, c, k  only whether they are zero has an effect */
const char *fvi_structure_solver_name(const fvi_structure *structure, double m,
                                 double c, double k);

/* fvi_structure_free -- Free the structure, but not its matrices. NULL is allowed. */
void fvi_structure_free(fvi_structure *structure);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
