/* src/estimation/identification_robust.h -- Fit data with wrong readings. [H 24]
 *
 * This header is internal. Huber's loss of a residual r, in the unit of its column, is r^2 up to |r| = k, and 2 k |r| -
 * k^2 beyond. f is the root of the loss, with the sign of r; the search minimises the sum of f^2. With k = 0, f = r. */
#ifndef FVI_IDENTIFICATION_ROBUST_H
#define FVI_IDENTIFICATION_ROBUST_H

#include "identification_search.h"

/* Return f for r; return dr/df at f. */
double fvi_estimation_loss(double k, double r);
double fvi_estimation_stretch(double k, double f);

/* (24.20): compute the factor for the standard deviations that follow from (J^T J)^-1, where J is the Jacobian of r,
 * and the factor of the loss in chi^2. Both are 1 for k = 0. f contains the roots of the losses, to which P parameters
 * were fitted. */
void fvi_estimation_robust_units(double k, size_t P, const gsl_vector *f, double *of_sd,
                                 double *of_loss);

/* Replace J, the Jacobian of f, by that of r, and f by the influences. */
void fvi_estimation_undo_loss(double k, gsl_vector *f, gsl_matrix *J);

/* Find the units of columns whose sigma is unknown. They follow from the residuals at *at, the search goes on from
 * there, and so on until the units do not change. A unit is the root of the mean square or, for a robust fit, 1.4826
 * times the median of |r|. Return FVI_SUCCESS or FVI_ENOMEM. */
int fvi_estimation_reweigh(fvi_estimation_work *o, fvi_estimation_place *at);

#endif
