/* src/estimation/identification_search.h -- Search for a minimum from one start.          [H 24]
 *
 * This header is internal. identification.c begins the search in many places, identification_profile.c at many values
 * of one parameter. Nothing is checked, and GSL's error handler is off. */
#ifndef FVI_IDENTIFICATION_SEARCH_H
#define FVI_IDENTIFICATION_SEARCH_H

#include "identification_model.h"

#include <gsl/gsl_multifit_nlinear.h>

/* The place of one search: the unknowns u where it began and where it is now, the sum of squares there, and whether it
 * was given up. */
typedef struct {
    double from[FVI_ESTIMATION_MOST], u[FVI_ESTIMATION_MOST], sum;
    int gave_up;
} fvi_estimation_place;

typedef struct {
    fvi_estimation_model model;
    gsl_multifit_nlinear_fdf fdf;
    gsl_multifit_nlinear_workspace *solver;
    fvi_estimation_place *found; /* one search for each start */
    double *last, *base;  /* the last residuals, and those at the base of the differences */
    double *tangents;     /* n P derivatives; NULL: the run has no tangents */
    double size[FVI_ESTIMATION_MOST]; /* size of each u; a value far below it counts as 0 */
    double
        believed; /* the chi^2 that 99 of 100 data sets do not exceed; 0: sigma is not known */
    double fine; /* a search ends when its steps are shorter, relative to u */
} fvi_estimation_work;

/* fvi_estimation_work_alloc -- Make everything that a search needs.
 *
 *   low, high  output: the box of fit, or that of fvi_estimate_box
 *   o          output; free it with fvi_estimation_work_free in each case
 *
 * Return what fvi_estimation_check returns; FVI_ENOMEM. */
int fvi_estimation_work_alloc(fvi_estimation_work *o, const fvi_estimation *fit, double *low,
                       double *high);

/* Compute the residuals f_i = (x(t_i) - x_i) / scale at u, and the motion there. params is the work. The signature is
 * that of GSL. */
int fvi_estimation_residuals(const gsl_vector *u, void *params, gsl_vector *f);

/* Return the sum of squares of the residuals at the present values of the model, infinite if there is no motion. */
double fvi_estimation_sum_here(fvi_estimation_work *o);

/* Search downhill from at->u. at->sum becomes infinite if that leads nowhere. A search that makes little progress above
 * `below` is given up. */
void fvi_estimation_minimise(fvi_estimation_work *o, fvi_estimation_place *at, double below);

void fvi_estimation_work_free(fvi_estimation_work *o);

#endif
