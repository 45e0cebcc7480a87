/* src/inverse/mirror_stages.h -- The run that goes backwards through stages. [Chapter 23]
 *
 * Internal: what mirror.h is for the methods of chapter 17, of form M and of form D. */
#ifndef FVI_MIRROR_STAGES_H
#define FVI_MIRROR_STAGES_H

#include <fvi/adjoint.h>
#include "mirror_law.h"
#include "stages/lobatto_memory.h"
#include "system/band.h"

typedef struct fvi_mirror_stage_term fvi_mirror_stage_term;

typedef double fvi_stage_matrix[FVI_STAGES][FVI_STAGES];

/* Stage i of coordinate j stands at [j * s + i]. */
typedef struct {
    fvi_run own;        /* with a law alpha = 1/2, which then is not read */
    const fvi_run *run; /* it */
    const fvi_gradients *want;
    const fvi_lobatto_rule *rule;
    size_t s, d;
    int damped_inertia;         /* form D */
    int heavy;                  /* form M, alpha = 1: rho is a mass, (17.17) */
    double unit;                /* h^(-beta), or 1 of a law */
    fvi_stage_matrix K, E;      /* D^T B D and D^T B P; of form D: A^2 and A */
    fvi_stage_matrix W, rate;   /* W_0, and its derivative by beta */
    double *Lambda, *T;         /* s d numbers each */
    double *past, *pastdot;     /* s d numbers each: what is known of T, Tdot */
    double *G, *column, *Q, *r; /* s Hessians; d; d; s d */
    double *mass, *after;       /* d numbers each: inertia; lambda_{k+1} */
    double *last;               /* d numbers: J_p p_N */
    double *kinetic, *sum, *sumdot, *plain, *pull, *pulldot; /* d each */
    double *block;                                           /* these; owned */
    fvi_lobatto_memory *memory;  /* NULL: nothing is damped, or W is 1 */
    size_t terms;                /* of a law whose terms are wanted, */
    fvi_mirror_stage_term *each; /* their memories; owned */
    int is_damped, is_pulled;
    fvi_past_pull fading;
    fvi_band J;
} fvi_mirror_stages;

/* As fvi_mirror_start, _step, _end and _stop.
 *
 *   p     p_N
 *   rows  x_k, and the positions of the stages behind the first; of form D of all */
int fvi_mirror_stages_start(const fvi_method *method, const fvi_run *run,
                            const fvi_gradients *want, const double *p,
                            const double *Jp, fvi_mirror_stages *m);
int fvi_mirror_stages_step(fvi_mirror_stages *m, size_t k, const double *rows,
                           const double *Jx);
int fvi_mirror_stages_end(fvi_mirror_stages *m, const double *Jx);
void fvi_mirror_stages_stop(fvi_mirror_stages *m);

/* fvi_mirror_stages_solve -- the equation of a step, (23.13) or (23.15): Lambda from
 * `after`, Q and what is known of T; and Q of the next. G is there. Errors FVI_ESING. */
int fvi_mirror_stages_solve(fvi_mirror_stages *m);

/* fvi_mirror_terms_start, _meet, _remember, _stop -- what the terms of a law give: coordinate
 * j with the velocities v of its stages; T, which goes into all memories. */
int fvi_mirror_terms_start(fvi_mirror_stages *m);
void fvi_mirror_terms_meet(fvi_mirror_stages *m, size_t j, const double *v);
int fvi_mirror_terms_remember(fvi_mirror_stages *m);
void fvi_mirror_terms_stop(fvi_mirror_stages *m);

/* fvi_mirror_stages_matrices -- what it needs, W and unit being there. */
void fvi_mirror_stages_matrices(fvi_mirror_stages *m);

#endif
