/* src/sensitivity/adjoint_lobatto.h -- The run that goes backwards through stages. [H 23]
 *
 * Internal: what adjoint_multistep.h is for the methods of H 17, of form M and of form D. */
#ifndef FVI_ADJOINT_LOBATTO_H
#define FVI_ADJOINT_LOBATTO_H

#include <fvi/adjoint.h>
#include "adjoint_kernel.h"
#include "stages/lobatto_history.h"
#include "system/band.h"

typedef struct fvi_adjoint_lobatto_term fvi_adjoint_lobatto_term;

typedef double fvi_stage_matrix[FVI_STAGES][FVI_STAGES];

/* Stage i of coordinate j stands at [j * s + i]. */
typedef struct {
    fvi_run own;        /* with a law alpha = 1/2, which then is not read */
    const fvi_run *run; /* it */
    const fvi_sensitivities *want;
    const fvi_lobatto_rule *rule;
    size_t s, d;
    int damped_inertia;         /* form D */
    int mass_plus_damping;                  /* form M, alpha = 1: rho is a mass, (17.17) */
    double unit;                /* h^(-beta), or 1 of a law */
    fvi_stage_matrix K, E;      /* D^T B D and D^T B P; of form D: A^2 and A */
    fvi_stage_matrix W, rate;   /* W_0, and its derivative by beta */
    double *Lambda, *T;         /* s d numbers each */
    double *past, *pastdot;     /* s d numbers each: what is known of T, Tdot */
    double *G, *column, *Q, *r; /* s Hessians; d; d; s d */
    double *mass, *after;       /* d numbers each: inertia; lambda_{k+1} */
    double *last;               /* d numbers: J_p p_N */
    double *kinetic, *sum, *sumdot, *plain, *pull, *impulse_sum_by_order; /* d each */
    double *block;                                           /* these; owned */
    fvi_lobatto_history *memory;  /* NULL: nothing is damped, or W is 1 */
    size_t terms;                /* of a law whose terms are wanted, */
    fvi_adjoint_lobatto_term *each; /* their memories; owned */
    int is_damped, has_initial_impulses;
    fvi_kernel_impulse initial_impulse;
    fvi_band J;
} fvi_adjoint_lobatto;

/* As fvi_adjoint_multistep_start, _step, _end and _stop.
 *
 *   p     p_N
 *   rows  x_k, and the positions of the stages behind the first; of form D of all */
int fvi_adjoint_lobatto_start(const fvi_method *method, const fvi_run *run,
                            const fvi_sensitivities *want, const double *p,
                            const double *Jp, fvi_adjoint_lobatto *m);
int fvi_adjoint_lobatto_step(fvi_adjoint_lobatto *m, size_t k, const double *rows,
                           const double *Jx);
int fvi_adjoint_lobatto_end(fvi_adjoint_lobatto *m, const double *Jx);
void fvi_adjoint_lobatto_stop(fvi_adjoint_lobatto *m);

/* fvi_adjoint_lobatto_solve -- the equation of a step, (23.13) or (23.15): Lambda from
 * `after`, Q and what is known of T; and Q of the next. G is there. Errors FVI_ESING. */
int fvi_adjoint_lobatto_solve(fvi_adjoint_lobatto *m);

/* fvi_adjoint_terms_start, _meet, _remember, _stop -- what the terms of a law give: coordinate
 * j with the velocities v of its stages; T, which goes into all memories. */
int fvi_adjoint_terms_start(fvi_adjoint_lobatto *m);
void fvi_adjoint_terms_accumulate(fvi_adjoint_lobatto *m, size_t j, const double *v);
int fvi_adjoint_terms_update_history(fvi_adjoint_lobatto *m);
void fvi_adjoint_terms_stop(fvi_adjoint_lobatto *m);

/* fvi_adjoint_lobatto_matrices -- what it needs, W and unit being there. */
void fvi_adjoint_lobatto_matrices(fvi_adjoint_lobatto *m);

#endif
