/* src/newton/linearised.h -- Take the steps of a linearised run, which is the derivative of another run.  [H 23]
 *
 * This header is internal. The potential of a linearised run is U = x^T G x / 2, with one G for each stage of each
 * step. Each G is the Hessian of the original potential at that stage of the original run. So all equations of the run
 * are linear, and a step needs one factorisation, one solution and no iteration.
 *
 * Both derivatives of a run are linearised runs. The tangent goes through the stages forwards. The adjoint goes through
 * them in reverse order. */
#ifndef FVI_LINEARISED_H
#define FVI_LINEARISED_H

#include "newton_stages.h"

/* fvi_linearised -- The data of one step of a linearised run. The caller writes the Hessians before each step.
 *
 *   G         the Hessians of this step, stage after stage, each in the form of the original potential. NULL: there is
 *             no potential, or the system has matrices
 *   source    the forces of this step, d numbers for each stage; NULL: no force
 *   size      number of doubles in one Hessian
 *   stages    number of Hessians in one step
 *   stage     the stage whose gradient or Hessian is needed next
 *   evaluated_stages  how many stages have read their force in this step; 0 before a step
 *   reversed  nonzero if stage i of this run is stage stages - 1 - i of the original run
 *   is_constant    nonzero if G is the same in all steps
 *   is_one_body    nonzero if all coordinates have the same equation and G is diagonal. Then one block of the matrix is
 *                  factorised for all
 *   by_order       nonzero if the history must also give its derivative by the order
 *   history_includes_undamped  nonzero if the history must also take in coordinates without damping
 *   from_zero      nonzero if the history begins at 0 instead of x0, so that x jumps at the start
 *   is_dual        nonzero if the run is a run of form D in dual variables: v = p/m are the multipliers, and x is the
 *                  integrated force (23.15) */
typedef struct {
    const double *G, *source;
    size_t d, diagonals, size, stages, stage, evaluated_stages;
    int reversed, is_constant, is_one_body, by_order, history_includes_undamped, from_zero, is_dual;
} fvi_linearised;

/* fvi_linearised_begin -- Return a structure with the sizes of `system`, and with all other fields zero.
 * fvi_linearised_system -- Return a copy of `system` whose force is the source. If the system has no matrices, its
 * potential is x^T G x / 2. The caller keeps *of, which must outlive the system. */
fvi_linearised fvi_linearised_begin(const fvi_system *system, size_t stages);
fvi_system fvi_linearised_system(const fvi_system *system, fvi_linearised *of);

/* fvi_linearised_gradient -- Write G x of the current stage. It has the signature of a gradient in fvi_potential.
 * fvi_linearised_force -- Write the next source. It has the signature of a value in fvi_force. */
int fvi_linearised_gradient(size_t d, const double *x, void *of, double *g);
int fvi_linearised_force(double t, size_t d, void *of, double *F);

/* fvi_linearised_of -- Return the data of a linearised system, or NULL if the system is an ordinary one. */
static inline fvi_linearised *fvi_linearised_of(const fvi_system *system)
{
    const fvi_force *force = &system->force;
    return force->value == fvi_linearised_force ? force->params : NULL;
}

/* fvi_newton_by_linearised -- Solve the equation of a linearised step. fvi_newton_solve calls it; arguments and codes
 * are the same. */
int fvi_newton_by_linearised(fvi_newton *n, const double *x, const double *r,
                             double *d, double *g);

#endif
