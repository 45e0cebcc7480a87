/* src/kernel/kernel_general.h -- Kernels that are no fractions of powers.      [H 26]
 *
 * This header is internal, and its functions check nothing. A general term is no fraction of powers and no range of
 * orders: a DAVIDSON with time > 0, for example, or a SYMBOL. Its weights come from Cauchy's integral of the symbol.
 * Its modes come from the values of the symbol on the cut, or from a formula of its kind. */
#ifndef FVI_KERNEL_GENERAL_H
#define FVI_KERNEL_GENERAL_H

#include "kernel_terms.h"

/* fvi_kernel_is_fraction -- Write a term that is one fraction of powers, and return 1; else return 0.
 * fvi_kernel_is_general -- Return 1 if the term is general, that is, if fvi_kernel_flatten cannot represent it. */
int fvi_kernel_is_fraction(const fvi_kernel_term *t, fvi_kernel_simple *fraction);
int fvi_kernel_is_general(const fvi_kernel_term *t);

/* fvi_kernel_has_general -- Return 1 if the law has a general term with rho > 0. Then the last digits of the weights
 * depend on the number of weights. */
int fvi_kernel_has_general(const fvi_kernel *law);

/* fvi_kernel_singularity -- Return what the symbol of the law has beside its cut, for a complaint: "a pole", "a branch
 * point", or "a pole or a branch point". A HAVRILIAK or a DAVIDSON has a branch point, unless it is a fraction; of a
 * SYMBOL nothing is known. */
const char *fvi_kernel_singularity(const fvi_kernel *law);

/* fvi_kernel_is_on_cut -- Return 1 if the term is general, has rho > 0, and its modes come from its symbol on the
 * cut. */
int fvi_kernel_is_on_cut(const fvi_kernel_term *t);

/* fvi_kernel_unit_at -- Return C(s) of one term with rho = 1 at s = modulus e^(i angle).
 * fvi_kernel_term_at -- Return rho C(s). */
double complex fvi_kernel_unit_at(const fvi_kernel_term *t, double modulus, double angle);
double complex fvi_kernel_term_at(const fvi_kernel_term *t, double modulus,
                                  double angle);

/* fvi_kernel_general_weights -- Add to w the first `count` coefficients of rho C(delta(z)/h), summed over all general
 * terms of the law. With increments = 1 the series is divided by 1 - z.
 *
 * Accuracy: some 10 u of the largest weight. Cost: 8 count values of each symbol and O(count ln count) operations.
 * Return FVI_SUCCESS or FVI_ENOMEM. */
int fvi_kernel_general_weights(const fvi_kernel *law, fvi_delta kind, double h,
                               int increments, size_t count, double *w);

/* A list of modes, for example of C(s)/s = (a part without memory) + sum_j weight_j / (s + rate_j). { 0 } is empty. */
typedef struct {
    size_t count, room;    /* number of modes; number of modes for which there is memory */
    double *rate, *weight; /* one block, which begins with rate: free(rate) frees the list */
    int is_incomplete;     /* nonzero if memory was short for a mode */
} fvi_kernel_modes;

/* fvi_kernel_modes_add -- Append a mode. If memory is short, the list becomes incomplete.
 * fvi_kernel_modes_check -- Return FVI_SUCCESS, or FVI_ENOMEM if the list is incomplete. */
void fvi_kernel_modes_add(fvi_kernel_modes *modes, double rate, double weight);
int fvi_kernel_modes_check(const fvi_kernel_modes *modes);

/* fvi_kernel_modes_of -- Append the modes of one general term, including its rho, to a list.
 *
 *   slowest, fastest  the range of rates to resolve: one over the longest time and one over the shortest time of
 *                     interest
 *   delta             relative error, 1e-16 to 1e-2
 *   strip             for modes from the symbol on the cut: the width of the strip beyond the cut in which the symbol
 *                     is analytic as a function of ln s, divided by pi/2
 *   modes             the list; the caller frees it, also after an error
 *
 * A DAVIDSON with 2 alpha >= 0.95 or 2 alpha < 0.02 has no modes. Return FVI_SUCCESS; FVI_EUNSUP, without a call of the
 * error handler, if there are no modes; FVI_ENOMEM. */
int fvi_kernel_modes_of(const fvi_kernel_term *t, double slowest,
                        double fastest, double delta, double strip,
                        fvi_kernel_modes *modes);

/* fvi_davidson_modes -- The same for a DAVIDSON. It does not check whether the list is complete. */
int fvi_davidson_modes(const fvi_kernel_term *t, double slowest, double delta, fvi_kernel_modes *m);

#endif
