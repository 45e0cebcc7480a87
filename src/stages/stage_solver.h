/* src/stages/stage_solver.h -- The equation of all stages of a structure.     [H 27]
 *
 *     (A^{-1} (x) M + h sum_j W_j (x) C_j + h^2 A (x) K) delta = h load
 *
 * A of Lobatto IIIC and W_j a function of it. Each eigenvalue lambda of A^{-1} has an equation of its own,
 *
 *     Z = lambda M + h sum_j W_j(lambda) C_j + h^2 / lambda K,                 (27.14)
 *
 * and of a pair of conjugates one does. Of a small structure the equation of all stages is inverted as it stands. */
#ifndef FVI_STAGE_SOLVER_H
#define FVI_STAGE_SOLVER_H

#include "lobatto_weights.h"
#include <fvi/system.h>

typedef struct fvi_stage_solver fvi_stage_solver;

/* How the equation is solved. */
typedef enum {
    FVI_STAGE_PAIRS, /* by its eigenvectors (27.14) */
    FVI_STAGE_AUTO   /* as one full matrix if it has at most FVI_STAGE_DENSE rows (stage_dense.h), else by them */
} fvi_stage_way;

/* fvi_stage_solver_alloc -- the factors for steps of length h.
 *
 *   matrices  with complex factors; they must outlive the solver
 *   s         stages, 2 to 8
 *   W         of C, or of each of the dampers, s s numbers row by row, the step size included; NULL where a
 *             damper has no history
 *   way       a solver for few steps is made sooner by pairs
 *   solver    output; free it with fvi_stage_solver_free
 *
 * Returns FVI_SUCCESS; FVI_ENOMEM; FVI_ESING; what the functions of the matrices return. */
int fvi_stage_solver_alloc(const fvi_matrices *matrices, size_t d, size_t s, double h,
                           const double *const *W, fvi_stage_way way, fvi_stage_solver **solver);

/* fvi_stage_solver_solve -- delta of a load, s d numbers each, stage i of unknown j at [i * d + j]. Accuracy: u times
 * the condition number of the equation; by pairs the norms of the projectors come in, too, about 100 for s = 8. Returns
 * what solve and solve_complex return. */
int fvi_stage_solver_solve(fvi_stage_solver *solver, const double *load, double *delta);

/* fvi_stage_solver_filter -- about how far an error of the load of all stages moves v: |lambda Z^{-1} h load| of the
 * first pair, which is complex. d numbers each, not negative. s is even; the solver is one of pairs. Returns what
 * solve_complex returns. */
int fvi_stage_solver_filter(fvi_stage_solver *solver, const double *load, double *size);

/* fvi_stage_solver_free -- give everything back. NULL is allowed. */
void fvi_stage_solver_free(fvi_stage_solver *solver);

#endif
