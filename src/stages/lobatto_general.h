/* src/stages/lobatto_general.h -- A symbol alone, on Lobatto nodes.            [H 26]
 *
 * Internal; nothing is checked. Of a term that is no fraction of powers, fvi_kernel_is_general. */
#ifndef FVI_LOBATTO_GENERAL_H
#define FVI_LOBATTO_GENERAL_H

#include "lobatto_weights.h"
#include "kernel/kernel_general.h"

/* fvi_lobatto_contour -- adds to W the first `count` matrices of rho C(Delta(z)/h)
 * (Delta(z)/h)^{-1}, by Cauchy's integral around the eigenvalues of A^{-1}. To 100 u of the
 * largest for count up to FVI_LAGS + 1, and ten times less with each more. */
void fvi_lobatto_contour(size_t s, const fvi_kernel_term *t, double h,
                         size_t count, double *W);

/* fvi_lobatto_general_modes -- fvi_kernel_modes_of, for lags FVI_LAGS < n <= N. */
int fvi_lobatto_general_modes(size_t s, const fvi_kernel_term *t, double h,
                              double N, double tolerance, double strip,
                              fvi_kernel_modes *modes);

/* fvi_lobatto_general_strip -- the widest strip with which these modes give what Cauchy's
 * integral gives, a part of pi/2; 0 if there is none. */
double fvi_lobatto_general_strip(size_t s, const fvi_kernel_term *t, double h);

#endif
