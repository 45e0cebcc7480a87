/* src/matrices/factors.h -- Equations with a sparse positive definite matrix.
 *                                                               [H 27] */
#ifndef FVI_FACTORS_H
#define FVI_FACTORS_H

#include "sparse.h"

/* How; see fvi_structure_solver_name. */
typedef enum {
    FVI_BY_DIAGONAL,
    FVI_BY_BAND,
    FVI_BY_CHOLMOD
} fvi_way;

/* fvi_way_of -- which one a matrix is solved by. fvi_way_of_band -- one of such a half bandwidth. */
fvi_way fvi_way_of(const fvi_sparse *A);
fvi_way fvi_way_of_band(size_t half_band);

typedef struct fvi_factors fvi_factors;

/* fvi_factors_alloc -- factorise A in this way. A is taken over, and freed here.
 * Returns FVI_SUCCESS; FVI_ESING if A is not positive definite; FVI_ENOMEM. */
int fvi_factors_alloc(fvi_way way, fvi_sparse *A, fvi_factors **factors);

/* fvi_factors_solve -- r becomes A^-1 r, n numbers.  Returns FVI_SUCCESS or FVI_ENOMEM. */
int fvi_factors_solve(fvi_factors *f, double *r);

/* fvi_factors_free -- give everything back. NULL is allowed. */
void fvi_factors_free(fvi_factors *f);

/* ---- cholmod_factors.c ---- */

typedef struct fvi_cholmod fvi_cholmod;

/* fvi_cholmod_alloc -- the factors of A, which is read only here.
 * Returns FVI_SUCCESS; FVI_ESING if A is not positive definite; FVI_ENOMEM. */
int fvi_cholmod_alloc(const fvi_sparse *A, fvi_cholmod **cholmod);

/* fvi_cholmod_solve -- r becomes A^-1 r.  Returns FVI_SUCCESS or FVI_ENOMEM. */
int fvi_cholmod_solve(fvi_cholmod *c, double *r);

/* fvi_cholmod_free -- give everything back. NULL is allowed. */
void fvi_cholmod_free(fvi_cholmod *c);

#endif
