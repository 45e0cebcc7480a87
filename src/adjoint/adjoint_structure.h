/* src/adjoint/adjoint_structure.h -- A structure with stages, backwards.      [H 23, 27]
 *
 * Internal: what adjoint_lobatto.h is for chains. The adjoint run of M, K and dampers C_j by form D is a run of
 * form D with the same matrices and kernels. Its velocities are the multipliers of the stages in reverse order
 * (23.15). */
#ifndef FVI_ADJOINT_STRUCTURE_H
#define FVI_ADJOINT_STRUCTURE_H

#include <fvi/adjoint.h>
#include "parameter_derivatives/stage_terms.h"
#include "methods/lobatto_matrices.h"
#include "newton/linearised.h"

/* One damper of the run whose derivatives these are. Where the comment says "each", d numbers. */
typedef struct {
    fvi_run_damper of;
    fvi_stage_damper *adjoint; /* of the adjoint run; NULL: it has no history */
    int has_line;               /* v0 is subtracted from the velocities that the history of the run sees */
    double impulse_unit;        /* of a past that acts, else 0 */
    fvi_initial_history_force past; /* its impulses for an A of 1 */
    double sum, sum_by_order;   /* sum of b_i (v - line) . force, and with its derivative by 2 alpha */
    double *plain;              /* each: sum of h b_i forces */
    double *impulse_sum, *impulse_sum_by_order; /* each: impulses of the past times the multipliers */
    /* the numbers of its kernel */
    fvi_kernel_term power;      /* of alpha */
    fvi_kernel kernel;
    double *number[4];          /* by rho, order, time and end of each term; owned */
    fvi_stage_terms terms;
} fvi_adjoint_structure_damper;

typedef struct {
    const fvi_run *run;
    const fvi_sensitivities *want;
    const fvi_lobatto_rule *rule;
    size_t s, d, count;
    int by_numbers, by_order;
    fvi_damper *held;           /* the dampers of the adjoint run; owned */
    fvi_mechanism mechanism;
    fvi_linearised linearised;
    fvi_system system;
    fvi_stepper *stepper;
    fvi_lobatto_matrices *o;    /* its state */
    fvi_adjoint_structure_damper *each; /* owned */
    double A[FVI_STAGES][FVI_STAGES]; /* of (17.3) */
    double *v;                  /* s d: the velocities of the stages of the step at hand, in reverse order */
    double *v0, *after, *zeros, *product, *room; /* d */
    double *y;                  /* of one stage, the history numbers of a damper: d */
    double *block;              /* all of these and of the dampers; owned */
    double by_M, by_K;
} fvi_adjoint_structure;

/* fvi_adjoint_structure_check -- FVI_EUNSUP for what is not known. */
int fvi_adjoint_structure_check(const fvi_method *method, const fvi_run *run,
                                const fvi_sensitivities *want);

/* fvi_adjoint_structure_start, _jump, _step, _end, _free -- as those of adjoint_lobatto.h. */
int fvi_adjoint_structure_start(const fvi_method *method, const fvi_run *run,
                                const fvi_sensitivities *want, const double *Jp,
                                fvi_adjoint_structure *m);
int fvi_adjoint_structure_jump(fvi_adjoint_structure *m, const double *Jp);
int fvi_adjoint_structure_step(fvi_adjoint_structure *m, size_t k, const double *rows,
                               const double *Jx);
int fvi_adjoint_structure_end(fvi_adjoint_structure *m, const double *Jx);
void fvi_adjoint_structure_free(fvi_adjoint_structure *m);

#endif
