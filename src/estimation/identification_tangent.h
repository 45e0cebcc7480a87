/* src/estimation/identification_tangent.h -- A run with its derivatives, on its way.
 *                                                                     [H 24] */
#ifndef FVI_IDENTIFICATION_TANGENT_H
#define FVI_IDENTIFICATION_TANGENT_H

#include <fvi/identification.h>

typedef struct fvi_tangent_stages fvi_tangent_stages;

/* Arrays of P numbers: of parameter j at [j]. */
typedef struct {
    const fvi_run *run;
    size_t P;
    const fvi_free_parameter *which;
    fvi_parameter_gradient by;
    fvi_stepper *stepper;
    fvi_history *memory, *base_history; /* of the slopes; of x with its rate, or NULL */
    double c;                 /* rho h^(1 - 2 alpha) */
    double *s, *pi, *delta;   /* d x_k, d p_k, d (x_{k+1} - x_k) */
    double *z, *dz, *dU;      /* what the memory takes in; d U'(S) */
    fvi_tangent_stages
        *staged; /* of a method with stages; NULL: of Algorithm 3 */
} fvi_tangent_run;

/* fvi_tangent_start -- at k = 0; run and which stay the caller's. method: Algorithm 3's,
 * or one with stages, of form M. o: output, which fvi_tangent_stop gives back in any case.
 * Errors as fvi_tangent; with stages also FVI_EUNSUP where alpha = 1 or rho = 0. */
int fvi_tangent_start(const fvi_method *method, const fvi_run *run, size_t P,
                      const fvi_free_parameter *which, fvi_tangent_run *o);

/* fvi_tangent_step -- a step of the run and of its slopes. */
int fvi_tangent_step(fvi_tangent_run *o);

void fvi_tangent_stop(fvi_tangent_run *o);

/* The same for stages: o->staged, what it holds, and a step, (24.12). */
int fvi_tangent_stages_start(fvi_tangent_run *o, const fvi_method *method);
int fvi_tangent_stages_step(fvi_tangent_run *o);
void fvi_tangent_stages_stop(fvi_tangent_stages *staged);

#endif
