/* src/kernel/kernel_ready.h -- A law prepared for one step length, to compute its modes and its history. [H 26]
 *
 * This header is internal, and its functions check nothing. */
#ifndef FVI_KERNEL_READY_H
#define FVI_KERNEL_READY_H

#include "kernel_general.h"

typedef struct {
    const fvi_kernel *law;
    fvi_kernel_simple *term; /* the terms of the law that are not general, as simple terms */
    size_t terms;            /* number of simple terms */
    fvi_delta kind;          /* quadrature: C(delta(z)/h) generates the weights */
    double h;                /* step length */
    int increments;          /* 1 if the history sums increments; then C(delta(z)/h) / (1 - z) generates the weights */
    double strip;            /* width of the strip of terms on the cut (fvi_kernel_is_on_cut), divided by pi/2; 0 if one
                                of them has no modes */
} fvi_kernel_ready;

/* fvi_kernel_ready_has_modes -- Write to *has whether the weights behind the window are a sum of decaying modes (26.6).
 * Return FVI_SUCCESS or FVI_ENOMEM. */
int fvi_kernel_ready_has_modes(const fvi_kernel_ready *r, int *has);

/* fvi_kernel_ready_modes -- Compute the modes of the weights for lags n up to N: w_n = sum_q c_q exp(-n s_q) with the
 * relative error delta.
 *
 *   modes  output: a list of the rates s_q and the weights c_q, which the caller frees, also after an error
 *
 * The modes of the cut come first, then those of the poles, and then a spring if the history sums increments. Return
 * FVI_SUCCESS or FVI_ENOMEM; or FVI_EUNSUP if a term with modes of its own has none. */
int fvi_kernel_ready_modes(const fvi_kernel_ready *r, double N, double delta, fvi_kernel_modes *modes);

#endif
