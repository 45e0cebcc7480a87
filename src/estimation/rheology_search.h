/* src/estimation/rheology_search.h -- Find the least squares of a law.         [H 24]
 *
 * This header is internal; nothing is checked. */
#ifndef FVI_RHEOLOGY_SEARCH_H
#define FVI_RHEOLOGY_SEARCH_H

#include "rheology_model.h"

/* fvi_rheology_search -- Search from a start u, with amplitudes of the size of the data, for the nearest minimum z.
 * Return the sum of squares, infinite if the search leads nowhere. random: a number from 0 to 1 for each amplitude;
 * only for creep. */
double fvi_rheology_search(fvi_rheology *o, const double *u, const double *random, double *z);

/* A constraint v(z) = target. The function returns v and writes its slope by z; slope may be NULL. */
typedef double fvi_rheology_constraint(const void *params, const double *z, double *slope);

/* fvi_rheology_descend -- Search downhill from z in all numbers, or on v(z) = target if v is not NULL. Return the sum
 * of squares. */
double fvi_rheology_descend(fvi_rheology *o, fvi_rheology_constraint *v, const void *params,
                            double target, double *z);

/* fvi_rheology_answer -- Fill in everything of *answer at z, where the sum of squares is `sum`. starts and agree have
 * been set before. */
void fvi_rheology_answer(fvi_rheology *o, const double *z, double sum, fvi_material *answer);

#endif
