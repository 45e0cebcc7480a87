/* src/matrices/factors.h -- Solve equations with a sparse positive definite matrix.    [H 27] */
#ifndef FVI_FACTORS_H
#define FVI_FACTORS_H

#include "sparse.h"

/* The solvers, see fvi_structure_solver_name. */
typedef enum {
    FVI_BY_DIAGONAL,
    FVI_BY_BAND,
    FVI_BY_CHOLMOD
} fvi_factorisation;

/* fvi_choose_factorisation -- Return the solver for a matrix.
 * fvi_choose_factorisation_of_band -- Return the solver for a matrix of this half bandwidth. */
fvi_factorisation fvi_choose_factorisation(const fvi_sparse *A);
fvi_factorisation fvi_choose_factorisation_of_band(size_t half_band);

typedef struct fvi_factors fvi_factors;

/* fvi_factors_alloc -- Factorise A by this solver. The function frees A, also after an error. Return FVI_SUCCESS;
 * FVI_ESING if A is not positive definite; FVI_ENOMEM. */
int fvi_factors_alloc(fvi_factorisation factorisation, fvi_sparse *A, fvi_factors **factors);

/* fvi_factors_solve -- Replace r by A^-1 r, n numbers. Return FVI_SUCCESS or FVI_ENOMEM. */
int fvi_factors_solve(fvi_factors *f, double *r);

/* fvi_factors_free -- Free the factors. NULL is allowed. */
void fvi_factors_free(fvi_factors *f);

/* ---- cholmod_factors.c ---- */

typedef struct fvi_cholmod fvi_cholmod;

/* fvi_cholmod_alloc -- Factorise A by CHOLMOD. A may be freed afterwards. Return FVI_SUCCESS; FVI_ESING if A is not
 * positive definite; FVI_ENOMEM. */
int fvi_cholmod_alloc(const fvi_sparse *A, fvi_cholmod **cholmod);

/* fvi_cholmod_solve -- Replace r by A^-1 r. Return FVI_SUCCESS or FVI_ENOMEM. */
int fvi_cholmod_solve(fvi_cholmod *c, double *r);

/* fvi_cholmod_free -- Free the factors. NULL is allowed. */
void fvi_cholmod_free(fvi_cholmod *c);

#endif
