/* src/system/stiffness.h -- A bound of the eigenvalues of a Hessian.  [H 18] */
#ifndef FVI_STIFFNESS_H
#define FVI_STIFFNESS_H

#include <fvi/system.h>

/* fvi_stiffness -- max_i sum_j |H_ij| / m_i: no |eigenvalue| of M^{-1} H is above it
 * (Gershgorin).
 *
 *   H  as system->potential.hessian writes it, d * d numbers or its diagonals
 *
 * Cost: reads H once, a band twice. */
double fvi_stiffness(const fvi_system *system, const double *H);

#endif
