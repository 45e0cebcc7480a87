/* src/estimation/identification_robust.h -- Residuals that may be wrong readings. [H 24]
 *
 * Internal. Huber's loss of a residual r, in the unit of its column, is r^2 up to k and 2 k |r| - k^2
 * beyond. Its root f, with the sign of r, is what the search makes small. k = 0: f = r. */
#ifndef FVI_IDENTIFICATION_ROBUST_H
#define FVI_IDENTIFICATION_ROBUST_H

#include "identification_search.h"

/* f of r; and dr/df at f. */
double fvi_estimation_loss(double k, double r);
double fvi_estimation_stretch(double k, double f);

/* (24.20): what the scatter of an influence makes of the standard deviations of (J^T J)^-1, J of r;
 * and what a loss counts in chi^2. Both 1 for k = 0. f: n roots of which P parameters were fitted. */
void fvi_estimation_robust_units(double k, size_t P, const gsl_vector *f, double *of_sd,
                                 double *of_loss);

/* J of f becomes that of r, and f the influences. */
void fvi_estimation_unroll(double k, gsl_vector *f, gsl_matrix *J);

/* The units of columns whose sigma nobody knows, from the residuals at *at, where the search then
 * goes on, until they stay: a root of the mean square, or, of a robust fit, 1.4826 times the median
 * of |r|. FVI_ENOMEM. */
int fvi_estimation_reweigh(fvi_estimation_work *o, fvi_estimation_slot *at);

#endif
