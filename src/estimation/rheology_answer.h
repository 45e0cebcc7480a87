/* src/estimation/rheology_answer.h -- Compute what the data say of a law.         [H 24]
 *
 * This header is internal; nothing is checked. */
#ifndef FVI_RHEOLOGY_ANSWER_H
#define FVI_RHEOLOGY_ANSWER_H

#include "rheology_search.h"

/* Fill in everything of *answer at z, where the sum of squares is `sum`. starts and agree have been set before. */
void fvi_rheology_answer(fvi_rheology_work *o, const double *z, double sum, fvi_material *answer);

#endif
