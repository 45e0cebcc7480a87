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

/* The numbers of a term of a kernel, as indices. */
enum { FVI_BY_RHO, FVI_BY_ORDER, FVI_BY_TIME, FVI_BY_END, FVI_NUMBERS_OF_TERM };

/* One damper of the run; "each" means that an array has d numbers. */
typedef struct {
    fvi_run_damper of;
    fvi_stage_damper *adjoint;      /* the damper of the adjoint run; NULL: its matrix is zero */
    int has_line;                   /* v0 is subtracted from the velocities for the history of the run */
    double impulse_unit;            /* the factor of the impulses of the past, without rho; 0: there are none */
    fvi_initial_history_force history_force; /* the impulses of the past for an amplitude of 1 */
    double product;                 /* sum over all stages of b_i (v - line) . f, where f is the force of `adjoint` */
    double product_by_order;        /* the same with the derivative of f by 2 alpha */
    double *force_sum;              /* each: sum over all stages of b_i f */
    /* Each: impulses of the past times the multipliers, and the same with their derivatives by e. */
    double *impulse_sum, *impulse_sum_by_order;
    /* for the numbers of its kernel */
    fvi_kernel_term power;          /* the kernel of alpha */
    fvi_kernel kernel;
    double *by_number[FVI_NUMBERS_OF_TERM]; /* the derivatives, one number for each term of the kernel; owned */
    fvi_stage_terms terms;          /* the histories of its terms */
} fvi_adjoint_structure_damper;

/* The adjoint run. Its velocities are the multipliers: state->v is lambda_k after a step, and stage i of state->V is
 * the multiplier of stage s - 1 - i of the run. */
typedef struct {
    const fvi_run *run;             /* the run that is differentiated */
    const fvi_sensitivities *want;  /* the derivatives that are wanted */
    const fvi_lobatto_rule *rule;
    size_t s, d, count;             /* number of stages, unknowns and dampers */
    int by_numbers, by_order;       /* nonzero if derivatives by numbers of kernels are wanted; by orders */
    fvi_damper *held;               /* the dampers of the adjoint run, all with the past HELD; owned */
    fvi_mechanism mechanism;        /* these dampers */
    fvi_linearised linearised;
    fvi_system system;
    fvi_stepper *stepper;
    fvi_lobatto_matrices *state;    /* the state of the stepper */
    fvi_adjoint_structure_damper *each; /* owned */
    double A[FVI_STAGES][FVI_STAGES];   /* of (17.3) */
    double *v;                      /* s d: the velocities at the stages of step k of the run, the last stage first */
    double *v0;                     /* d: the velocity at the start of the run */
    double *lambda_after;           /* d: lambda_{k+1} */
    double *zeros, *product, *room; /* d each: zeros, and room */
    double *y;                      /* d: room for the numbers that the history of a damper takes in, of one stage */
    double *block;                  /* the memory of all these arrays and of those of the dampers; owned */
    double by_M, by_K;              /* sums for the derivatives by a factor of M, and of K */
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
