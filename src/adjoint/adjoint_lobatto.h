/* src/adjoint/adjoint_lobatto.h -- The run that goes backwards through stages. [H 23]
 *
 * Internal: what adjoint_multistep.h is for the methods of H 17. The adjoint run is a run of
 * the same method, through Hess U of the stages in reverse order: of form M in x, whose
 * memory begins at 0, and of form D in dual variables (linearised.h). Here is what the
 * derivatives sum up on its way. */
#ifndef FVI_ADJOINT_LOBATTO_H
#define FVI_ADJOINT_LOBATTO_H

#include <fvi/adjoint.h>
#include "parameter_derivatives/stage_terms.h"
#include "methods/lobatto_stages.h"
#include "newton/linearised.h"

/* Stage i of coordinate j stands at [j * s + i]. */
typedef struct {
    fvi_run own;        /* with a law alpha = 1/2, which then is not read */
    const fvi_run *run; /* it */
    const fvi_sensitivities *want;
    const fvi_lobatto_rule *rule;
    size_t s, d;
    int damped_inertia;    /* form D */
    int mass_plus_damping; /* form M, alpha = 1: rho is a mass, (17.17) */
    int is_damped, has_initial_impulses;
    /* the adjoint run: its steps are those of the method */
    fvi_linearised linearised;
    fvi_system system;
    fvi_stepper *stepper;
    double A[FVI_STAGES][FVI_STAGES]; /* of (17.3), the inverse of DD within a step */
    double *Lambda, *reversed;        /* s d numbers each; stages as in the run, and not */
    double *G, *column, *Q;           /* s Hessians; d; d */
    double *mass, *after;             /* d numbers each: inertia; lambda_{k+1} */
    double *hessian_product;          /* d numbers: Hess U lambda_{k+1} */
    double *last;                     /* d numbers: J_p p_N */
    double *jump; /* d numbers of form M: the last jump of lambda */
    double *T, *Tdot;                 /* d numbers each, of form M: what they end with */
    double *kinetic, *sum, *sumdot, *plain, *impulse_sum, *impulse_sum_by_order; /* d each */
    double *block;                                           /* these; owned */
    fvi_stage_terms terms; /* of a law whose terms are wanted */
    fvi_kernel_impulse initial_impulse;
} fvi_adjoint_lobatto;

/* As fvi_adjoint_multistep_start, _jump, _step, _end and _free.
 *
 *   p     p_N
 *   rows  x_k, and the positions of the stages behind the first; of form D of all */
int fvi_adjoint_lobatto_start(const fvi_method *method, const fvi_run *run,
                            const fvi_sensitivities *want, int has_jumps, const double *p,
                            const double *Jp, fvi_adjoint_lobatto *m);
int fvi_adjoint_lobatto_jump(fvi_adjoint_lobatto *m, const double *Jp);
int fvi_adjoint_lobatto_step(fvi_adjoint_lobatto *m, size_t k, const double *rows,
                           const double *Jx);
int fvi_adjoint_lobatto_end(fvi_adjoint_lobatto *m, const double *Jx);
void fvi_adjoint_lobatto_stop(fvi_adjoint_lobatto *m);

#endif
