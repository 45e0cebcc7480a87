/* src/sensitivity/adjoint_matrices.h -- The run that goes backwards, with matrices. [H 23]
 *
 * Internal: of runs with M, C and K. */
#ifndef FVI_ADJOINT_MATRICES_H
#define FVI_ADJOINT_MATRICES_H

#include "checkpointing.h"

#include <fvi/adjoint.h>

/* fvi_adjoint_matrices -- from node N to node 0. mass, damping and parameters of
 * `want` are one number each, by a factor of M, C and K.
 *
 *   method  its scheme is FVI_SCHEME_FVI, SHIFTED, BDF2 or STABLE
 *   path    of the run, not yet read
 *
 * Returns FVI_SUCCESS; FVI_ENOMEM; what fvi_adjoint_factors_start, fvi_stepper_start, fvi_stepper_step,
 * fvi_checkpointing_step and the slopes return; FVI_EOVRFLW if a derivative is not finite. */
int fvi_adjoint_matrices(const fvi_method *method, const fvi_run *run,
                        fvi_checkpointing *path, const fvi_objective *objective,
                        const fvi_sensitivities *want);

#endif
