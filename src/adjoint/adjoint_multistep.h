/* src/adjoint/adjoint_multistep.h -- The adjoint run of a method without stages. [H 23, 27]
 *
 * Internal. adjoint.c walks from node N to node 0, and calls these functions at each step. The adjoint run is a run of
 * the same method, with 1 - kappa for kappa, through the Hessians of the run (linearised.h), or with the same matrices.
 * It has the same kernels. These files add up the derivatives along the way.
 *
 * A run has a list of dampers (run_damper.h). A damper with a matrix has the damping matrix C = rho S B^T. The damper
 * of a chain is C = diag(rho), and then S = B = 1. The sums of the histories of the adjoint run are the N_j of
 * (23.6). */
#ifndef FVI_ADJOINT_MULTISTEP_H
#define FVI_ADJOINT_MULTISTEP_H

#include <fvi/adjoint.h>
#include <fvi/dampers.h>
#include "adjoint_multipliers.h"
#include "checkpointing.h"
#include "methods/initial_history_force.h"
#include "newton/linearised.h"
#include "parameter_derivatives/constant_history.h"
#include "parameter_derivatives/node_terms.h"
#include "parameter_derivatives/order_filter.h"

/* One damper of the run. "Each" means that an array has d numbers, and "kept" that it has the r numbers that the
 * history of the damper keeps. */
typedef struct {
    fvi_run_damper of;
    size_t r;                      /* how many numbers B^T x has */
    const fvi_damping *damping;    /* of the adjoint run; NULL: nothing is damped, or the matrix is zero */
    double theta, unit;            /* theta: the shift of (23.7); unit: the factor of the sums for rho = 1 */
    int has_drift;                 /* the line t v_0 is subtracted from x for the history of the run */
    fvi_constant_history end_history;        /* methods of order 2: the history of the constant J_p (23.23) */
    fvi_constant_history jump_history;       /* the history of the jumps of lambda, (23.27) */
    double impulse_unit;           /* the factor of the impulses of the past, without rho; 0: there are none */
    fvi_initial_history_force history_force; /* the impulses of the past for an amplitude of 1 */
    double *sum;                   /* each: sum_j z_j S N_j */
    double *sum_by_order, *sum_by_theta; /* each: its derivatives by 2 alpha and by theta */
    double *by_line;               /* each: sum_j t_j S N_j, if this damper has no drift and another one has */
    /* Each: the sum over all impulses of the past times lambda; the same with their derivatives by e */
    double *impulse_sum, *impulse_sum_by_order;
    double *SJ, *CA;               /* each: S B^T J_p; C v_0, if the past of a law has impulses */
    double *B, *dB;                /* kept: B^T times the sum of all jumps so far, and times the last one */
    double *Ndot;                  /* kept: room for the derivatives of sums by the order */
    double *in, *change;           /* kept: what the histories of the terms take in, and its increment */
    double *block;                 /* the memory of all these arrays; owned */
    fvi_order_filter filter;       /* for the factor of the weights of a power, if its order is wanted */
    size_t first, terms;           /* the place of its terms among the terms of all dampers; how many of them have
                                      histories: 0 unless derivatives by numbers of a law are wanted */
    fvi_node_term *term;           /* their histories; owned */
} fvi_adjoint_damper;

/* One adjoint run. Its positions are lambda_k, which go from k = N to 0. "Each" means that an array has d numbers. */
typedef struct {
    const fvi_run *run;            /* the run that is differentiated */
    const fvi_sensitivities *want; /* the derivatives that are wanted */
    size_t d, count;               /* number of unknowns; number of dampers */
    int paper_convention;          /* Algorithm 3: the history of the adjoint run begins at 0 */
    int is_shifted;                /* fvi-shifted */
    int is_liouville;              /* Algorithm 3 with Riemann and Liouville's past: z_j = x_j */
    int has_jumps;                 /* J depends on p_k for k < N, too, so lambda jumps (23.27) */
    int by_order, by_numbers;      /* derivatives by the order of a power are wanted; by numbers of laws */
    int needs_velocity;            /* a damper has a drift */
    int is_quadratic, has_hessian; /* U is quadratic; the system has no matrices, and U has a Hessian */
    int steps_one_coordinate;      /* method of order 2: see fvi_adjoint_multistep_step_one_coordinate */
    int walks_in_blocks;           /* Algorithm 3: see fvi_adjoint_multistep_walk_in_blocks */
    double inertia;                /* m/h, if walks_in_blocks */
    double kappa;                  /* of the run, or 1/2 if the method has none */

    /* the adjoint run */
    fvi_damper *held;              /* its dampers, all with the past HELD, if the system has a list of them; owned */
    fvi_mechanism mechanism;       /* these dampers */
    fvi_linearised linearised;     /* the potential of its system: the Hessian of U along the run */
    fvi_system system;
    fvi_stepper *stepper;
    fvi_adjoint_damper *each;      /* owned */

    double *Jp, *v0;               /* each: J_p with all jumps so far; M^-1 p0, or 0 if it is not needed */
    double *jump;                  /* each: the last jump of lambda */
    double *right;                 /* each: lambda_{k+1}; lambda_k stands in stepper->x */
    double *S, *M;                 /* each: kappa x_k + (1 - kappa) x_{k+1}, where G is taken; the same for lambda */
    double *by_start, *by_line;    /* each: derivatives by a constant that is added to all x_k, and by a line t */
    double *kinetic;               /* each: sum_k (x_{k+1} - x_k) M (lambda_{k+1} - lambda_k); without matrices M = 1 */
    double *z, *z_next;            /* each: z_k, z_{k+1}, of which the history of the run keeps B^T z */
    double *zeros, *work, *column; /* each: zeros; room */
    fvi_adjoint_multipliers multipliers; /* nu of (23.7), for the histories of the terms of a law */
    double *G;                     /* the Hessian of U at S, if has_hessian */
    double *block;                 /* the memory of all these arrays; owned */
    double by_K;                   /* the sum for the derivative by a factor of K */
} fvi_adjoint_multistep;

