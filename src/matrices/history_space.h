/* src/matrices/history_space.h -- Which numbers have a history.          [H 27] */
#ifndef FVI_HISTORY_SPACE_H
#define FVI_HISTORY_SPACE_H

#include "sparse.h"

/* Which numbers. (27.4) */
typedef enum {
    FVI_HISTORY_SPACE_EMPTY, /* there is no damping */
    FVI_HISTORY_SPACE_ALL,     /* x itself */
    FVI_HISTORY_SPACE_SOME,    /* the x_i that C touches: B picks them out */
    FVI_HISTORY_SPACE_FEW      /* B^T x, C = B B^T */
} fvi_history_space_kind;

/* C = S B^T. The r columns of B stand as those of a matrix do; of SOME only the rows are read,
 * one for each column, and of ALL nothing is there. */
typedef struct {
    const fvi_sparse *C;
    fvi_history_space_kind kind;
    size_t r;
    fvi_sparse columns;
} fvi_history_space;

/* fvi_history_space_find -- see fvi_structure_alloc; C may be NULL, M has a positive diagonal.
 * Free it with fvi_history_space_free, whatever is returned.
 * Returns FVI_SUCCESS; FVI_EDOM if C is negative; FVI_ENOMEM. */
int fvi_history_space_find(const fvi_sparse *M, const fvi_sparse *C,
                        fvi_history_space *result);

/* fvi_history_space_of_row -- C = row^T row: the history has one number, the product of the row and
 * x. Returns FVI_SUCCESS or FVI_ENOMEM. */
int fvi_history_space_of_row(const fvi_sparse *C, const double *row,
                             fvi_history_space *result);

/* fvi_history_space_gather -- z = B^T x - from, r numbers. */
void fvi_history_space_gather(const fvi_history_space *B, const double *x,
                           const double *from, double *z);

/* fvi_history_space_apply_damping -- p -= a S z. */
void fvi_history_space_apply_damping(const fvi_history_space *B, double a, const double *z,
                         double *p);

/* fvi_history_space_apply_to_stages -- the same of s vectors, 1 to FVI_HISTORY_SPACE_STAGES, one behind the other; to the
 * bit. */
enum { FVI_HISTORY_SPACE_STAGES = 8 };
void fvi_history_space_apply_to_stages(const fvi_history_space *B, size_t s, double a, const double *z, double *p);

void fvi_history_space_free(fvi_history_space *B);

#endif
