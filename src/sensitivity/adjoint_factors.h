/* src/sensitivity/adjoint_factors.h -- Derivatives by factors of M, C and K. [H 23]
 *
 * Internal: what adjoint_matrices.c sums up on its way back for mass, damping, alpha,
 * parameters and the numbers of a law, (23.19): x0, p0 and forces it has without. */
#ifndef FVI_ADJOINT_FACTORS_H
#define FVI_ADJOINT_FACTORS_H

#include "adjoint_kernel.h"

#include <fvi/adjoint.h>
#include <fvi/convolution_quadrature.h>

/* What goes into a memory, r numbers each: as it is and its increment, and what comes out,
 * with its derivative by 2 alpha. */
typedef struct {
    fvi_history *memory; /* NULL: not asked for */
    double *in, *change, *out, *rate;
} fvi_adjoint_sum;

/* Where the comment says "each", d numbers; r of them are remembered. */
typedef struct {
    const fvi_run *run;
    fvi_sensitivities want; /* with room of its own for the terms of a law */
    size_t d, r;
    double kappa, theta; /* of the method, or of the run; (23.7) */
    int paper_convention;         /* Algorithm 3 */
    int has_drift;
    double *v0;          /* each: M^-1 p0; 0 where no velocity is asked for */
    double *z;           /* each: z_j */
    double *work, *room; /* each */
    double *nu, *tilt;   /* each: nu_j, its derivative by alpha */
    double *behind;      /* each: nu_{j+1}, or the mean of both and its */
    double *change;      /* each: increment */
    double *N, *dN;      /* r: N_j, and its derivative by alpha */
    double *past, *past_rate; /* r each of FVI_BDF2_TAPS: the last sums */
    double *block;            /* all these; owned */
    fvi_adjoint_sum sum, tilted;
    size_t taps, place; /* of the factor; the latest sums are at [place] */
    double g[FVI_BDF2_TAPS], dg[FVI_BDF2_TAPS];
    fvi_adjoint_term *each; /* of a law; owned */
    size_t terms;
    double *by_terms; /* room for want.terms; owned */
    double by_M, by_C, by_alpha, by_K;
} fvi_adjoint_factors;

/* fvi_adjoint_factors_start -- at node N.
 *
 *   method  its scheme is FVI_SCHEME_FVI, SHIFTED, BDF2 or STABLE
 *   run     stays the caller's
 *   f       output; in any case to be given back by fvi_adjoint_factors_stop
 *
 * Returns FVI_SUCCESS; FVI_EUNSUP if mass is wanted and the matrices have no inertia;
 * FVI_ENOMEM; what factorise, solve, fvi_history_alloc and fvi_adjoint_term_start returned. */
int fvi_adjoint_factors_start(const fvi_method *method, const fvi_run *run,
                             const fvi_sensitivities *want, fvi_adjoint_factors *f);

/* fvi_adjoint_factors_step -- from node k + 1 to node k.
 *
 *   rows         x_k and x_{k+1}, d numbers each
 *   right, left  lambda_{k+1} and lambda_k, d numbers each */
int fvi_adjoint_factors_step(fvi_adjoint_factors *f, size_t k, const double *rows,
                            const double *right, const double *left);

/* fvi_adjoint_factors_end -- at node 0: what is wanted.
 *
 *   drag   dJ/dp0 - lambda_0, d numbers
 *   unit   h^(1 + e) of a past that pulls, else 0
 *   pull, pull_rate  its impulses times lambda, d numbers each, and their slope by e */
int fvi_adjoint_factors_end(fvi_adjoint_factors *f, const double *drag,
                           double unit, const double *pull,
                           const double *pull_rate);

void fvi_adjoint_factors_stop(fvi_adjoint_factors *f);

#endif
