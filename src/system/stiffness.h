/* src/system/stiffness.h -- Bound the eigenvalues of a Hessian.  [H 18] */
#ifndef FVI_STIFFNESS_H
#define FVI_STIFFNESS_H

#include <fvi/system.h>

/* fvi_stiffness -- Return max_i sum_j |H_ij| / m_i. By Gershgorin's theorem no eigenvalue of M^{-1} H exceeds this
 * number in magnitude.
 *
 *   H  the Hessian in the form of system->potential.hessian: d * d numbers, or its diagonals
 *
 * Cost: reads a full H once, and a band twice. */
double fvi_stiffness(const fvi_system *system, const double *H);

/* fvi_potential_stiffness -- Compute the same number from the Hessian at x, of a potential that has one. Return
 * FVI_SUCCESS; FVI_ENOMEM; what the Hessian returned. The error handler is not called. */
int fvi_potential_stiffness(const fvi_system *system, const double *x, double *stiffness);

#endif
