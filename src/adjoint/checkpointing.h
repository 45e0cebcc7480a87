/* src/adjoint/checkpointing.h -- A trajectory, read from its end.          [H 23] */
#ifndef FVI_CHECKPOINTING_H
#define FVI_CHECKPOINTING_H

#include <fvi/trajectory.h>

typedef struct fvi_checkpointing fvi_checkpointing;

/* fvi_checkpointing_alloc -- ready to read the last step.
 *
 *   method, run  of the trajectory
 *   x, p     its rows, and the last p, which stay the caller's; or both NULL: the run is
 *            done here. As many rows are then kept as one copy of the stepper takes, as
 *            many copies as that leaves pieces, and each piece but the last is run again
 *   backward  output; free it with fvi_checkpointing_free
 *
 * Returns FVI_SUCCESS; what fvi_stepper_start, fvi_stepper_step and fvi_stepper_copy return; FVI_ENOMEM. On error
 * *backward is untouched. */
int fvi_checkpointing_alloc(const fvi_method *method, const fvi_run *run,
                       const double *x, const double *p,
                       fvi_checkpointing **backward);

/* fvi_checkpointing_momentum -- p_N, d numbers. */
const double *fvi_checkpointing_momentum(const fvi_checkpointing *backward);

/* fvi_checkpointing_step -- where the trajectory was in step k, from t_k to t_{k+1}.
 *
 *   k     not above the k of the call before
 *   rows  output: x_k and x_{k+1}, d numbers each; between them the other stages, where
 *         the method has stages, in form D all but the last. Good until the next call
 *
 * Returns FVI_SUCCESS; what fvi_stepper_step returns. */
int fvi_checkpointing_step(fvi_checkpointing *backward, size_t k, const double **rows);

/* fvi_checkpointing_first -- the first step whose rows stand before those of the last call, without
 * a gap. */
size_t fvi_checkpointing_first(const fvi_checkpointing *backward);

/* fvi_checkpointing_free -- give everything back. NULL is allowed. */
void fvi_checkpointing_free(fvi_checkpointing *backward);

#endif
