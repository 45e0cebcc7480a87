/* src/adjoint/adjoint_dampers.h -- The adjoint run of a structure with several dampers, without stages. [H 23, 27]
 *
 * Internal. adjoint_multistep.h is for one damping; this file is for a list of dampers. It has the derivatives by a
 * factor of each damper, and by the numbers of their laws (adjoint_dampers_numbers.c). The adjoint run has the same
 * matrices and kernels as the run. The sums of the histories of its dampers are the N_j of (23.6). */
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

/* One damper; "each" means that an array has d numbers. */
typedef struct {
    fvi_run_damper of;          /* of the run */
    const fvi_damping *damping; /* of the adjoint run; NULL: its matrix is zero */
    double theta, unit;         /* theta: the shift of (23.7); unit: the factor of the sums for rho = 1 */
    int has_drift;              /* the line t v_0 is subtracted from x for the history of the run */
    fvi_constant_history constant;
    fvi_constant_history jumped; /* the history of the jumps of lambda, (23.27) */
    double *B, *dB;              /* B^T times the sum of all jumps so far, and times the last one */
    double impulse_unit;        /* the factor of the impulses of the past, without rho; 0: the past exerts no force */
    fvi_initial_history_force history_force; /* the impulses of the past for an amplitude of 1 */
    double sum;                 /* sum_k z_k . C N_k */
    double *by_drift;           /* each: sum_k t_k C N_k */
    double *impulse_sum;        /* each: sum of the impulses of the past times lambda */
    double *CJ;                 /* each: C J_p */
    /* for the numbers of its law */
    double *impulse_sum_by_order; /* each: the same with the derivative of the impulses by their exponent e */
    size_t first, terms;        /* the place of its terms among the terms of all dampers; how many terms have
                                   histories */
    fvi_node_term *term;        /* the terms of a law; owned */
    double *CA;                 /* each: C v_0, if the start has impulses of a law */
    fvi_order_filter filter;    /* of a power */
    double *Ndot;               /* room for what the history keeps; owned */
    double sum_by_order, sum_by_theta;
} fvi_adjoint_damper;

typedef struct {
    const fvi_run *run;
    const fvi_sensitivities *want;
    size_t d, count;
    int paper_convention, is_shifted;
    int has_jumps;              /* J depends on p_k, k < N, too */
    double kappa;
    fvi_damper *held; /* the dampers of the adjoint run, all with the past HELD; owned */
    fvi_mechanism mechanism;
    fvi_linearised linearised;
    fvi_system system;
    fvi_stepper *stepper;
    fvi_adjoint_damper *each;   /* owned */
    int by_numbers;             /* derivatives by numbers of laws are wanted */
    fvi_adjoint_multipliers multipliers;
    double *Jp, *v0, *right, *by_start, *z, *work, *column, *moved, *jump; /* each */
    double *zeros, *history_input; /* d zeros; room for twice the numbers that the history of a
                                       damper takes in, at most 2 d */
    double *block;              /* the memory of all these arrays and of those of the dampers; owned */
    double by_M, by_K;
} fvi_adjoint_dampers;


/* fvi_adjoint_dampers_start, _step, _jump, _end, _free -- as the functions of adjoint_multistep.h. */
int fvi_adjoint_dampers_start(const fvi_method *method, const fvi_run *run,
                              const fvi_sensitivities *want, int has_jumps,
                              const double *rows, const double *Jp, fvi_adjoint_dampers *m);
int fvi_adjoint_dampers_step(fvi_adjoint_dampers *m, size_t k, const double *rows,
                             const double *Jx);
int fvi_adjoint_dampers_jump(fvi_adjoint_dampers *m, const double *Jp);
int fvi_adjoint_dampers_end(fvi_adjoint_dampers *m, const double *Jx);
void fvi_adjoint_dampers_free(fvi_adjoint_dampers *m);

/* fvi_adjoint_dampers_elongation -- write z = x - x_0 - t v_0 of node k, of which the history of a damper keeps B^T z;
 * d numbers. The line t v_0 is subtracted only if the damper has a drift. */
void fvi_adjoint_dampers_elongation(const fvi_adjoint_dampers *m, const fvi_adjoint_damper *a,
                                    size_t k, const double *x, double *z);

/* fvi_adjoint_dampers_first_sums -- for Algorithm 3: add the sums of node N, whose history has taken in lambda_N. x:
 * x_N. */
int fvi_adjoint_dampers_first_sums(fvi_adjoint_dampers *m, fvi_adjoint_damper *a, const double *x);

/* fvi_adjoint_dampers_multiply -- add z . S v to *sum; v is in the space of B^T x, and z has d. */
int fvi_adjoint_dampers_multiply(fvi_adjoint_dampers *m, const fvi_adjoint_damper *a,
                                 const double *z, const double *v, double *sum);

/* The functions of adjoint_dampers_numbers.c, each for one damper. They are called if derivatives by numbers of laws
 * are wanted:
 *
 *   _numbers_start  start the histories; the impulses of the past are prepared before
 *   _numbers_sums   add the sums of node k, up to which the history of the adjoint run has come; z as in the sum of C
 *   _numbers_step   go from node k + 1 to node k, for a law
 *   _numbers_end    write the derivatives; `at` is the sum over the impulses of the past for rho = 1
 *   _numbers_stop   free everything */
int fvi_adjoint_dampers_numbers_start(fvi_adjoint_dampers *m, const fvi_method *method,
                                      fvi_adjoint_damper *a);
int fvi_adjoint_dampers_numbers_sums(fvi_adjoint_dampers *m, fvi_adjoint_damper *a,
                                     const double *z, const double *rows);
int fvi_adjoint_dampers_numbers_step(fvi_adjoint_dampers *m, fvi_adjoint_damper *a, size_t k,
                                     const double *rows);
int fvi_adjoint_dampers_numbers_end(fvi_adjoint_dampers *m, fvi_adjoint_damper *a, double at);
void fvi_adjoint_dampers_numbers_stop(fvi_adjoint_damper *a);

#endif
