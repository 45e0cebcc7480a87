/* src/stages/stage_dense.h -- Invert the equation of all stages of a small structure.     [H 27] */
#ifndef FVI_STAGE_DENSE_H
#define FVI_STAGE_DENSE_H

#include "lobatto_weights.h"
#include <fvi/system.h>

enum { FVI_STAGE_DENSE = 64 }; /* largest number of stages times unknowns for which the inverse is faster */

/* fvi_stage_dense -- Write the equation of stage_solver.h as one full matrix of s d rows, and invert it.
 *
 *     G = h (A^{-1} (x) M + h sum_j W_j (x) C_j + h^2 A (x) K)^{-1}
 *
 *   s  number of stages, s d <= FVI_STAGE_DENSE
 *   W  as for fvi_stage_solver_alloc
 *   G  output: column by column, fvi_dense_rows(s d) rows each; the caller frees it
 *
 * Cost: (s d)^3 products, 20 us for 5 unknowns and 8 stages. Accuracy: u times the condition number of the equation
 * after its rows and columns are divided by sqrt(M_pp + h^2 K_pp). Return FVI_SUCCESS; FVI_ENOMEM; FVI_ESING; or the
 * code of a function of the matrices. */
int fvi_stage_dense(const fvi_matrices *matrices, size_t d, size_t s, double h, const double *const *W, double **G);

#endif
