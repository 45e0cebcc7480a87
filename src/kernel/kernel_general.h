/* src/kernel/kernel_general.h -- Kernels that are no fractions of powers.      [H 26]
 *
 * Internal; nothing is checked. A term of the kind DAVIDSON or SYMBOL is known by its symbol:
 * its weights by Cauchy's integral, its tail by the values of the symbol on the cut. */
#ifndef FVI_KERNEL_GENERAL_H
#define FVI_KERNEL_GENERAL_H

#include "kernel_terms.h"

/* fvi_kernel_is_general -- is the term none of those that fvi_kernel_flatten knows? */
int fvi_kernel_is_general(const fvi_kernel_term *t);

/* fvi_kernel_has_general -- does such a term act? Then the last digits of the weights depend on how many there are. */
int fvi_kernel_has_general(const fvi_kernel *law);

/* fvi_kernel_term_at -- rho C(s) of one term at s = modulus e^(i angle). */
double complex fvi_kernel_term_at(const fvi_kernel_term *t, double modulus,
                                  double angle);

/* fvi_kernel_general_weights -- adds to w the first `count` coefficients of rho C(delta(z)/h), divided by 1 - z if
 * `increments` is 1, of all such terms of a law. To some 10 u of the largest, O(count ln count) with 8 count values
 * of the symbol. Returns FVI_SUCCESS or FVI_ENOMEM. */
int fvi_kernel_general_weights(const fvi_kernel *law, fvi_delta kind, double h,
                               int increments, size_t count, double *w);

/* C(s)/s = (what has no memory) + sum_j weight_j / (s + rate_j) */
typedef struct {
    size_t count;
    double *rate, *weight; /* one block, of which rate is the first */
} fvi_kernel_modes;

/* fvi_kernel_modes_of -- of one general term with its rho.
 *
 *   slowest, fastest  what the rates shall resolve: one over the longest and the shortest
 *                     time that is asked for
 *   delta             relative error, 1e-16 to 1e-2
 *   strip             of a SYMBOL: it is analytic, as a function of ln s, so far beyond the
 *                     cut, as a part of pi/2
 *   modes             output; free(modes->rate)
 *
 * A DAVIDSON with 2 alpha >= 0.95 has none, nor has a term with an order near 0.
 * Returns FVI_SUCCESS; FVI_EUNSUP, without a call of the error handler, where there are
 * none; FVI_ENOMEM. */
int fvi_kernel_modes_of(const fvi_kernel_term *t, double slowest,
                        double fastest, double delta, double strip,
                        fvi_kernel_modes *modes);

#endif
