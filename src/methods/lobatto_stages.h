/* src/methods/lobatto_stages.h -- The stages of a step.           [Chapter 17]
 *
 * Internal: what lobatto_start.c makes and lobatto.c steps with. */
#ifndef FVI_LOBATTO_STAGES_H
#define FVI_LOBATTO_STAGES_H

#include "memory/lobatto_memory.h"
#include "pull.h"

enum { FVI_INNER = FVI_STAGES - 1 };

/* Stage i of coordinate j stands at [i * d + j]; of the l-th damped coordinate,
 * in v, Y and v0, at [l * s + i]. Stages count from 0 here. */
typedef struct {
    const fvi_lobatto_rule *rule;
    size_t s, d;
    double *share;                     /* of each coordinate, see (17.17) */
    double (*M)[FVI_INNER][FVI_INNER]; /* of each: the inverse of L in (17.8) */
    double *dX, *S, *grad; /* X_i - x_k, S_i but for grad U, grad U */
    double *r;             /* of the inner stages, see (17.8) */
    size_t damped, *index; /* the coordinates that have a Y */
    double *v, *Y, *v0;
    double scale, W[FVI_STAGES][FVI_STAGES]; /* h^(-beta), times W_0 */
    fvi_lobatto_memory *memory;              /* NULL: there is no history */
    fvi_pull pull;
} fvi_lobatto_stages;

/* fvi_lobatto_step -- (17.8), as fvi_step. */
int fvi_lobatto_step(fvi_stepper *s);

/* fvi_lobatto_prepare -- at k = 0, M and the stages being there: the solver of the inner
 * stages and grad U(x_0). Errors as fvi_newton_stages_alloc; what the gradient
 * returns. */
int fvi_lobatto_prepare(fvi_stepper *s, fvi_lobatto_stages *o);

#endif
