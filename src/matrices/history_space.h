/* src/matrices/history_space.h -- Choose the numbers of a structure that have a history.          [H 27] */
#ifndef FVI_HISTORY_SPACE_H
#define FVI_HISTORY_SPACE_H

#include "sparse.h"

/* The numbers that have a history. (27.4) */
typedef enum {
    FVI_HISTORY_SPACE_EMPTY, /* none: there is no damping */
    FVI_HISTORY_SPACE_ALL,   /* all of x */
    FVI_HISTORY_SPACE_SOME,  /* the x_i that C couples: B selects them */
    FVI_HISTORY_SPACE_FEW      /* B^T x with C = B B^T */
} fvi_history_space_kind;

/* The factors of C = S B^T. The r columns of B are stored like the columns of a matrix. For SOME only the rows are
 * used, one for each column; for ALL nothing is stored. */
typedef struct {
    const fvi_sparse *C;
    fvi_history_space_kind kind;
    size_t r;
    fvi_sparse columns;
} fvi_history_space;

/* fvi_history_space_find -- Choose the history numbers of C, see fvi_structure_alloc. C may be NULL; M has a positive
 * diagonal. Free the result with fvi_history_space_free, also after an error. Return FVI_SUCCESS; FVI_EDOM if C is not
 * positive semidefinite; FVI_ENOMEM. */
int fvi_history_space_find(const fvi_sparse *M, const fvi_sparse *C,
                        fvi_history_space *result);

/* fvi_history_space_of_row -- Make the factors of C = row^T row. The history has one number, the product of the row and
 * x. Return FVI_SUCCESS or FVI_ENOMEM. */
int fvi_history_space_of_row(const fvi_sparse *C, const double *row,
                             fvi_history_space *result);

/* fvi_history_space_gather -- Compute z = B^T x - from, r numbers. */
void fvi_history_space_gather(const fvi_history_space *B, const double *x,
                           const double *from, double *z);

/* fvi_history_space_apply_damping -- Compute p -= a S z. */
void fvi_history_space_apply_damping(const fvi_history_space *B, double a, const double *z,
                         double *p);

/* fvi_history_space_apply_to_stages -- Compute p -= a S z for s pairs of vectors, 1 <= s <= FVI_HISTORY_SPACE_STAGES,
 * stored one after the other. The result is the same to the last bit as for single vectors. */
enum { FVI_HISTORY_SPACE_STAGES = 8 };
void fvi_history_space_apply_to_stages(const fvi_history_space *B, size_t s, double a, const double *z, double *p);

void fvi_history_space_free(fvi_history_space *B);

#endif
