/* src/stability/stability_share.h -- Loads that src/methods/stability_number.c asks for.
 *                                                                [H 14] */
#ifndef FVI_STABILITY_SHARE_H
#define FVI_STABILITY_SHARE_H

#include <fvi/trajectory.h>

/* fvi_stability_share -- (14.3) with share rho for rho. All else, and the
 * errors, as for the methods fvi and lda in fvi_stability_number. */
int fvi_stability_share(double share, const fvi_run *run, double *load);

/* fvi_stability_of_dampers -- the same of a system with several: damper_j, h^2 times what the
 * method takes of the kernel, stands before C_j. */
int fvi_stability_of_dampers(const double *damper, const fvi_run *run, double *load);

/* fvi_stability_of_matrices -- the largest eigenvalue of spring K + sum_j damper_j C_j against M,
 * over 4, from below, within some percent: 64 products and solutions. One number for C, or for
 * each of the dampers.                                                      [(27.9)]
 * Returns FVI_SUCCESS; FVI_EUNSUP if a damper < 0 and anything else acts; FVI_EOVRFLW;
 * FVI_ENOMEM; what a function of the matrices returned. On error *load is untouched. */
int fvi_stability_of_matrices(double spring, const double *damper, const fvi_run *run,
                              double *load);

/* fvi_stability_explicit -- (14.8), that of Euler's explicit method. Arguments and errors
 * as above, and FVI_EUNSUP for more than 64 masses with springs between them. */
int fvi_stability_explicit(const fvi_run *run, double *load);

#endif
