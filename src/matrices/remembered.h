/* src/matrices/remembered.h -- What a damping remembers.                [Chapter 27] */
#ifndef FVI_REMEMBERED_H
#define FVI_REMEMBERED_H

#include "sparse.h"

/* Which numbers. (27.4) */
typedef enum {
    FVI_REMEMBER_NOTHING, /* there is no damping */
    FVI_REMEMBER_ALL,     /* x itself */
    FVI_REMEMBER_SOME,    /* the x_i that C touches: B picks them out */
    FVI_REMEMBER_FEW      /* B^T x, C = B B^T */
} fvi_remember_kind;

/* C = S B^T. The r columns of B stand as those of a matrix do; of SOME only the rows are read,
 * one for each column, and of ALL nothing is there. */
typedef struct {
    const fvi_sparse *C;
    fvi_remember_kind kind;
    size_t r;
    fvi_sparse columns;
} fvi_remembered;

/* fvi_remembered_find -- see fvi_structure_alloc; C may be NULL, M has a positive diagonal.
 * Free it with fvi_remembered_free, whatever is returned.
 * Returns FVI_SUCCESS; FVI_EDOM if C is negative; FVI_ENOMEM. */
int fvi_remembered_find(const fvi_sparse *M, const fvi_sparse *C,
                        fvi_remembered *result);

/* fvi_remembered_gather -- z = B^T x - from, r numbers. */
void fvi_remembered_gather(const fvi_remembered *B, const double *x,
                           const double *from, double *z);

/* fvi_remembered_damp -- p -= a S z. */
void fvi_remembered_damp(const fvi_remembered *B, double a, const double *z,
                         double *p);

void fvi_remembered_free(fvi_remembered *B);

#endif
