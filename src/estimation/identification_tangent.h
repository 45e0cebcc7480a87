/* src/estimation/identification_tangent.h -- A run with its derivatives by free parameters.
 *                                                                     [H 24] */
#ifndef FVI_IDENTIFICATION_TANGENT_H
#define FVI_IDENTIFICATION_TANGENT_H

#include <fvi/identification.h>
#include "tangent/tangent.h"

/* The derivatives by P parameters are those along P directions, in each of which one number changes by 1. */
typedef struct {
    fvi_tangent_run of;       /* its stepper, dx and pi */
    size_t P;
    const fvi_free_parameter *which;
    fvi_sensitivities *along; /* owned, as what their parameters point to */
    double *unit;
} fvi_estimation_tangents;

/* fvi_estimation_tangents_start -- at k = 0; run and which stay the caller's. method: Algorithm 3's,
 * or one with stages. o: output, which fvi_estimation_tangents_stop gives back in any case.
 * Errors as fvi_tangent; with stages also FVI_EUNSUP where alpha = 1. A step is fvi_tangent_step of o->of. */
int fvi_estimation_tangents_start(const fvi_method *method, const fvi_run *run, size_t P,
                                  const fvi_free_parameter *which, fvi_estimation_tangents *o);

void fvi_estimation_tangents_stop(fvi_estimation_tangents *o);

#endif
