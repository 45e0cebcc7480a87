/* src/estimation/identification_search.h -- One search of many.          [H 24]
 *
 * Internal: identification.c begins it in many places, identification_profile.c at many
 * values of one parameter. Nothing is checked, and GSL's handler is off. */
#ifndef FVI_IDENTIFICATION_SEARCH_H
#define FVI_IDENTIFICATION_SEARCH_H

#include "identification_model.h"

#include <gsl/gsl_multifit_nlinear.h>

/* Where a search began and ended: the parameters as u, and the sum of squares; on its way? */
typedef struct {
    double from[FVI_ESTIMATION_MOST], u[FVI_ESTIMATION_MOST], sum;
    int gave_up;
} fvi_estimation_slot;

typedef struct {
    fvi_estimation_model model;
    gsl_multifit_nlinear_fdf fdf;
    gsl_multifit_nlinear_workspace *solver;
    fvi_estimation_slot *found; /* one for each start */
    double *last, *base;  /* residuals: the last ones, and those of slopes */
    double *ridden;       /* n P slopes; NULL: the run has no tangents */
    double size[FVI_ESTIMATION_MOST]; /* of each u: it is nearly zero far below that */
    double
        believed; /* chi^2 is less for 99 of 100 data sets; 0: sigma is not known */
    double fine; /* a search ends when its steps are shorter, in parts of u */
} fvi_estimation_work;

/* fvi_estimation_work_alloc -- ready to search.
 *
 *   low, high  output: the box of fit, or that of fvi_estimate_box
 *   o          output, in any case to be given back by fvi_estimation_work_free
 *
 * Returns what fvi_estimation_check returns; FVI_ENOMEM. */
int fvi_estimation_work_alloc(fvi_estimation_work *o, const fvi_estimation *fit, double *low,
                       double *high);

/* f_i = (x(t_i) - x_i) / scale at u, and the motion there; params: the work. As GSL asks. */
int fvi_estimation_residuals(const gsl_vector *u, void *params, gsl_vector *f);

/* The sum of their squares at the present values of the model, infinite without a motion. */
double fvi_estimation_sum_here(fvi_estimation_work *o);

/* From at->u downhill; sum is infinite if that leads nowhere. A search that creeps above
 * `below` may end on its way. */
void fvi_estimation_minimise(fvi_estimation_work *o, fvi_estimation_slot *at, double below);

void fvi_estimation_work_free(fvi_estimation_work *o);

#endif
