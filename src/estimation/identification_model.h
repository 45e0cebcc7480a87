/* src/estimation/identification_model.h -- The motion as a function of its parameters.
 *
 * Internal: nothing is checked here. theta are the parameters as people know them, u
 * those in which the search goes, all of the line: logit of an order, ln of rho, of m and of a
 * time. */
#ifndef FVI_IDENTIFICATION_MODEL_H
#define FVI_IDENTIFICATION_MODEL_H

#include "identification_data.h"

#include <fvi/dampers.h>

#include <gsl/gsl_matrix.h>

enum { FVI_FIT_RUNAWAYS = 3 }; /* end a fit: each may take seconds, and hundreds follow */

/* Copies of the law of a run and of the dampers of its mechanism, whose numbers may be fitted. */
typedef struct {
    fvi_mechanism mechanism;
    fvi_damper *damper;
    fvi_kernel *kernel;    /* that of the run, if it has one, then those of the dampers; owned */
    fvi_kernel_term *term; /* of all, one behind the other */
    size_t *first;         /* kernel k has the terms from first[k] on */
} fvi_estimation_laws;

typedef struct {
    const fvi_estimation *fit;
    fvi_system system;
    fvi_run run; /* of that system and of record 0; x0, p0, masses and dampings are the next four */
    double *mass, *damping, *x0, *p0; /* d each; mass stands before the others, owned */
    fvi_estimation_laws laws;
    double offset[FVI_MEASURED_MOST], drift[FVI_MEASURED_MOST]; /* of the sensors */
    double window;   /* the share of each record's rows that count: 1, or less */
    double scale[FVI_MEASURED_MOST]; /* the residuals' unit: sigma, or the size of the data */
    double hopeless; /* the residual where there is no motion, or one a 10^8 times as far
                        off as the data are from 0 */
    double *motion; /* what the sensors show, of all rows, of the last call */
    int ended; /* FVI_ENOMEM once a motion had no memory, FVI_ERUNAWAY once FVI_FIT_RUNAWAYS took
                * all the steps that they may: what was found counts no more */
    int ran_away;   /* so many did */
    int own;        /* the last code of the caller's own functions, or 0 */
    double reached; /* the time that the last of them came to */
} fvi_estimation_model;

/* The model with the values of fit->run; `motion` is the caller's. It points into itself: do not
 * copy it. Give it back with fvi_estimation_model_clear, in any case. FVI_ENOMEM. */
int fvi_estimation_model_init(fvi_estimation_model *m, const fvi_estimation *fit, double *motion);
void fvi_estimation_model_clear(fvi_estimation_model *m);

/* Are the units of the residuals found on the way? Not where sigma is known, and not for one column by
 * least squares, which needs none. */
int fvi_estimation_finds_units(const fvi_estimation *fit);

/* The unit of the residuals in this column, sigma if it is known; take other ones; and those of an
 * answer, if they were found. */
double fvi_estimation_model_scale(const fvi_estimation_model *m, const fvi_estimation_piece *p);
void fvi_estimation_model_rescale(fvi_estimation_model *m, const double *scale);
void fvi_estimation_model_weigh(fvi_estimation_model *m, const fvi_estimate *fitted);

/* What a residual in that unit is in sigma. */
double fvi_estimation_model_unit(const fvi_estimation_model *m, const fvi_estimate *fitted);

/* How many rows of a record count. */
size_t fvi_estimation_model_rows(const fvi_estimation_model *m, size_t n);

/* How parameter `which` is bounded: an order between two, a size above 0, or any number. */
typedef enum { FVI_ESTIMATION_ORDER, FVI_ESTIMATION_SIZE, FVI_ESTIMATION_NUMBER } fvi_estimation_kind;
fvi_estimation_kind fvi_estimation_kind_of(fvi_free_parameter which);

/* Of a parameter its kind, which is less than EACH, and of which it is one, 0: all alike. */
fvi_free_parameter fvi_free_parameter_base(fvi_free_parameter which);
size_t fvi_free_parameter_index(fvi_free_parameter which);

/* Is parameter j a number of a law? And the law of that of its index, 0 the run's; NULL: none. */
int fvi_free_parameter_is_of_law(fvi_free_parameter which);
const fvi_kernel *fvi_estimation_law(const fvi_run *run, size_t index);

/* Steps no longer than h that meet the last time of the rows that count, of record 0. */
void fvi_estimation_model_step(fvi_estimation_model *m, double h);

/* The present value of parameter j; write it. */
double fvi_estimation_model_get(const fvi_estimation_model *m, size_t j);
void fvi_estimation_model_set(fvi_estimation_model *m, size_t j, double theta);

/* theta -> u, u -> theta, and d theta / d u at theta, of parameter j. */
double fvi_estimation_model_free(const fvi_estimation_model *m, size_t j, double theta);
double fvi_estimation_model_bound(const fvi_estimation_model *m, size_t j, double u);
double fvi_estimation_model_slope(const fvi_estimation_model *m, size_t j, double theta);

/* m->motion for the present values. Returns what fvi_stepper_start and fvi_stepper_step return; once that
 * was FVI_ENOMEM, at once, for ever. */
int fvi_estimation_model_run(fvi_estimation_model *m);

/* Can the slopes of the motion be had without differences? */
int fvi_estimation_model_has_tangents(const fvi_estimation_model *m);

/* d motion_i / d parameter j for the present values, at slope[i * P + j]. Errors as
 * fvi_tangent. */
int fvi_estimation_model_tangents(fvi_estimation_model *m, double *slope);

/* Is the mass of coordinate `index`, from 1, or of any if that is 0, a mass of 0 that a run takes? */
int fvi_estimation_has_massless(const fvi_system *system, size_t index);

/* The longest step for a first fit: it meets all times if one does that is not much
 * shorter than their gaps; w h <= 1, w as below. */
double fvi_estimation_first_step(const fvi_estimation *fit);

/* w where the periodogram of x - mean is largest, and A = max |x - mean|. */
void fvi_estimation_frequency(size_t n, const double *t, const double *x, double *w,
                       double *A);

/* Roots of the diagonal of C = (J^T J)^-1, and C over products of two of them, for at most
 * FVI_ESTIMATION_MOST columns; J is lost. FVI_ESING if they are dependent. GSL's handler is off. */
int fvi_estimation_errors(gsl_matrix *J, double sd[],
                   double correlation[][FVI_ESTIMATION_MOST]);

/* The sum of products of neighbouring residuals, in a record and a column each. */
double fvi_estimation_neighbours(const fvi_estimation *fit, const gsl_vector *f);

/* Is everything in an answer with P parameters a finite number? bias is not asked. */
int fvi_estimate_is_finite(size_t P, const fvi_estimate *fitted);

/* The answer of fvi_estimate_multistart to a question that cannot be asked, or FVI_SUCCESS. */
int fvi_estimation_check(const fvi_estimation *fit);

#endif
