/* src/adjoint/adjoint_structure.h -- The adjoint run of a structure with stages. [H 23, 27]
 *
 * Internal. As adjoint_lobatto.h, for structures. The adjoint run of M, K and dampers C_j by form D is a run of form D
 * with the same matrices and kernels. Its velocities are the multipliers of the stages in reverse order (23.15). */
#ifndef FVI_ADJOINT_STRUCTURE_H
#define FVI_ADJOINT_STRUCTURE_H

#include <fvi/adjoint.h>
#include "parameter_derivatives/stage_terms.h"
#include "methods/lobatto_matrices.h"
#include "newton/linearised.h"

/* One damper of the run; "each" means that an array has d numbers. */
typedef struct {
    fvi_run_damper of;
    fvi_stage_damper *adjoint; /* the damper of the adjoint run; NULL: its matrix is zero */
    int has_line;               /* v0 is subtracted from the velocities for the history of the run */
    double impulse_unit;        /* the factor of the impulses of the past, without rho; 0: the past exerts no force */
    fvi_initial_history_force past; /* the impulses of the past for an amplitude of 1 */
    double sum, sum_by_order;   /* sum of b_i (v - line) . force; the same with the derivative of the force by 2
                                   alpha */
    double *plain;              /* each: sum of b_i times the force of the adjoint run */
    /* Each: impulses of the past times the multipliers, and the same with their derivatives by e. */
    double *impulse_sum, *impulse_sum_by_order;
    /* for the numbers of its kernel */
    fvi_kernel_term power;      /* the kernel of alpha */
    fvi_kernel kernel;
    double *number[4];          /* the derivatives by rho, order, time and end of each term; owned */
    fvi_stage_terms terms;
} fvi_adjoint_structure_damper;

typedef struct {
    const fvi_run *run;
    const fvi_sensitivities *want;
    const fvi_lobatto_rule *rule;
    size_t s, d, count;
    int by_numbers, by_order;
    fvi_damper *held;           /* the dampers of the adjoint run, all with the past HELD; owned */
    fvi_mechanism mechanism;
    fvi_linearised linearised;
    fvi_system system;
    fvi_stepper *stepper;
    fvi_lobatto_matrices *o;    /* the state of the stepper */
    fvi_adjoint_structure_damper *each; /* owned */
    double A[FVI_STAGES][FVI_STAGES]; /* of (17.3) */
    double *v;                  /* s d: the velocities of the stages of the current step of the run, in reverse order */
    double *v0, *after, *zeros, *product, *room; /* d each */
    double *y;                  /* d: the history numbers of a damper, of one stage */
    double *block;              /* the memory of all these arrays and of those of the dampers; owned */
    double by_M, by_K;
} fvi_adjoint_structure;

/* fvi_adjoint_structure_check -- refuse derivatives that are not known. Returns FVI_SUCCESS, FVI_EINVAL or
 * FVI_EUNSUP. */
int fvi_adjoint_structure_check(const fvi_method *method, const fvi_run *run,
                                const fvi_sensitivities *want);

/* fvi_adjoint_structure_start, _jump, _step, _end, _free -- as the functions of adjoint_lobatto.h. */
int fvi_adjoint_structure_start(const fvi_method *method, const fvi_run *run,
                                const fvi_sensitivities *want, const double *Jp,
                                fvi_adjoint_structure *m);
int fvi_adjoint_structure_jump(fvi_adjoint_structure *m, const double *Jp);
int fvi_adjoint_structure_step(fvi_adjoint_structure *m, size_t k, const double *rows,
                               const double *Jx);
int fvi_adjoint_structure_end(fvi_adjoint_structure *m, const double *Jx);
void fvi_adjoint_structure_free(fvi_adjoint_structure *m);

#endif
