/* src/stages/lobatto_general.h -- Weights and modes of a general term on Lobatto nodes.            [H 26]
 *
 * This header is internal, and its functions check nothing. A general term is no fraction of powers:
 * fvi_kernel_is_general is 1. */
#ifndef FVI_LOBATTO_GENERAL_H
#define FVI_LOBATTO_GENERAL_H

#include "lobatto_weights.h"
#include "kernel/kernel_general.h"

/* fvi_lobatto_contour -- Add to W the first `count` matrices of rho C(Delta(z)/h) (Delta(z)/h)^{-1}, by Cauchy's
 * integral around the eigenvalues of A^{-1}. Accuracy: 100 u of the largest entry for count <= FVI_LAGS + 1; each
 * further matrix loses a factor of ten. */
void fvi_lobatto_contour(size_t s, const fvi_kernel_term *t, double h,
                         size_t count, double *W);

/* fvi_lobatto_general_modes -- Append the modes for lags FVI_LAGS < n <= N. The list and the codes are those of
 * fvi_kernel_modes_of. */
int fvi_lobatto_general_modes(size_t s, const fvi_kernel_term *t, double h,
                              double N, double tolerance, double strip,
                              fvi_kernel_modes *modes);

/* fvi_lobatto_general_strip -- Write to *strip the width of the strip, divided by pi/2, with which the modes agree with
 * Cauchy's integral: 1, 1/2, 1/4 or 1/8; 0 if no width does. Return FVI_SUCCESS or FVI_ENOMEM. */
int fvi_lobatto_general_strip(size_t s, const fvi_kernel_term *t, double h, double *strip);

#endif
