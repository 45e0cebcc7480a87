/* src/memory/law_terms.h -- What damping_laws.c shares with other files. [Chapter 26]
 *
 * Internal; nothing is checked, but by fvi_law_check_weights. */
#ifndef FVI_LAW_TERMS_H
#define FVI_LAW_TERMS_H

#include <fvi/damping_laws.h>

#include <complex.h>

/* rho s^{2 alpha} / (1 + time s^{2 alpha}): every term is one of these, or many. */
typedef struct {
    double rho, alpha, time;
} fvi_law_simple;

/* fvi_law_at -- C(s) by the principal logarithm, s != 0, and in *slope s C'(s): of a range
 * of orders to a relative u / |ln s|. */
double complex fvi_law_at(const fvi_law *law, double complex s,
                          double complex *slope);

/* fvi_law_check_weights -- fvi_law_check, and are these weights that a law has?
 * Returns what it returns; FVI_EINVAL for kind, FVI_EDOM for h. */
int fvi_law_check_weights(const fvi_law *law, fvi_quadrature kind, double h);

/* fvi_law_flatten -- the law as such terms, a new array for the caller to free.
 * Returns FVI_SUCCESS or FVI_ENOMEM. */
int fvi_law_flatten(const fvi_law *law, fvi_law_simple **terms, size_t *count);

/* fvi_law_series -- adds to w the coefficients of C(delta(z)/h), divided by 1 - z if
 * `increments` is 1; room for 2 count numbers. */
void fvi_law_series(const fvi_law_simple *t, fvi_quadrature kind, double h,
                    int increments, size_t count, double *room, double *w);

/* fvi_law_has_modes -- whether the weights of a law by `kind`, with step h, are a sum of
 * decaying modes after the window; 0 also if there is no memory to see. */
int fvi_law_has_modes(const fvi_law *law, fvi_quadrature kind, double h);

#endif
