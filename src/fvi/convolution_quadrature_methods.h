/* src/fvi/convolution_quadrature_methods.h -- The integrators of order 2 that they give.
 *                                                                [H 13] */
#ifndef FVI_CONVOLUTION_QUADRATURE_METHODS_H
#define FVI_CONVOLUTION_QUADRATURE_METHODS_H

#include "trajectory.h"

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(default)

/* Three integrators of order 2 in x and in p, measured at a fixed t at which F does not
 * jump, for kappa = 1/2 (else of order 1); over all t it may be lower (19.9):
 *
 *     D1 L_d(x_k, x_{k+1}) + D2 L_d(x_{k-1}, x_k)
 *         - h rho ((1 - theta) D_k + theta D_{k+1}) + h F_k = 0,     [(13.7)]
 *
 * D_k = h^(-2 alpha) sum_n w_n z_{k-n}. p_k is the momentum (13.9), from p_0 on.
 *
 *   fvi_cq2_shifted  theta = alpha, EULER: implicit; for a quadratic U >= 0 stable for
 *                every step if alpha >= 1/2 and kappa = 1/2 (13.14); at alpha = 1
 *                nothing is lost
 *   fvi_cq_bdf2     theta = 0, BDF2: explicit memory, stable for shorter steps than
 *                Algorithm 3
 *   fvi_cq2_midpoint   theta = kappa = 1/2 (run->kappa is not used), EULER, of the mean
 *                (1/2 + alpha) z_k + (1/2 - alpha) z_{k-1} in place of z_k: implicit, and
 *                for a quadratic U >= 0 stable for every step and alpha (13.17), but
 *                what alternates from step to step is hardly damped. Of a law: BDF2 and
 *                the plain mean (26.15), stable for every step and law without springs
 *
 * All three take matrices (structures.h) and laws (damping_laws.h), of which fvi_cq2_shifted
 * corrects the symbol (26.19). D_k is Caputo's: z = x - x0 or, if
 * 2 alpha > 1, x - x0 - t v0. What another past adds to it is a force that is known
 * beforehand (19.3) and acts by its exact impulses (19.5). F_k is the mean of both limits
 * of F at t_k, taken 4 ulp away, and each step begins and ends with the
 * limit on its own side: F may jump at nodes (13.12). In the first few steps after
 * the start, or after a jump of F, the error of p is larger and falls more slowly
 * with h; that does not spread. Cost of a step: as Algorithm 3, and two values of
 * F; the DIRECT memory of fvi_cq2_shifted sums twice; BDF2 takes 36 products a
 * damped coordinate more, fvi_cq2_midpoint 2. Errors as fvi_stepper_start and fvi_stepper_step; fvi_stepper_start also
 * returns FVI_EDOM if m/h + theta rho h^(1 - 2 alpha) overflows. */
extern const fvi_method fvi_cq2_shifted;
extern const fvi_method fvi_cq_bdf2;
extern const fvi_method fvi_cq2_midpoint;

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
