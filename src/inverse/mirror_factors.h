/* src/inverse/mirror_factors.h -- Derivatives by factors of M, C and K. [Chapter 23]
 *
 * Internal: what mirror_matrices.c sums up on its way back for mass, damping, alpha and
 * parameters, (23.19): x0, p0 and forces it has without. */
#ifndef FVI_MIRROR_FACTORS_H
#define FVI_MIRROR_FACTORS_H

#include <fvi/adjoint.h>
#include <fvi/convolution_quadrature.h>

enum { FVI_FACTOR_TAPS = FVI_BDF2_TAPS + 1 };

/* Where the comment says "each", d numbers; r of them are remembered. */
typedef struct {
    const fvi_run *run;
    const fvi_gradients *want;
    size_t d, r;
    double kappa; /* of the method, or of the run */
    int is_late;  /* nu_j has lambda_{j-1}, (23.7): not so in Algorithm 3 */
    int has_drift;
    double *v0;           /* each: M^-1 p0; 0 where no velocity is asked for */
    double *z;            /* each: z_j */
    double *work;         /* each */
    double *entered;      /* r: B^T lambda as it came into the memory last */
    double *change;       /* r: how it changed */
    double *N, *dN;       /* r: N_j, and its derivative by alpha */
    double *sums, *rates; /* r each of FVI_FACTOR_TAPS: what the memory gave */
    double *block;        /* all these; owned */
    fvi_memory *memory;   /* of B^T lambda; NULL: not asked for */
    size_t taps, place;   /* the latest sums are at [place] */
    double f[FVI_FACTOR_TAPS], df[FVI_FACTOR_TAPS]; /* and by alpha */
    double by_M, by_C, by_alpha, by_K;
} fvi_mirror_factors;

/* fvi_mirror_factors_start -- at node N.
 *
 *   method  its scheme is FVI_SCHEME_ALGORITHM_3, SHIFTED, BDF2 or STABLE
 *   run, want  stay the caller's
 *   f       output; in any case to be given back by fvi_mirror_factors_stop
 *
 * Returns FVI_SUCCESS; FVI_EUNSUP if mass is wanted and the matrices have no inertia;
 * FVI_ENOMEM; what factorise, solve and fvi_memory_alloc returned. */
int fvi_mirror_factors_start(const fvi_method *method, const fvi_run *run,
                             const fvi_gradients *want, fvi_mirror_factors *f);

/* fvi_mirror_factors_step -- from node k + 1 to node k.
 *
 *   rows         x_k and x_{k+1}, d numbers each
 *   right, left  lambda_{k+1} and lambda_k, d numbers each */
int fvi_mirror_factors_step(fvi_mirror_factors *f, size_t k, const double *rows,
                            const double *right, const double *left);

/* fvi_mirror_factors_end -- at node 0: what is wanted.
 *
 *   drag   dJ/dp0 - lambda_0, d numbers
 *   unit   h^(1 + e) of a past that pulls, else 0
 *   pull, pull_rate  its impulses times lambda, d numbers each, and their slope by e */
int fvi_mirror_factors_end(fvi_mirror_factors *f, const double *drag,
                           double unit, const double *pull,
                           const double *pull_rate);

void fvi_mirror_factors_stop(fvi_mirror_factors *f);

#endif
