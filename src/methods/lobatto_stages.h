/* src/methods/lobatto_stages.h -- The stages of a step.           [H 17]
 *
 * This header is internal. lobatto_start.c allocates the stages; lobatto.c and lobatto_damped.c take the steps. */
#ifndef FVI_LOBATTO_STAGES_H
#define FVI_LOBATTO_STAGES_H

#include "stages/lobatto_history.h"
#include "initial_history_force.h"

/* The stages of the current step of a run. Stages count from 0, and stage 0 stands at x_k. Stage i of coordinate j is
 * at [i * d + j]. In v, Y and Ydot, stage i of the l-th damped coordinate is at [l * s + i]. */
typedef struct {
    const fvi_lobatto_rule *rule;
    size_t s, d;           /* number of stages, number of coordinates */
    double *share;         /* of each coordinate: m/(m + rho) if the damping acts as a mass (17.17), else 1 */
    size_t unknowns;       /* stages that a step solves for: s - 1 in form M, s in form D */
    double *M;             /* for each coordinate a matrix of so many rows: the inverse of L in (17.8), G of (17.25) */
    double *dX;            /* X_i - x_k */
    double *S;             /* S_i of (17.8), without grad U */
    double *grad;          /* grad U at X_i */
    double *r;             /* right-hand sides of the stages that Newton's method solves for */
    size_t damped, *index; /* number and indices of the coordinates that have a history */
    double *v;             /* velocities at the stages, as the history takes them in: D X/h - v0, with a jump of x */
    double *v0;            /* one number for each damped coordinate: p_0/m for alpha > 1/2, else 0 (17.7) */
    double *Y;             /* H of (17.9): the sums over the steps before this one */
    double *Ydot;          /* in a linearised run: the derivative of Y by the order; else NULL */
    int from_zero;         /* in a linearised run: nonzero if the history begins at 0 instead of x0 */
    /* in a linearised run: d numbers by which x has jumped at the beginning of this step; else NULL */
    const double *jump;
    double scale, W[FVI_STAGES][FVI_STAGES]; /* scale = h^(-beta); W = scale W_0 */
    double A[FVI_STAGES][FVI_STAGES];        /* matrix A of Lobatto IIIC (17.3) */
    fvi_lobatto_history *memory;             /* NULL if there is no history */
    fvi_initial_history_force history_force;
} fvi_lobatto_stages;

/* fvi_lobatto_history_tolerance -- Return the tolerance for the history of a run, (17.21). */
double fvi_lobatto_history_tolerance(const fvi_run *run);

/* fvi_lobatto_history_of_damper -- Allocate the history of d velocities on s stages for a damper.
 *
 *   by_order  nonzero: with the derivative by the order; only for a power
 *   keep      the tolerance
 *   scale     output: the factor of the sums: rho h^(1 - 2 alpha) for a power, 1 for a law
 *
 * Return the code of fvi_lobatto_history_alloc or fvi_lobatto_history_of_kernel. */
int fvi_lobatto_history_of_damper(const fvi_run *run, const fvi_run_damper *of, size_t s,
                                  size_t d, int by_order, double keep, double *scale,
                                  fvi_lobatto_history **memory);

/* fvi_lobatto_assemble_known_rhs -- Compute the known part of S_i from the force, the impulses of the past and the
 * history, without grad U and without the present part of the damping. On entry o->v holds v of the step before. Return
 * FVI_SUCCESS, or the code of the force or of fvi_lobatto_history_push. */
int fvi_lobatto_assemble_known_rhs(fvi_stepper *s, fvi_lobatto_stages *o);

/* fvi_lobatto_step -- Take the step (17.8). It is the member `step` of a method. */
int fvi_lobatto_step(fvi_stepper *s);

/* fvi_lobatto_prepare -- Allocate the solver of the inner stages and compute grad U(x_0), at k = 0. The caller has
 * computed M and set dX to zero. Return the codes of fvi_newton_stages_alloc and of the gradient. */
int fvi_lobatto_prepare(fvi_stepper *s, fvi_lobatto_stages *o);

/* fvi_lobatto_damped_step, fvi_lobatto_damped_prepare -- Do the same for form D: (17.24). Here the function `prepare`
 * also computes M. FVI_ESING is possible, too. */
int fvi_lobatto_damped_step(fvi_stepper *s);
int fvi_lobatto_damped_prepare(fvi_stepper *s, fvi_lobatto_stages *o);

#endif
