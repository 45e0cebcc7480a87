/* src/estimation/identification_tangent.h -- A run with its derivatives, on its way.
 *                                                                     [H 24] */
#ifndef FVI_IDENTIFICATION_TANGENT_H
#define FVI_IDENTIFICATION_TANGENT_H

#include <fvi/identification.h>
#include "methods/lobatto_stages.h"
#include "newton/linearised.h"

/* The derivatives by P parameters are P coordinates of one linearised run, by the method of
 * the run itself: each has the mass, the damping and the Hessian of the body, and forces of
 * its own. Arrays of P numbers: of parameter j at [j]. Stages count from 0 here. */
typedef struct {
    const fvi_run *run;
    size_t P;
    const fvi_free_parameter *which;
    fvi_parameter_gradient by;
    fvi_stepper *stepper; /* of the run */
    double *s, *pi;       /* d x_k, d p_k; pi stands behind s */
    /* the linearised run */
    fvi_linearised linearised;
    fvi_system system;
    fvi_stepper *tangent;
    double *mass, *damping;  /* its numbers */
    double *G, *dU, *source; /* of stage i at [i * P + j]: Hess U, d grad U, forces */
    double *block;           /* all these arrays; owned */
    /* the history of x, with its derivative by the order */
    fvi_history *history; /* of Algorithm 3; NULL: not asked for */
    double c;             /* rho h^(1 - 2 alpha) */
    size_t stages;        /* 0 of Algorithm 3 */
    int damped_inertia;   /* form D */
    const fvi_lobatto_rule *rule;
    fvi_lobatto_history *of_stages;
    double H[FVI_STAGES], Hdot[FVI_STAGES]; /* what it gave */
    fvi_kernel_impulse initial_impulse;
    double impulse_size; /* h^(1 + e) of a past that acts, else 0 */
} fvi_tangent_run;

/* fvi_tangent_start -- at k = 0; run and which stay the caller's. method: Algorithm 3's,
 * or one with stages. o: output, which fvi_tangent_stop gives back in any case.
 * Errors as fvi_tangent; with stages also FVI_EUNSUP where alpha = 1. */
int fvi_tangent_start(const fvi_method *method, const fvi_run *run, size_t P,
                      const fvi_free_parameter *which, fvi_tangent_run *o);

/* fvi_tangent_step -- a step of the run and of its slopes. */
int fvi_tangent_step(fvi_tangent_run *o);

void fvi_tangent_stop(fvi_tangent_run *o);

/* fvi_tangent_stages_start, _step -- what identification_tangent_stages.c has of the two where
 * the method has stages: the history of x; the forces of a step, and the step. */
int fvi_tangent_stages_start(fvi_tangent_run *o);
int fvi_tangent_stages_step(fvi_tangent_run *o);

/* fvi_tangent_evaluate_potential -- Hess U at X into stage i of G, and what the parameters
 * change in grad U there into dU. Returns what a callback does. */
int fvi_tangent_evaluate_potential(fvi_tangent_run *o, size_t i, double X);

#endif
