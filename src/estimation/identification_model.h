/* src/estimation/identification_model.h -- The motion as a function of its parameters.
 *
 * Internal: nothing is checked here. theta are the parameters as people know them, u
 * those in which the search goes, all of the line: logit of an order, ln of rho, of m and of a
 * time. */
#ifndef FVI_IDENTIFICATION_MODEL_H
#define FVI_IDENTIFICATION_MODEL_H

#include <fvi/identification.h>

#include <gsl/gsl_matrix.h>

enum { FVI_ESTIMATION_TERMS = 64 }; /* of a law whose numbers are fitted */
enum { FVI_FIT_RUNAWAYS = 3 }; /* end a fit: each may take seconds, and hundreds follow */

typedef struct {
    const fvi_estimation *fit;
    fvi_system system;
    fvi_run
        run; /* of that system; x0, p0, masses and dampings are the next four */
    double mass, damping, x0, p0;
    double offset, drift; /* of the sensor */
    fvi_kernel law; /* a copy of the run's, if numbers of it are fitted; with the next */
    fvi_kernel_term term[FVI_ESTIMATION_TERMS];
    size_t rows;    /* of the data that count: all, or those of a first window */
    double scale;    /* the residuals' unit: sigma, or the size of the data */
    double hopeless; /* the residual where there is no motion, or one a 10^8 times as far
                        off as the data are from 0 */
    double *motion; /* x(t_i), n numbers, of the last call */
    int ended; /* FVI_ENOMEM once a motion had no memory, FVI_ERUNAWAY once FVI_FIT_RUNAWAYS took
                * all the steps that they may: what was found counts no more */
    int ran_away;   /* so many did */
    int own;        /* the last code of the caller's own functions, or 0 */
    double reached; /* the time that the last of them came to */
} fvi_estimation_model;

/* The model with the values of fit->run; `motion` is the caller's. It points into itself: do not
 * copy it. */
void fvi_estimation_model_init(fvi_estimation_model *m, const fvi_estimation *fit, double *motion);

/* How parameter `which` is bounded: an order between two, a size above 0, or any number. */
typedef enum { FVI_ESTIMATION_ORDER, FVI_ESTIMATION_SIZE, FVI_ESTIMATION_NUMBER } fvi_estimation_kind;
fvi_estimation_kind fvi_estimation_kind_of(fvi_free_parameter which);

/* Steps no longer than h that meet the last time of the rows that count. */
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

/* The longest step for a first look: it meets all times if one does that is not much
 * shorter than their gaps; w h <= 1, w as below. */
double fvi_estimation_first_step(const fvi_estimation *fit);

/* w where the periodogram of x - mean is largest, and A = max |x - mean|. */
void fvi_estimation_frequency(size_t n, const double *t, const double *x, double *w,
                       double *A);

/* Roots of the diagonal of C = (J^T J)^-1, and C over products of two of them, for at most
 * FVI_ESTIMATION_MOST columns; J is lost. FVI_ESING if they are dependent. GSL's handler is off. */
int fvi_estimation_errors(gsl_matrix *J, double sd[],
                   double correlation[][FVI_ESTIMATION_MOST]);

/* Is everything in an answer with P parameters a finite number? bias is not asked. */
int fvi_estimate_is_finite(size_t P, const fvi_estimate *fitted);

/* The answer of fvi_estimate_multistart to a question that cannot be asked, or FVI_SUCCESS. */
int fvi_estimation_check(const fvi_estimation *fit);

#endif
