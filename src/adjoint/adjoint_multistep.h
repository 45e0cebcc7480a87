/* src/adjoint/adjoint_multistep.h -- The adjoint run of a method without stages. [H 23]
 *
 * Internal. adjoint.c walks from node N to node 0, and calls these functions at each step. The adjoint run is a run of
 * the same method, with 1 - kappa for kappa, through the Hessians of the run (linearised.h), or with the same matrices.
 * This file adds up the derivatives along the way. */
#ifndef FVI_ADJOINT_MULTISTEP_H
#define FVI_ADJOINT_MULTISTEP_H

#include <fvi/adjoint.h>
#include "adjoint_multipliers.h"
#include "checkpointing.h"
#include "methods/initial_history_force.h"
#include "newton/linearised.h"
#include "parameter_derivatives/constant_history.h"
#include "parameter_derivatives/node_terms.h"
#include "parameter_derivatives/order_filter.h"

/* One adjoint run. Its positions are lambda_k, which go from k = N to 0, and its history has the sum N_k (23.6) at node
 * k. C is the damping matrix; without matrices it is diag(rho). "Each" means that an array has d numbers. */
typedef struct {
    const fvi_run *run;            /* the run that is differentiated */
    const fvi_sensitivities *want; /* the derivatives that are wanted */
    size_t d, r;                   /* number of unknowns; numbers in the history, r = d without matrices */
    fvi_scheme scheme;
    int paper_convention;          /* Algorithm 3: the history of the adjoint run begins at 0 */
    int is_liouville;              /* Algorithm 3 with Riemann and Liouville's past: z_j = x_j */
    int has_drift;                 /* the line t p0/m is subtracted from x for the history of the run */
    int is_damped;                 /* a damping is not 0, or its derivative is wanted */
    int has_initial_impulses;      /* the initial history exerts a force, as impulses (19.5) */
    int is_quadratic, has_hessian; /* U is quadratic; the system has no matrices, and U has a Hessian */
    int steps_one_coordinate;      /* method of order 2: see fvi_adjoint_multistep_step_one_coordinate */
    int walks_in_blocks;           /* Algorithm 3: see fvi_adjoint_multistep_walk_in_blocks */
    double inertia;                /* m/h, if walks_in_blocks */
    double kappa, theta;           /* kappa of the run, or 1/2 if the method has none; the shift of (23.7) */
    double growth;                 /* 2 alpha, or the growth of the law */

    /* the adjoint run */
    fvi_linearised linearised;     /* the potential of its system: the Hessian of U along the run */
    fvi_system system;
    fvi_stepper *stepper;
    const fvi_damping *damping;    /* of the stepper; NULL: nothing is damped */
    fvi_constant_history end_history;  /* methods of order 2: the history of the constant J_p (23.23) */
    int has_jumps;                     /* J depends on p_k for k < N, too, so lambda jumps (23.27) */
    fvi_constant_history jump_history; /* then the history of B */
    fvi_initial_history_force history_force; /* the impulses of the initial history for an amplitude of 1 */
    double impulse_size;           /* h^(1 + e), the factor of these impulses; 0: there are none */

    double *Jp, *CJ;               /* each: J_p with all jumps so far; C J_p, or without matrices J_p */
    double *B, *jump;              /* each: the sum of all jumps so far; the last jump */
    double *CB;                    /* each: C times a sum of the history of B */
    double *v0;                    /* each: p0/m; 0 if it is not needed */
    double *right;                 /* each: lambda_{k+1}; lambda_k stands in stepper->x */
    double *S, *M;                 /* each: kappa x_k + (1 - kappa) x_{k+1}, where G is taken; the same for lambda */
    double *by_start, *by_line;    /* each: derivatives by a constant that is added to all x_k, and by a line t */
    double *kinetic;               /* each: sum_k (x_{k+1} - x_k) (lambda_{k+1} - lambda_k) */
    /* Each: the sum over all impulses of the initial history times lambda; the same with their derivatives by e */
    double *impulse_sum, *impulse_sum_by_order;
    double *z, *z_next;            /* each: z_k, z_{k+1}, the numbers that the history of the run takes in */
    double *sum;                   /* each: sum_j z_j N_j, without matrices */
    double *work, *column;         /* each: room */
    fvi_adjoint_multipliers multipliers; /* nu of (23.7), for the histories of the terms of a law */
    double *CA;                    /* each: C v0, if the initial history of a law has impulses */
    double *N, *Ndot;              /* r each: room for sums, and for their derivatives by the order */
    double *G;                     /* the Hessian of U at S, if has_hessian */
    double *block;                 /* the memory of all these arrays; owned */
    double sum_of_C, sum_by_order, sum_by_theta; /* sum_j z_j C N_j, and its derivatives by 2 alpha and by theta */
    double by_M, by_K;             /* sums for the derivatives by a factor of M, and of K */
    fvi_order_filter filter;       /* for the factor of the weights, if alpha is wanted */
    size_t terms;                  /* of a law, if derivatives by their numbers are wanted; else 0 */
    fvi_node_term *each;           /* their histories; owned */
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

/* The functions of adjoint_multistep_damping.c:
 *
 *   _damping_start       start the histories of the terms of a law
 *   _apply_damping       to -= share C x, d numbers each
 *   _first_sums          for Algorithm 3 at node N: add N_N, which acts there
 *   _add_constant        for the other methods at node k + 1, whose momentum is s->p: add the history of C J_p, (23.23)
 *   _add_jumps           for all methods at node j, x = x_j: add the history of C B
 *   _accumulate_damping  add the sums of node k, up to which the history has come; writes z and z_next
 *   _end_damping         write all derivatives by dampings, by alpha and by the numbers of a law */
int fvi_adjoint_multistep_damping_start(fvi_adjoint_multistep *m, const fvi_method *method);
int fvi_adjoint_multistep_apply_damping(const fvi_adjoint_multistep *m, double share,
                                        const double *x, double *to);
int fvi_adjoint_multistep_first_sums(fvi_adjoint_multistep *m, const double *x);
int fvi_adjoint_multistep_add_constant(fvi_adjoint_multistep *m, size_t k, const double *x);
int fvi_adjoint_multistep_add_jumps(fvi_adjoint_multistep *m, size_t j, const double *x);
int fvi_adjoint_multistep_accumulate_damping(fvi_adjoint_multistep *m, size_t k,
                                             const double *rows);
int fvi_adjoint_multistep_end_damping(fvi_adjoint_multistep *m);

/* fvi_adjoint_multistep_elongation -- write z_j = x_j - origin - j drift, which the history of the run takes in, from
 * x_j; d numbers each. */
static inline void fvi_adjoint_multistep_elongation(const fvi_adjoint_multistep *m,
                                                    size_t j, const double *x, double *z)
{
    const double *x0 = m->run->x0, t = (double)j * m->run->h;
    for (size_t i = 0; i < m->d; i++)
        z[i] = x[i] - (m->is_liouville ? 0 : x0[i]) - (m->has_drift ? t * m->v0[i] : 0);
}

#endif
