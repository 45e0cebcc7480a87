/* src/adjoint/adjoint_multistep.h -- The run that goes backwards.                 [H 23]
 *
 * Internal: adjoint.c walks from node N to node 0; here is what happens there. The adjoint run
 * is a run of the same method, with 1 - kappa for kappa, through the Hessians of the run
 * (linearised.h), or with the same matrices. Here is what the derivatives sum up on its way. */
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

/* One adjoint run. Where the comment says "each", d numbers; r of them are in the history, all of
 * them where there are no matrices. */
typedef struct {
    const fvi_run *run;
    const fvi_sensitivities *want;
    size_t d, r;
    fvi_scheme scheme;
    int paper_convention;  /* Algorithm 3: its memory begins at 0 */
    int is_liouville;      /* and that of the run, too: z_j = x_j */
    int has_drift;         /* the memory of the run knows p0/m */
    int is_damped, has_initial_impulses, is_quadratic, has_hessian;
    int steps_alone; /* one damped coordinate, by a method of order 2 */
    int is_alone;   /* one coordinate, by Algorithm 3, and no terms of a law: */
    double inertia; /* its m/h */
    double kappa, theta;   /* of the method, or of the run; the shift of (23.7) */
    fvi_linearised linearised;
    fvi_system system;
    fvi_stepper *stepper;
    const fvi_damping *damping; /* of the stepper; NULL: nothing is damped */
    fvi_constant_history constant;
    double growth; /* 2 alpha, or that of the law */
    int has_jumps;               /* J depends on p_k, k < N, too: */
    fvi_constant_history jumped; /* the memory of what lambda has jumped by, B */
    fvi_initial_history_force history_force; /* its impulses for an amplitude of 1 */
    double impulse_size; /* h^(1 + e) of a past that acts, else 0 */

    double *Jp, *CJ;            /* each: J_p, C J_p; without matrices C is the unit matrix */
    double *B, *jump, *CB;      /* each: of all jumps so far, of the last one; C times a memory */
    double *v0;                 /* each: p0/m; 0 where no velocity is asked for */
    double *right;              /* each: lambda_{k+1} */
    double *S, *M;              /* each: where G is; the multiplier there */
    double *by_start, *by_line; /* each: by a constant in x, and by a line */
    double *kinetic;            /* each: sum_k (x_{k+1}-x_k)(lambda_{k+1}-lambda_k) */
    double *impulse_sum, *impulse_sum_by_order; /* each: impulses of the past times lambda */
    double *z, *z_next;         /* each: z_k, z_{k+1} */
    double *sum;                /* each: sum_j z_j N_j, where there are no matrices */
    double *work, *column;      /* each */
    fvi_adjoint_multipliers multipliers; /* of a law, (23.7) */
    double *CA; /* each: of a law with impulses of the past, C A */
    double *N, *Ndot;           /* r each: room for sums, and for their derivatives by order */
    double *G;
    double *block; /* all these; owned */
    double sum_of_C, sum_by_order, sum_by_theta; /* sum_j z_j C N_j, and its derivatives */
    double by_M, by_K;
    fvi_order_filter filter; /* of the factor of the weights, where alpha is wanted */
    size_t terms;           /* of a law whose terms are wanted, */
    fvi_node_term *each; /* their memories; owned */
} fvi_adjoint_multistep;

/* fvi_adjoint_multistep_start -- at node N, where lambda_N = J_p.
 *
 *   method  its scheme is FVI_SCHEME_FVI, SHIFTED, BDF2 or STABLE
 *   run, want  stay the caller's
 *   has_jumps  nonzero: fvi_adjoint_multistep_jump will be called
 *   rows    x_{N-1} and x_N, d numbers each
 *   Jp      d numbers
 *   m       output; in any case to be given back by fvi_adjoint_multistep_free */
int fvi_adjoint_multistep_start(const fvi_method *method, const fvi_run *run,
                                const fvi_sensitivities *want, int has_jumps,
                                const double *rows, const double *Jp,
                                fvi_adjoint_multistep *m);

/* fvi_adjoint_multistep_step -- from node k + 1 to node k.
 *
 *   rows  x_k and x_{k+1}, d numbers each
 *   Jx    dJ/dx_{k+1}, d numbers */
int fvi_adjoint_multistep_step(fvi_adjoint_multistep *m, size_t k, const double *rows,
                               const double *Jx);

/* fvi_adjoint_multistep_jump -- at node k, 0 < k < N: J depends on p_k by Jp, d numbers. */
int fvi_adjoint_multistep_jump(fvi_adjoint_multistep *m, const double *Jp);

/* fvi_adjoint_multistep_end -- at node 0: all derivatives.   Jx: dJ/dx_0, d numbers */
int fvi_adjoint_multistep_end(fvi_adjoint_multistep *m, const double *Jx);

void fvi_adjoint_multistep_free(fvi_adjoint_multistep *m);

/* fvi_adjoint_multistep_walk_alone -- all steps to node 0 in a third of the time where m->is_alone.
 *
 *   path  its rows of step N - 1 have been read
 *   Jx    dJ/dx_N, and then dJ/dx_0 */
int fvi_adjoint_multistep_walk_alone(fvi_adjoint_multistep *m, fvi_checkpointing *path,
                                     const fvi_objective *J, double *Jx);

/* fvi_adjoint_multistep_can_step_alone -- may fvi_adjoint_multistep_advance_alone be called?
 * fvi_adjoint_multistep_advance_alone -- fvi_stepper_step of the adjoint run where
 * m->steps_alone, but for k and t, which nobody reads there. */
int fvi_adjoint_multistep_can_step_alone(const fvi_adjoint_multistep *m);
int fvi_adjoint_multistep_advance_alone(fvi_adjoint_multistep *m);

/* What adjoint_multistep_damping.c has of these:
 * _damping_start  the memories of the terms of a law
 * _apply_damping  to -= share C x, d numbers each
 * _first_sums  of Algorithm 3 at node N: N_N, which acts there
 * _add_constant  of the others at node k + 1, whose momentum is s->p: C J_p, (23.23)
 * _add_jumps  of all at node j, with its x: C B
 * _accumulate_damping  the memory is at node k, z and z_next are there
 * _end_damping  all that damping, alpha and the numbers of a law have */
int fvi_adjoint_multistep_damping_start(fvi_adjoint_multistep *m, const fvi_method *method);
int fvi_adjoint_multistep_apply_damping(const fvi_adjoint_multistep *m, double share,
                                        const double *x, double *to);
int fvi_adjoint_multistep_first_sums(fvi_adjoint_multistep *m, const double *x);
int fvi_adjoint_multistep_add_constant(fvi_adjoint_multistep *m, size_t k, const double *x);
int fvi_adjoint_multistep_add_jumps(fvi_adjoint_multistep *m, size_t j, const double *x);
int fvi_adjoint_multistep_accumulate_damping(fvi_adjoint_multistep *m, size_t k,
                                             const double *rows);
int fvi_adjoint_multistep_end_damping(fvi_adjoint_multistep *m);

/* fvi_adjoint_multistep_elongation -- z_j = x_j - origin - j drift, on which the memory of the
 * run acts, from x_j; d numbers each. */
static inline void fvi_adjoint_multistep_elongation(const fvi_adjoint_multistep *m,
                                                    size_t j, const double *x, double *z)
{
    const double *x0 = m->run->x0, t = (double)j * m->run->h;
    for (size_t i = 0; i < m->d; i++)
        z[i] = x[i] - (m->is_liouville ? 0 : x0[i]) - (m->has_drift ? t * m->v0[i] : 0);
}

#endif
