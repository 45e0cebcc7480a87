/* src/estimation/identification_examine.h -- Examine whether the answer of a fit can be believed.  [H 24]
 *
 * This header is internal. Nothing is checked, and GSL's error handler is off. */
#ifndef FVI_IDENTIFICATION_EXAMINE_H
#define FVI_IDENTIFICATION_EXAMINE_H

#include "identification_search.h"

/* fvi_estimation_tests -- Compute the probabilities of an examination by (24.13) to (24.15).
 *
 *   f, J   residuals in the units of the model, which are sigma where that is known, and their
 *          Jacobian, which is overwritten
 *   room   n rows and fvi_estimation_test_columns(fit) columns
 *   v      n numbers */
void fvi_estimation_tests(const fvi_estimation_model *m, const gsl_vector *f,
                          gsl_matrix *J, gsl_matrix *room, gsl_vector *v,
                          fvi_examination *examined);

size_t fvi_estimation_test_columns(const fvi_estimation *fit);

/* fvi_estimation_is_open -- Return nonzero if the data exclude no value of parameter j. */
int fvi_estimation_is_open(const fvi_estimation *fit, const fvi_examination *e, size_t j);

/* fvi_estimation_sensor_column -- Write to v what an offset of 1 (which = 0) adds to the data of this column, or a
 * drift (which = 1) of 1 over the whole record. */
void fvi_estimation_sensor_column(const fvi_estimation *fit, size_t which, size_t column,
                                  gsl_vector *v);

/* fvi_estimation_length_unseen -- Return the length of that column after the part that the parameters can imitate has
 * been taken out. J, room and v as above; J is not changed. */
double fvi_estimation_length_unseen(const fvi_estimation *fit, size_t which, size_t column,
                                    const gsl_matrix *J, gsl_matrix *room, gsl_vector *v);

/* fvi_estimation_predict_errors -- Compute (24.3) at u, where the model of the work stands.
 *
 *   planned    its estimates and sigma are set; output: sd and correlations
 *   e          output: the intervals of the tangent, and what the tests may overlook
 *
 * Return FVI_SUCCESS; FVI_ESING if the parameters are not determined; FVI_ENOMEM; the code that ended the model. */
int fvi_estimation_predict_errors(fvi_estimation_work *o, const double *u, fvi_estimate *planned,
                           fvi_examination *e);

#endif
