/* src/adjoint/adjoint_lobatto.h -- The adjoint run of a chain with stages. [H 23]
 *
 * Internal. As adjoint_multistep.h, for the methods of H 17. The adjoint run is a run of the same method through Hess U
 * at the stages in reverse order. For form M its variable is lambda, and its history begins at 0. For form D it is
 * written in dual variables (linearised.h). This file adds up the derivatives along the way. */
#ifndef FVI_ADJOINT_LOBATTO_H
#define FVI_ADJOINT_LOBATTO_H

#include <fvi/adjoint.h>
#include "parameter_derivatives/stage_terms.h"
#include "methods/lobatto_stages.h"
#include "newton/linearised.h"

/* Stage i of coordinate j stands at [j * s + i]. */
typedef struct {
    fvi_run run_copy;   /* a copy of the run */
    const fvi_run *run; /* points to run_copy */
    const fvi_sensitivities *want;
    const fvi_lobatto_rule *rule;
    size_t s, d;
    int damped_inertia;    /* form D */
    int mass_plus_damping; /* form M at alpha = 1: rho is added to the mass, (17.17) */
    int is_damped, has_initial_impulses;
    /* The adjoint run; its steps are steps of the method. */
    fvi_linearised linearised;
    fvi_system system;
    fvi_stepper *stepper;
    double A[FVI_STAGES][FVI_STAGES]; /* of (17.3) */
    double *Lambda, *reversed;        /* s d numbers each: the multipliers; stages in the order of the run, and in
                                         reverse order */
    double *G, *column, *Q;           /* s Hessians; room for d numbers; dJ/dx0, d numbers */
    double *mass, *after;             /* d numbers each: the mass, with rho at alpha = 1 of form M; lambda_{k+1} */
    double *hessian_product;          /* d numbers: Hess U lambda_{k+1} */
    double *last;                     /* d numbers: J_p p_N */
    double *jump; /* for form M, d numbers: the last jump of lambda */
    double *T, *Tdot;                 /* for form M, d numbers each: T and its derivative at the end of the last step */
    /* The sums over all steps, d each: h dJ/dm without v_0; velocities times T, and times Tdot; T alone; impulses of
     * the past times multipliers, and the same with their derivatives by e. */
    double *kinetic, *sum, *sumdot, *plain, *impulse_sum, *impulse_sum_by_order;
    double *block;                                           /* the memory of all these arrays; owned */
    fvi_stage_terms terms; /* the terms of a law, if derivatives by them are wanted */
    fvi_kernel_impulse initial_impulse;
} fvi_adjoint_lobatto;

/* fvi_adjoint_lobatto_start, _jump, _step, _end, _stop -- as fvi_adjoint_multistep_start, _jump, _step, _end and _free.
 *
 *   p     p_N
 *   rows  x_k, and the positions of the stages behind the first; for form D of all stages */
int fvi_adjoint_lobatto_start(const fvi_method *method, const fvi_run *run,
                            const fvi_sensitivities *want, int has_jumps, const double *p,
                            const double *Jp, fvi_adjoint_lobatto *m);
int fvi_adjoint_lobatto_jump(fvi_adjoint_lobatto *m, const double *Jp);
int fvi_adjoint_lobatto_step(fvi_adjoint_lobatto *m, size_t k, const double *rows,
                           const double *Jx);
int fvi_adjoint_lobatto_end(fvi_adjoint_lobatto *m, const double *Jx);
void fvi_adjoint_lobatto_stop(fvi_adjoint_lobatto *m);

#endif
