/* src/sensitivity/adjoint_multistep.h -- The run that goes backwards.                 [H 23]
 *
 * Internal: adjoint.c walks from node N to node 0; here is what happens there. */
#ifndef FVI_ADJOINT_MULTISTEP_H
#define FVI_ADJOINT_MULTISTEP_H

#include <fvi/adjoint.h>
#include <fvi/convolution_quadrature.h>
#include "adjoint_kernel.h"
#include "system/band.h"

/* One mirrored run. Where the comment says "each", d numbers. */
typedef struct {
    const fvi_run *run;
    const fvi_sensitivities *want;
    size_t d;
    double theta, end; /* the shift; what of H_N stands in p_N, (23.7) */
    double kappa;      /* of the method, or of the run */
    int paper_convention; /* Algorithm 3: no pull, Riemann-Liouville by its weights */

    double *c, *inertia;    /* each: rho h^(1 - 2 alpha); m/h + theta c g_0 */
    double *origin, *drift; /* each: z_j = x_j - origin - j drift */
    double *lambda, *delta; /* each: lambda_j, lambda_{j-1} - lambda_j */
    double *q;              /* each: the momentum of the mirrored run */
    double *nu, *dnu;       /* each: what the memory takes in, (23.7) */
    double *N, *Ndot; /* each: what it gives, and its derivative by 2 alpha */
    double *column;   /* each: of the sensitivity */
    double *M, *S, *work;   /* each */
    double *sum, *rate;     /* each: sum_j z_j N_j, sum_j z_j Ndot_j */
    double *plain, *linear; /* each: sum_j N_j, sum_j j N_j */
    double *kinetic; /* each: sum_k (x_{k+1}-x_k)(lambda_{k+1}-lambda_k) */
    double *pull, *impulse_sum_by_order; /* each: impulses of the past times lambda */
    double *shift, *before; /* each: the derivative by theta; d nu/d theta */
    double *block;          /* all these; owned */

    double unit;                /* h^(1 - 2 alpha), or h w_0 of a law */
    fvi_history *memory, *slope; /* of nu; of d nu/d theta. NULL: not needed */
    size_t terms;               /* of a law whose terms are wanted, */
    fvi_adjoint_term *each;      /* their memories; owned */
    size_t taps;                /* of a factor of the weights; 0: none */
    double g[FVI_BDF2_TAPS], gdot[FVI_BDF2_TAPS]; /* (13.11), (13.16) */
    double *sums, *rates; /* its last terms, FVI_BDF2_TAPS each; owned */
    int has_initial_impulses;
    fvi_kernel_impulse initial_impulse;

    fvi_band J; /* m/h + theta c + kappa (1 - kappa) h G, its factors */
    double *G;  /* the Hessian; NULL: no potential; owned */
    int is_quadratic, is_ready; /* U is, and J and G stay as they are */
} fvi_adjoint_multistep;

/* fvi_adjoint_factor -- what the weights of a power have besides (1 - z)^(2 alpha).
 *
 *   scheme   as below
 *   g, gdot  output, zeros, FVI_BDF2_TAPS numbers each: the factor by powers of z, (13.11)
 *            or (13.16), and its derivative by 2 alpha
 *
 * Returns how many of them there are; 1 if there is no factor. */
size_t fvi_adjoint_factor(fvi_scheme scheme, double alpha, double *g,
                         double *gdot);

/* fvi_adjoint_multistep_start -- at node N, where lambda_N = J_p.
 *
 *   method  its scheme is FVI_SCHEME_FVI, SHIFTED, BDF2 or STABLE
 *   run, want  stay the caller's
 *   Jp      d numbers
 *   m       output; in any case to be given back by fvi_adjoint_multistep_free */
int fvi_adjoint_multistep_start(const fvi_method *method, const fvi_run *run,
                     const fvi_sensitivities *want, const double *Jp,
                     fvi_adjoint_multistep *m);

/* fvi_adjoint_multistep_step -- from node k + 1 to node k.
 *
 *   rows  x_k and x_{k+1}, d numbers each
 *   Jx    dJ/dx_{k+1}, d numbers */
int fvi_adjoint_multistep_step(fvi_adjoint_multistep *m, size_t k, const double *rows,
                    const double *Jx);

/* fvi_adjoint_last -- nu_0 = 0 goes into the memory; N_0 comes out. */
int fvi_adjoint_last(fvi_adjoint_multistep *m);

/* fvi_adjoint_multistep_end -- at node 0: all derivatives.   Jx: dJ/dx_0, d numbers */
int fvi_adjoint_multistep_end(fvi_adjoint_multistep *m, const double *Jx);

void fvi_adjoint_multistep_free(fvi_adjoint_multistep *m);

#endif
