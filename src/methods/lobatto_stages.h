/* src/methods/lobatto_stages.h -- The stages of a step.           [H 17]
 *
 * Internal: what lobatto_start.c makes, and lobatto.c and lobatto_damped.c step with. */
#ifndef FVI_LOBATTO_STAGES_H
#define FVI_LOBATTO_STAGES_H

#include "stages/lobatto_history.h"
#include "initial_history_force.h"

/* Stage i of coordinate j stands at [i * d + j]; of the l-th damped coordinate,
 * in v, Y and v0, at [l * s + i]. Stages count from 0 here. */
typedef struct {
    const fvi_lobatto_rule *rule;
    size_t s, d;
    double *share; /* of each coordinate, see (17.17) */
    double *M; /* of each: the inverse of L in (17.8), or G of (17.25), n x n */
    size_t n;  /* s - 1, or s */
    double *dX, *S, *grad; /* X_i - x_k, S_i but for grad U, grad U */
    double *r;             /* of the stages that are solved for */
    size_t damped, *index; /* the coordinates that have a Y */
    double *v, *Y, *v0;
    double *Ydot;  /* of a linearised run: the derivative of Y by the order; or NULL */
    int from_zero; /* of a linearised run: the history begins at 0, not at x0 */
    const double *jump; /* of a linearised run: d numbers by which x has jumped at the
                           beginning of this step; or NULL */
    double scale, W[FVI_STAGES][FVI_STAGES]; /* h^(-beta), times W_0 */
    double A[FVI_STAGES][FVI_STAGES];        /* of Lobatto IIIC (17.3) */
    fvi_lobatto_history *memory;              /* NULL: there is no history */
    fvi_initial_history_force history_force;
} fvi_lobatto_stages;

/* fvi_lobatto_history_tolerance -- the tolerance that the memory of a run is asked for, (17.21). */
double fvi_lobatto_history_tolerance(const fvi_run *run);

/* fvi_lobatto_history_of_damper -- the sums of d velocities over the past, on s stages.
 *
 *   by_order  nonzero: with their derivative by the order; of a power alone
 *   keep      the tolerance
 *   scale     output: what stands before the sums, rho h^(1 - 2 alpha) of a power; the sums of a law
 *             have it in them
 *
 * Returns what fvi_lobatto_history_alloc and fvi_lobatto_history_of_kernel return. */
int fvi_lobatto_history_of_damper(const fvi_run *run, const fvi_run_damper *of, size_t s,
                                  size_t d, int by_order, double keep, double *scale,
                                  fvi_lobatto_history **memory);

/* fvi_lobatto_assemble_known_rhs -- S_i but for grad U and the part of the present in the memory:
 * force, impulses of the past and history. o->v holds the v of the step before.
 * Returns what the force and fvi_lobatto_history_push return. */
int fvi_lobatto_assemble_known_rhs(fvi_stepper *s, fvi_lobatto_stages *o);

/* fvi_lobatto_step -- (17.8), as fvi_stepper_step. */
int fvi_lobatto_step(fvi_stepper *s);

/* fvi_lobatto_prepare -- at k = 0, M and the stages being there: the solver of the inner
 * stages and grad U(x_0). Errors as fvi_newton_stages_alloc; what the gradient
 * returns. */
int fvi_lobatto_prepare(fvi_stepper *s, fvi_lobatto_stages *o);

/* fvi_lobatto_damped_step, _prepare -- the same for form D: (17.24), and M too is made
 * here. Errors also FVI_ESING. */
int fvi_lobatto_damped_step(fvi_stepper *s);
int fvi_lobatto_damped_prepare(fvi_stepper *s, fvi_lobatto_stages *o);

#endif
