/* src/inverse/mirror_matrices.h -- The run that goes backwards, with matrices. [Chapter 23]
 *
 * Internal: of runs with M, C and K. */
#ifndef FVI_MIRROR_MATRICES_H
#define FVI_MIRROR_MATRICES_H

#include "backward.h"

#include <fvi/adjoint.h>

/* fvi_mirror_matrices -- from node N to node 0. mass, damping and parameters of
 * `want` are one number each, by a factor of M, C and K.
 *
 *   method  its scheme is FVI_SCHEME_ALGORITHM_3, SHIFTED, BDF2 or STABLE
 *   path    of the run, not yet read
 *
 * Returns FVI_SUCCESS; FVI_ENOMEM; what fvi_mirror_factors_start, fvi_start, fvi_step,
 * fvi_backward_step and the slopes return; FVI_EOVRFLW if a derivative is not finite. */
int fvi_mirror_matrices(const fvi_method *method, const fvi_run *run,
                        fvi_backward *path, const fvi_objective *objective,
                        const fvi_gradients *want);

#endif
