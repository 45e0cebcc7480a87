/* src/adjoint/checkpointing.h -- Read a trajectory from its end, with checkpoints. [H 23] */
#ifndef FVI_CHECKPOINTING_H
#define FVI_CHECKPOINTING_H

#include <fvi/trajectory.h>

typedef struct fvi_checkpointing fvi_checkpointing;

/* fvi_checkpointing_alloc -- prepare to read the last step.
 *
 *   method, run  of the trajectory
 *   x, p         its rows, and the last p, which stay the caller's; or both NULL: the run is made here. It is then
 *                divided into pieces of about sqrt(r N) steps, where a copy of the stepper is as large as r rows. The
 *                rows of one piece are kept, and a copy of the stepper at the beginning of each piece but the last.
 *                Each piece but the last is run again
 *   backward     output; free it with fvi_checkpointing_free
 *
 * Returns FVI_SUCCESS; what fvi_stepper_start, fvi_stepper_step and fvi_stepper_copy return; FVI_EINVAL if a piece
 * cannot be addressed; FVI_ENOMEM. On error *backward is untouched. */
int fvi_checkpointing_alloc(const fvi_method *method, const fvi_run *run,
                       const double *x, const double *p,
                       fvi_checkpointing **backward);

/* fvi_checkpointing_momentum -- p_N, d numbers. */
const double *fvi_checkpointing_momentum(const fvi_checkpointing *backward);

/* fvi_checkpointing_step -- the rows of step k, from t_k to t_{k+1}.
 *
 *   k     not above the k of the call before
 *   rows  output: x_k and x_{k+1}, d numbers each. For methods with stages the other stages stand between them: their
 *         positions, and for a structure their velocities. Form D has all stages there but the last. Valid until the
 *         next call
 *
 * Returns FVI_SUCCESS; what fvi_stepper_step returns. */
int fvi_checkpointing_step(fvi_checkpointing *backward, size_t k, const double **rows);

/* fvi_checkpointing_first -- the first step of the current piece: its rows and all later ones stand before the rows of
 * the last call, without a gap. */
size_t fvi_checkpointing_first(const fvi_checkpointing *backward);

/* fvi_checkpointing_free -- give everything back. NULL is allowed. */
void fvi_checkpointing_free(fvi_checkpointing *backward);

#endif
