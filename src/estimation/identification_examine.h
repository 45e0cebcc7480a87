/* src/estimation/identification_examine.h -- Can an answer be believed?  [H 24]
 *
 * Internal: nothing is checked, and GSL's handler is off. */
#ifndef FVI_IDENTIFICATION_EXAMINE_H
#define FVI_IDENTIFICATION_EXAMINE_H

#include "identification_search.h"

/* fvi_estimation_tests -- the probabilities of an examination, (24.13) to (24.15).
 *
 *   f, J   residuals in the units of the model, which are sigma where that is known, and their
 *          Jacobian, which is lost
 *   room   n rows and fvi_estimation_test_columns(fit) columns
 *   v      n numbers */
void fvi_estimation_tests(const fvi_estimation_model *m, const gsl_vector *f,
                          gsl_matrix *J, gsl_matrix *room, gsl_vector *v,
                          fvi_examination *examined);

size_t fvi_estimation_test_columns(const fvi_estimation *fit);

/* fvi_estimation_is_open -- is there no value of parameter j that the data exclude? */
int fvi_estimation_is_open(const fvi_estimation *fit, const fvi_examination *e, size_t j);

/* fvi_estimation_sensor_column -- what an offset (which = 0) of 1 adds to the data of this column, or
 * a drift (1) by 1 over the whole record. */
void fvi_estimation_sensor_column(const fvi_estimation *fit, size_t which, size_t column,
                                  gsl_vector *v);

/* fvi_estimation_length_unseen -- the length of that column but for what the parameters make up
 * for. J, room, v as above; J stays. */
double fvi_estimation_length_unseen(const fvi_estimation *fit, size_t which, size_t column,
                                    const gsl_matrix *J, gsl_matrix *room, gsl_vector *v);

/* fvi_estimation_predict_errors -- (24.3) at u where the work's model stands.
 *
 *   planned    its estimates and sigma are there; output: sd and correlations
 *   e          output: the intervals of the tangent, and what would not be seen
 *
 * Returns FVI_SUCCESS; FVI_ESING where the parameters are not determined; FVI_ENOMEM; what the
 * model returns. */
int fvi_estimation_predict_errors(fvi_estimation_work *o, const double *u, fvi_estimate *planned,
                           fvi_examination *e);

#endif
