/* src/fvi/convolution_quadrature_methods.h -- Three integrators of order 2: fvi-shifted, fvi-bdf2 and fvi-stable.
 *                                                                [H 13]
 *
 * They are variational like fvi_fractional (fvi.h), and take the damping at another moment or with other weights. */
#ifndef FVI_CONVOLUTION_QUADRATURE_METHODS_H
#define FVI_CONVOLUTION_QUADRATURE_METHODS_H

#include "trajectory.h"

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(default)

/* fvi_cq2_shifted, fvi_cq_bdf2, fvi_cq2_midpoint -- integrators of order 2 in x and in p.
 *
 * The order was measured at a fixed t at which F does not jump, for kappa = 1/2; for other kappa it is 1. Over all t it
 * may be lower (19.9). A step solves
 *
 *     D1 L_d(x_k, x_{k+1}) + D2 L_d(x_{k-1}, x_k)
 *         - h rho ((1 - theta) D_k + theta D_{k+1}) + h F_k = 0,     [(13.7)]
 *
 * with D_k = h^(-2 alpha) sum_n w_n z_{k-n}. p_k is the momentum (13.9), from p_0 on.
 *
 *   fvi_cq2_shifted   "fvi-shifted": theta = alpha, weights of EULER. Implicit in the damping. For a quadratic U >= 0
 *                     it is stable for every step if alpha >= 1/2 and kappa = 1/2 (13.14). At alpha = 1 it is
 *                     Algorithm 1 with the mass m + rho
 *   fvi_cq_bdf2       "fvi-bdf2": theta = 0, weights of BDF2. Explicit in the damping. Its stable steps are shorter
 *                     than those of fvi_fractional
 *   fvi_cq2_midpoint  "fvi-stable": theta = kappa = 1/2 (run->kappa is not used), weights of EULER, and the mean
 *                     (1/2 + alpha) z_k + (1/2 - alpha) z_{k-1} in the place of z_k. Implicit in the damping. For a
 *                     quadratic U >= 0 it is stable for every step and alpha (13.17), but it hardly damps a motion that
 *                     alternates from step to step. With a law: BDF2 and the plain mean of z_k and z_{k-1} (26.15),
 *                     stable for every step and every law without springs. It also takes mechanisms (dampers.h)
 *
 *     status = fvi_stepper_start(&fvi_cq2_midpoint, &run, &s, &error);
 *     while (!status && s->k < run.steps)
 *         status = fvi_stepper_step(s);
 *
 * All three take matrices (structures.h) and laws (damping_laws.h); fvi_cq2_shifted corrects the symbol of a law
 * (26.19). D_k is Caputo's: z = x - x0, or x - x0 - t v0 if 2 alpha > 1. What another past adds to it is a force that
 * is known beforehand (19.3), and the methods apply its exact impulses (19.5).
 * F may jump at nodes (13.12): F_k is the mean of both limits of F at t_k, taken 4 ulp before and after t_k, and each
 * step uses the limit on its own side. In the first few steps after the start, or after a jump of F, the error of p is
 * larger and falls more slowly with h; this does not spread to later steps.
 * Cost of a step: that of fvi_fractional, and two values of F. fvi_cq2_shifted and fvi_cq2_midpoint sum a DIRECT memory
 * twice. For each damped coordinate fvi_cq_bdf2 takes 36 products more, and fvi_cq2_midpoint 2.
 * Errors: those of fvi_stepper_start and fvi_stepper_step; fvi_stepper_start also returns FVI_EDOM if
 * m/h + theta rho h^(1 - 2 alpha) overflows. */
extern const fvi_method fvi_cq2_shifted;
extern const fvi_method fvi_cq_bdf2;
extern const fvi_method fvi_cq2_midpoint;

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
