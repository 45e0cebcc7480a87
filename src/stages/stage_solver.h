/* src/stages/stage_solver.h -- Solve the equation of all stages of a structure.  [H 27]
 *
 *     (A^{-1} (x) M + h sum_j W_j (x) C_j + h^2 A (x) K) delta = h load
 *
 * A is the matrix of Lobatto IIIC, and each W_j is a function of A. So the equation decouples: each eigenvalue lambda
 * of A^{-1} has an equation of its own with the matrix
 *
 *     Z = lambda M + h sum_j W_j(lambda) C_j + h^2 / lambda K                 (27.14)
 *
 * One equation is enough for a pair of conjugate eigenvalues. The equation of a small structure is
 * inverted as a whole instead. */
#ifndef FVI_STAGE_SOLVER_H
#define FVI_STAGE_SOLVER_H

#include "lobatto_weights.h"
#include <fvi/system.h>

typedef struct fvi_stage_solver fvi_stage_solver;

/* How the equation is solved. */
typedef enum {
    FVI_STAGE_PAIRS, /* by the eigenvectors of A (27.14) */
    /* as one full matrix if it has at most FVI_STAGE_DENSE rows (stage_dense.h), else by the eigenvectors */
    FVI_STAGE_AUTO
} fvi_stage_solver_kind;

/* fvi_stage_solver_alloc -- Allocate a solver, and factorise its equations for steps of length h.
 *
 *   matrices  matrices with complex factors; they must outlive the solver
 *   s         number of stages, 2 to 8
 *   W         for C, or for each damper, s s numbers row by row, which include the step size; NULL for a damper without
 *             damping
 *   kind      FVI_STAGE_PAIRS is faster to allocate, so it is better for a few steps
 *   solver    output; free it with fvi_stage_solver_free
 *
 * Return FVI_SUCCESS; FVI_ENOMEM; FVI_ESING; or the code of a function of the matrices. */
int fvi_stage_solver_alloc(const fvi_matrices *matrices, size_t d, size_t s, double h,
                           const double *const *W, fvi_stage_solver_kind kind, fvi_stage_solver **solver);

/* fvi_stage_solver_solve -- Solve for delta. load and delta are s d numbers each; stage i of unknown j is at
 * [i * d + j]. Accuracy: u times the condition number of the equation. By eigenvectors the error is larger by the norms
 * of their projectors, about 100 for s = 8. Return the code of solve or solve_complex. */
int fvi_stage_solver_solve(fvi_stage_solver *solver, const double *load, double *delta);

/* fvi_stage_solver_filter -- Estimate how much an error of the load of all stages changes v: size = |lambda Z^{-1} h
 * load| for the first pair, which must be complex. load and size are d numbers each, and size is not negative. s is
 * even, and the solver was allocated with FVI_STAGE_PAIRS. Return the code of solve_complex. */
int fvi_stage_solver_filter(fvi_stage_solver *solver, const double *load, double *size);

/* fvi_stage_solver_free -- Free the solver. NULL is allowed. */
void fvi_stage_solver_free(fvi_stage_solver *solver);

#endif
