/* src/stability/stability_share.h -- The loads that src/methods/stability_number.c takes from this room. [H 14] */
#ifndef FVI_STABILITY_SHARE_H
#define FVI_STABILITY_SHARE_H

#include <fvi/trajectory.h>

/* fvi_stability_share -- the load (14.3) with share * rho in the place of rho. Arguments and errors are those of
 * fvi_stability_number for the methods fvi and lda. */
int fvi_stability_share(double share, const fvi_run *run, double *load);

/* fvi_stability_of_dampers -- the same load for a system with several damping matrices C_j. damper_j, the factor of
 * C_j, is h^2 times the value of the kernel's symbol that the method uses. */
int fvi_stability_of_dampers(const double *damper, const fvi_run *run, double *load);

/* fvi_stability_of_matrices -- a quarter of the largest eigenvalue of (spring K + sum_j damper_j C_j) v = lambda M v.
 * [(27.9)]
 *
 *   damper  one number for C, or one for each of the dampers; NULL: zeros
 *   load    output; a lower bound, within some percent, by 64 products and solutions
 *
 * Returns FVI_SUCCESS; FVI_EUNSUP if a damper is negative and another term is positive; FVI_EOVRFLW; FVI_ENOMEM; what a
 * function of the matrices returned. On error *load is untouched. */
int fvi_stability_of_matrices(double spring, const double *damper, const fvi_run *run,
                              double *load);

/* fvi_stability_explicit -- the load (14.8) of Euler's explicit method. Arguments and errors are those of
 * fvi_stability_number, and FVI_EUNSUP for more than 64 masses with springs between them. */
int fvi_stability_explicit(const fvi_run *run, double *load);

#endif
