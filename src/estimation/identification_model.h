/* src/estimation/identification_model.h -- Compute the motion as a function of its parameters.
 *
 * This header is internal; nothing is checked here. theta is a parameter as the user knows it. u is the parameter of
 * the search, which may be any number: the logit of an order or an exponent, the logarithm of rho, of a mass and of a
 * time, and theta itself for all others. */
#ifndef FVI_IDENTIFICATION_MODEL_H
#define FVI_IDENTIFICATION_MODEL_H

#include "identification_data.h"

#include <fvi/dampers.h>

#include <gsl/gsl_matrix.h>

/* This many runs with too many steps end a fit, because each may take seconds, and hundreds would follow. */
enum { FVI_FIT_RUNAWAYS = 3 };

/* Copies of the law of a run and of the dampers of its mechanism, whose parameters may be fitted. */
typedef struct {
    fvi_mechanism mechanism;
    fvi_damper *damper;
    fvi_kernel *kernel;    /* the law of the run, if it has one, then those of the dampers; owned */
    fvi_kernel_term *term; /* terms of all kernels, one kernel after the other */
    size_t *first;         /* kernel k has the terms from first[k] on */
} fvi_estimation_laws;

typedef struct {
    const fvi_estimation *fit;
    fvi_system system;
    fvi_run run; /* run of that system and of record 0; x0, p0, masses and dampings are the next four arrays */
    double *mass, *damping, *x0, *p0; /* d numbers each; one block, which begins at mass; owned */
    fvi_estimation_laws laws;
    double given[FVI_ESTIMATION_MOST]; /* [j]: the caller's value of the constant that parameter j is */
    double offset[FVI_MEASURED_MOST], drift[FVI_MEASURED_MOST]; /* offsets and drifts of the sensors */
    double window;   /* share of each record's rows that are compared: 1, or less */
    double scale[FVI_MEASURED_MOST]; /* unit of the residuals of each column: sigma, or the size of the data */
    /* 10^8 times the larger of 1 and the size of the data in its unit: the residual if there is no motion, and the
     * largest residual otherwise */
    double hopeless;
    double *motion; /* output of the sensors at all rows, by the last call */
    /* FVI_ENOMEM after a motion had no memory, FVI_ERUNAWAY after FVI_FIT_RUNAWAYS motions took all the steps that they
     * may take: the results of the search are not valid then */
    int ended;
    int ran_away;   /* number of motions that took all their steps */
    int callback_status; /* last code that a function of the caller returned, or 0 */
    double reached; /* time that the last motion reached */
} fvi_estimation_model;

/* Make the model with the values of fit->run. `motion` belongs to the caller. The model points into itself, so do not
 * copy it. Free it with fvi_estimation_model_clear in each case, which gives the fitted constants of the caller their
 * values back. Return FVI_SUCCESS or FVI_ENOMEM. */
int fvi_estimation_model_init(fvi_estimation_model *m, const fvi_estimation *fit, double *motion);
void fvi_estimation_model_clear(fvi_estimation_model *m);

/* Return nonzero if the units of the residuals are found during the fit. They are not if sigma is known, nor for one
 * column by least squares, which needs no unit. */
int fvi_estimation_finds_units(const fvi_estimation *fit);

/* fvi_estimation_model_scale -- Return the unit of the residuals of a piece, which is sigma if that is known.
 *
 * fvi_estimation_model_rescale -- Set new units, one for each column.
 *
 * fvi_estimation_model_weigh -- Set the units to the sigmas of an answer, if the fit finds the units. */
double fvi_estimation_model_scale(const fvi_estimation_model *m, const fvi_estimation_piece *p);
void fvi_estimation_model_rescale(fvi_estimation_model *m, const double *scale);
void fvi_estimation_model_weigh(fvi_estimation_model *m, const fvi_estimate *fitted);

/* Return the factor that converts a residual in that unit to sigma. */
double fvi_estimation_model_unit(const fvi_estimation_model *m, const fvi_estimate *fitted);

/* Return how many of the n rows of a record are compared. */
size_t fvi_estimation_model_rows(const fvi_estimation_model *m, size_t n);

