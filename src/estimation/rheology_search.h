/* src/estimation/rheology_search.h -- The least squares of a law.         [H 24]
 *
 * Internal: nothing is checked. */
#ifndef FVI_RHEOLOGY_SEARCH_H
#define FVI_RHEOLOGY_SEARCH_H

#include "rheology_model.h"

/* A search: the model, room for a Jacobian and residuals, and what holds one number fast. */
typedef struct {
    fvi_rheology model;
    double *r, *trial, *J; /* rows; rows; rows by P */
    double *block;
} fvi_rheology_work;

int fvi_rheology_work_alloc(const fvi_material_data *data, fvi_rheology_work *o);
void fvi_rheology_work_free(fvi_rheology_work *o);

/* From a start u, and from amplitudes of the size of the data, to the nearest least: z. Returns the
 * sum of squares, infinite if it leads nowhere. random: of the amplitudes of creep, 0 to 1 each. */
double fvi_rheology_search(fvi_rheology_work *o, const double *u, const double *random, double *z);

/* A constraint v(z) = target, with its slope by z. */
typedef double fvi_rheology_constraint(const void *params, const double *z, double *slope);

/* From z downhill in all numbers, with v = NULL or on v(z) = target. Returns the sum of squares. */
double fvi_rheology_descend(fvi_rheology_work *o, fvi_rheology_constraint *v, const void *params,
                            double target, double *z);

#endif
