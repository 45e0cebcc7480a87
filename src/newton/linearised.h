/* src/newton/linearised.h -- A run that is the derivative of another run.  [H 23]
 *
 * Internal. The potential of such a run is U = x^T G x / 2, with a G of its own at each
 * stage of each step: the Hessians along the run that is derived. All its equations are
 * linear. A step takes one factorisation and one solution, and no iteration.
 *
 * The adjoint of a run is such a run, through the same stages in reverse order; a tangent
 * is such a run, forwards. */
#ifndef FVI_LINEARISED_H
#define FVI_LINEARISED_H

#include "newton_stages.h"

/* What the steps of such a run are made of. Whoever takes the steps writes the Hessians
 * before each of them.
 *
 *   G         the Hessians of the step at hand, as the potential that is derived writes
 *             them, stage after stage; NULL: there is no potential, or there are matrices
 *   is_constant  nonzero if G is the same in all steps
 *   is_one_body  nonzero if all coordinates have the same equation, and G is diagonal: one
 *             block of the matrix is factorised for all
 *   source    the forces of the step at hand, d numbers a stage; NULL: none
 *   asked     so many of them were asked for; 0 before a step
 *   size      how many numbers a Hessian has
 *   stages    how many Hessians a step has
 *   reversed  nonzero if stage i of this run is stage stages - 1 - i of the run that is
 *             derived
 *   stage     the stage whose gradient or Hessian is asked for next
 *   by_order  nonzero if the history is to give its derivative by the order, too
 *   remembers_all  nonzero if the history is to take in coordinates without damping, too
 *   from_zero  nonzero if the history begins at 0, not at x0: x jumps at the start
 *   is_dual   nonzero if the run is a run of form D in dual variables: v = p/m are the
 *             multipliers, and x is the integrated force. (23.15) */
typedef struct {
    const double *G, *source;
    size_t d, diagonals, size, stages, stage, asked;
    int reversed, is_constant, is_one_body, by_order, remembers_all, from_zero, is_dual;
} fvi_linearised;

/* fvi_linearised_begin -- what `system` asks of its derivative: sizes, and all else zero.
 * fvi_linearised_system -- `system` with x^T G x / 2 for its potential, if it has no matrices,
 * and the sources for its force. *of stays the caller's. */
fvi_linearised fvi_linearised_begin(const fvi_system *system, size_t stages);
fvi_system fvi_linearised_system(const fvi_system *system, fvi_linearised *of);

/* fvi_linearised_gradient, _force -- G x at the stage, and the next source; of the signatures of
 * fvi_potential and fvi_force. */
int fvi_linearised_gradient(size_t d, const double *x, void *of, double *g);
int fvi_linearised_force(double t, size_t d, void *of, double *F);

/* fvi_linearised_of -- what is linearised here; NULL of an ordinary system. */
static inline fvi_linearised *fvi_linearised_of(const fvi_system *system)
{
    const fvi_force *force = &system->force;
    return force->value == fvi_linearised_force ? force->params : NULL;
}

/* fvi_newton_by_linearised -- as fvi_newton_solve, which calls it. */
int fvi_newton_by_linearised(fvi_newton *n, const double *x, const double *r,
                             double *d, double *g);

#endif