/* fvi_adjoint_multistep_start -- start at node N, where lambda_N = J_p.
 *
 *   method     its scheme is FVI_SCHEME_FVI, FVI_SCHEME_CQ2_SHIFTED, FVI_SCHEME_CQ_BDF2 or FVI_SCHEME_CQ2_MIDPOINT
 *   run, want  stay the caller's
 *   has_jumps  nonzero: fvi_adjoint_multistep_jump will be called
 *   rows       x_{N-1} and x_N, d numbers each
 *   Jp         d numbers
 *   m          output; give it back with fvi_adjoint_multistep_free, also after an error
 *
 * Returns FVI_SUCCESS; what fvi_stepper_start and the histories return; FVI_EUNSUP if mass is wanted of matrices
 * without inertia; FVI_ENOMEM. */
int fvi_adjoint_multistep_start(const fvi_method *method, const fvi_run *run,
                                const fvi_sensitivities *want, int has_jumps,
                                const double *rows, const double *Jp,
                                fvi_adjoint_multistep *m);

/* fvi_adjoint_multistep_step -- go from node k + 1 to node k.
 *
 *   rows  x_k and x_{k+1}, d numbers each
 *   Jx    dJ/dx_{k+1}, d numbers */
int fvi_adjoint_multistep_step(fvi_adjoint_multistep *m, size_t k, const double *rows,
                               const double *Jx);

/* fvi_adjoint_multistep_jump -- let lambda jump at node k, 0 < k < N, because J depends on p_k. Jp: dJ/dp_k, d
 * numbers. */
int fvi_adjoint_multistep_jump(fvi_adjoint_multistep *m, const double *Jp);

/* fvi_adjoint_multistep_end -- write all derivatives at node 0. Jx: dJ/dx_0, d numbers. */
int fvi_adjoint_multistep_end(fvi_adjoint_multistep *m, const double *Jx);

void fvi_adjoint_multistep_free(fvi_adjoint_multistep *m);

/* fvi_adjoint_multistep_walk_in_blocks -- take all steps to node 0, many at once, in a third of the time. For one
 * damped coordinate by Algorithm 3 without derivatives by terms of a law: m->walks_in_blocks.
 *
 *   path  the rows of step N - 1 have been read
 *   Jx    in: dJ/dx_N; out: dJ/dx_0 */
int fvi_adjoint_multistep_walk_in_blocks(fvi_adjoint_multistep *m, fvi_checkpointing *path,
                                         const fvi_objective *J, double *Jx);

/* fvi_adjoint_multistep_has_one_coordinate -- return nonzero if a method of order 2 steps one damped coordinate, so
 * that fvi_adjoint_multistep_step_one_coordinate may be called.
 * fvi_adjoint_multistep_step_one_coordinate -- take a step of the adjoint run as fvi_stepper_step does. k and t of the
 * stepper stay as they are, because nothing reads them there. */
int fvi_adjoint_multistep_has_one_coordinate(const fvi_adjoint_multistep *m);
int fvi_adjoint_multistep_step_one_coordinate(fvi_adjoint_multistep *m);

/* The functions of adjoint_multistep_damping.c, each for one damper:
 *
 *   _start     start damper j; the stepper has been started
 *   _first     for Algorithm 3 at node N: add N_N, which acts there; x = x_N
 *   _left_out  at node j, whose momentum is stepper->p: add the histories of J_p and of the jumps of lambda, which the
 *              history of the stepper leaves out, (23.23); x = x_j
 *   _step      add everything of the step from node k + 1 to node k, up to which the history has come; rows as in
 *              fvi_adjoint_multistep_step
 *   _jump      take in a jump Jp of lambda
 *   _end       write the derivatives by the damper and by the numbers of its kernel, and add what it gives to
 *              m->by_start and m->by_line */
int fvi_adjoint_damper_start(fvi_adjoint_multistep *m, const fvi_method *method, size_t j);
int fvi_adjoint_damper_first(fvi_adjoint_multistep *m, fvi_adjoint_damper *a, const double *x);
int fvi_adjoint_damper_left_out(fvi_adjoint_multistep *m, fvi_adjoint_damper *a, size_t j, const double *x);
int fvi_adjoint_damper_step(fvi_adjoint_multistep *m, fvi_adjoint_damper *a, size_t k, const double *rows);
int fvi_adjoint_damper_jump(fvi_adjoint_multistep *m, fvi_adjoint_damper *a, const double *Jp);
int fvi_adjoint_damper_end(fvi_adjoint_multistep *m, fvi_adjoint_damper *a);
void fvi_adjoint_damper_free(fvi_adjoint_damper *a);

#endif
