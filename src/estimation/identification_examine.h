/* src/estimation/identification_examine.h -- Can an answer be believed?  [H 24]
 *
 * Internal: nothing is checked, and GSL's handler is off. */
#ifndef FVI_IDENTIFICATION_EXAMINE_H
#define FVI_IDENTIFICATION_EXAMINE_H

#include "identification_search.h"

/* fvi_estimation_tests -- the probabilities of an examination, (24.14) to (24.16).
 *
 *   f, J   residuals over `scale`, which is sigma where that is known, and their Jacobian, which
 *          is lost
 *   room   n rows and fvi_estimation_test_columns(fit) columns
 *   v      n numbers */
void fvi_estimation_tests(const fvi_estimation *fit, double scale, const gsl_vector *f,
                          gsl_matrix *J, gsl_matrix *room, gsl_vector *v,
                          fvi_examination *examined);

size_t fvi_estimation_test_columns(const fvi_estimation *fit);

/* fvi_estimation_is_open -- is there no value of parameter j that the data exclude? */
int fvi_estimation_is_open(const fvi_estimation *fit, const fvi_examination *e, size_t j);

#endif
