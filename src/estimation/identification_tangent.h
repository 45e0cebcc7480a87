/* src/estimation/identification_tangent.h -- Compute a run with its derivatives by free parameters. [H 24] */
#ifndef FVI_IDENTIFICATION_TANGENT_H
#define FVI_IDENTIFICATION_TANGENT_H

#include <fvi/identification.h>
#include "tangent/tangent.h"

/* The derivatives by P parameters are those along P directions. In each direction one parameter changes by 1. */
typedef struct {
    fvi_tangent_run of;       /* contains the stepper, dx and pi */
    size_t P;
    const fvi_free_parameter *which;
    fvi_sensitivities *along; /* owned, with the arrays to which its pointers lead */
    double *unit;
} fvi_estimation_tangents;

/* fvi_estimation_tangents_start -- Start the run, at k = 0.
 *
 *   method  Algorithm 3, or a method with stages
 *   run, which  must outlive the call
 *   o       output; free it with fvi_estimation_tangents_stop in each case
 *
 * A step is fvi_tangent_step of o->of. Errors as fvi_tangent; with stages also FVI_EUNSUP for alpha = 1. */
int fvi_estimation_tangents_start(const fvi_method *method, const fvi_run *run, size_t P,
                                  const fvi_free_parameter *which, fvi_estimation_tangents *o);

void fvi_estimation_tangents_stop(fvi_estimation_tangents *o);

#endif
