/* src/inverse/mirror_matrices.h -- The run that goes backwards, with matrices. [Chapter 23]
 *
 * Internal: of Algorithm 3 with M, C and K, without a law. */
#ifndef FVI_MIRROR_MATRICES_H
#define FVI_MIRROR_MATRICES_H

#include "backward.h"

#include <fvi/adjoint.h>

/* fvi_mirror_matrices -- from node N to node 0: x0, p0 and force of `want`.
 *
 *   path  of the run, not yet read
 *
 * Returns what fvi_start, fvi_step, fvi_backward_step and the slopes return; FVI_ENOMEM;
 * FVI_EOVRFLW if a derivative is not finite. */
int fvi_mirror_matrices(const fvi_run *run, fvi_backward *path,
                        const fvi_objective *objective,
                        const fvi_gradients *want);

#endif
