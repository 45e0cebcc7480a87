/* src/estimation/rheology_answer.h -- What the data say of a law.         [H 24]
 *
 * Internal: nothing is checked. */
#ifndef FVI_RHEOLOGY_ANSWER_H
#define FVI_RHEOLOGY_ANSWER_H

#include "rheology_search.h"

/* Everything of *answer at z with its sum of squares, but starts and agree, which have been set. */
void fvi_rheology_answer(fvi_rheology_work *o, const double *z, double sum, fvi_material *answer);

#endif