/* The kind of parameter j: an order or an exponent between two bounds, a size above 0, or any number. */
typedef enum { FVI_ESTIMATION_ORDER, FVI_ESTIMATION_SIZE, FVI_ESTIMATION_NUMBER } fvi_estimation_kind;
fvi_estimation_kind fvi_estimation_kind_of(const fvi_estimation *fit, size_t j);

/* Find the range of all values that parameter j may have. */
void fvi_estimation_range(const fvi_estimation *fit, size_t j, double *low, double *high);

/* Split a parameter into its base, which is less than FVI_FREE_PARAMETER_EACH, and its index: 0 for all alike, or i for
 * mass, coordinate, column or damper i. */
fvi_free_parameter fvi_free_parameter_base(fvi_free_parameter which);
size_t fvi_free_parameter_index(fvi_free_parameter which);

/* Return nonzero if the parameter belongs to a law. Return the law with this index: 0 for that of the run, j for damper
 * j; NULL if there is none. */
int fvi_free_parameter_is_of_law(fvi_free_parameter which);
const fvi_kernel *fvi_estimation_law(const fvi_run *run, size_t index);

/* Set the step: equal steps no longer than h that end at the last compared time of record 0. */
void fvi_estimation_model_set_step(fvi_estimation_model *m, double h);

/* Return the present value of parameter j; set it. */
double fvi_estimation_model_get(const fvi_estimation_model *m, size_t j);
void fvi_estimation_model_set(fvi_estimation_model *m, size_t j, double theta);

/* Convert theta to u, and u to theta; return d theta / d u at theta, for parameter j. */
double fvi_estimation_theta_to_u(const fvi_estimation_model *m, size_t j, double theta);
double fvi_estimation_u_to_theta(const fvi_estimation_model *m, size_t j, double u);
double fvi_estimation_slope_of_theta(const fvi_estimation_model *m, size_t j, double theta);

/* Compute m->motion for the present values. Return what fvi_stepper_start and fvi_stepper_step return, or FVI_EDOM for
 * values that no run takes. After the model has ended, return its code at once. */
int fvi_estimation_model_run(fvi_estimation_model *m);

/* Return nonzero if the derivatives of the motion are known without differences. */
int fvi_estimation_model_has_tangents(const fvi_estimation_model *m);

/* Write d motion_i / d parameter j for the present values to slope[i * P + j]. Errors as fvi_tangent. */
int fvi_estimation_model_tangents(fvi_estimation_model *m, double *slope);

/* Return nonzero if coordinate `index` (from 1), or any coordinate if that is 0, has a mass of 0 that a run accepts. */
int fvi_estimation_has_massless(const fvi_system *system, size_t index);

/* Return the longest step for a first fit: all times are multiples of it, if there is such a step that is not much
 * shorter than the gaps of the times, and w h <= 1, with w as below. */
double fvi_estimation_first_step(const fvi_estimation *fit);

/* Compute w, at which the periodogram of x - mean is largest, and A = max |x - mean|. The periodogram uses the first
 * 1024 rows. */
void fvi_estimation_frequency(size_t n, const double *t, const double *x, double *w,
                       double *A);

/* Compute sd_j, the square roots of the diagonal of C = (J^T J)^-1, and the correlations C_ij / (sd_i sd_j), for at
 * most FVI_ESTIMATION_MOST columns. J is overwritten. Return FVI_SUCCESS, or FVI_ESING if the columns are dependent.
 * GSL's error handler must be off. */
int fvi_estimation_errors(gsl_matrix *J, double sd[],
                   double correlation[][FVI_ESTIMATION_MOST]);

/* Return the sum of products of neighbouring residuals of the same piece. */
double fvi_estimation_neighbours(const fvi_estimation *fit, const gsl_vector *f);

/* Return nonzero if every number of an answer with P parameters is finite, except bias, which is not checked. */
int fvi_estimate_is_finite(size_t P, const fvi_estimate *fitted);

/* Check the question as fvi_estimate_multistart does. Return FVI_SUCCESS or its error code. */
int fvi_estimation_check(const fvi_estimation *fit);

#endif
