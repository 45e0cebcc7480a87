/* src/adjoint/adjoint_dampers.h -- The run of a structure with several dampers, backwards.
 *                                                                     [H 23, 27]
 * Internal: as adjoint_multistep.h, which has one damping. Here is a list of dampers, and derivatives
 * by a factor of each and by the numbers of their laws, adjoint_dampers_numbers.c. The adjoint run
 * has the same matrices and kernels, and what each history sums of it is N_j of (23.5). */
#ifndef FVI_ADJOINT_DAMPERS_H
#define FVI_ADJOINT_DAMPERS_H

#include <fvi/adjoint.h>
#include <fvi/dampers.h>

#include "adjoint_multipliers.h"
#include "methods/initial_history_force.h"
#include "newton/linearised.h"
#include "parameter_derivatives/constant_history.h"
#include "parameter_derivatives/node_terms.h"
#include "parameter_derivatives/order_filter.h"

/* Of one damper; where the comment says "each", d numbers. */
typedef struct {
    fvi_run_damper of;          /* of the run that is derived */
    const fvi_damping *damping; /* of the adjoint run; NULL: it has no history */
    double theta, unit;         /* unit: of rho = 1, as impulse_unit is */
    int has_drift;              /* the memory of the run knows v_0 */
    fvi_constant_history constant;
    fvi_constant_history jumped; /* the memory of what lambda has jumped by, (23.27) */
    double *B, *dB;              /* B^T of all jumps so far, and of the last one */
    double impulse_unit;        /* of a past that acts, else 0 */
    fvi_initial_history_force history_force; /* its impulses for an amplitude of 1 */
    double sum;                 /* sum_k z_k . C N_k */
    double *by_drift;           /* each: sum_k t_k C N_k */
    double *impulse_sum;        /* each: impulses of the past times lambda */
    double *CJ;                 /* each: C J_p */
    /* by the numbers of its law */
    double *impulse_sum_by_order; /* each: the impulses' derivative by e times lambda */
    size_t first, terms;        /* the place of its terms among all; so many have memories */
    fvi_node_term *term;        /* of a law; owned */
    double *CA;                 /* each: C v_0, where the start of a law has impulses */
    fvi_order_filter filter;    /* of a power */
    double *Ndot;               /* history_size numbers; owned */
    double sum_by_order, sum_by_theta;
} fvi_adjoint_damper;

typedef struct {
    const fvi_run *run;
    const fvi_sensitivities *want;
    size_t d, count;
    int paper_convention, is_shifted;
    int has_jumps;              /* J depends on p_k, k < N, too */
    double kappa;
    fvi_damper *held; /* the dampers of the adjoint run; owned */
    fvi_mechanism mechanism;
    fvi_linearised linearised;
    fvi_system system;
    fvi_stepper *stepper;
    fvi_adjoint_damper *each;   /* owned */
    int by_numbers;             /* those of laws are wanted */
    fvi_adjoint_multipliers multipliers;
    double *Jp, *v0, *right, *by_start, *z, *work, *column, *moved, *jump; /* each */
    double *zeros, *history_input; /* as many as unknowns; twice the history_size of a damper */
    double *block;              /* all of these and of the dampers; owned */
    double by_M, by_K;
} fvi_adjoint_dampers;


/* fvi_adjoint_dampers_start, _step, _jump, _end, _free -- as those of adjoint_multistep.h. */
int fvi_adjoint_dampers_start(const fvi_method *method, const fvi_run *run,
                              const fvi_sensitivities *want, int has_jumps,
                              const double *rows, const double *Jp, fvi_adjoint_dampers *m);
int fvi_adjoint_dampers_step(fvi_adjoint_dampers *m, size_t k, const double *rows,
                             const double *Jx);
int fvi_adjoint_dampers_jump(fvi_adjoint_dampers *m, const double *Jp);
int fvi_adjoint_dampers_end(fvi_adjoint_dampers *m, const double *Jx);
void fvi_adjoint_dampers_free(fvi_adjoint_dampers *m);

/* fvi_adjoint_dampers_elongation -- z = x - x_0 - t v_0 of node k, on which the memory of a damper
 * acts; d numbers. */
void fvi_adjoint_dampers_elongation(const fvi_adjoint_dampers *m, const fvi_adjoint_damper *a,
                                    size_t k, const double *x, double *z);

/* fvi_adjoint_dampers_first_sums -- of Algorithm 3 at node N, whose memory has taken in lambda_N; x: x_N. */
int fvi_adjoint_dampers_first_sums(fvi_adjoint_dampers *m, fvi_adjoint_damper *a, const double *x);

/* fvi_adjoint_dampers_multiply -- adds z . S v to *sum; v has history_size numbers, z has d. */
int fvi_adjoint_dampers_multiply(fvi_adjoint_dampers *m, const fvi_adjoint_damper *a,
                                 const double *z, const double *v, double *sum);

/* What adjoint_dampers_numbers.c has, all of one damper, where the numbers of laws are wanted:
 * _numbers_start  the memories; its past is prepared
 * _numbers_sums   of node k, where the memory of the adjoint run is; z as in the sum of C
 * _numbers_step   from node k + 1 to node k, of a law
 * _numbers_end    its derivatives; `at` is what the impulses of its past have of rho = 1
 * _numbers_stop   gives all back */
int fvi_adjoint_dampers_numbers_start(fvi_adjoint_dampers *m, const fvi_method *method,
                                      fvi_adjoint_damper *a);
int fvi_adjoint_dampers_numbers_sums(fvi_adjoint_dampers *m, fvi_adjoint_damper *a,
                                     const double *z, const double *rows);
int fvi_adjoint_dampers_numbers_step(fvi_adjoint_dampers *m, fvi_adjoint_damper *a, size_t k,
                                     const double *rows);
int fvi_adjoint_dampers_numbers_end(fvi_adjoint_dampers *m, fvi_adjoint_damper *a, double at);
void fvi_adjoint_dampers_numbers_stop(fvi_adjoint_damper *a);

#endif
