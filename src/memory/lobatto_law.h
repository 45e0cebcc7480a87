/* src/memory/lobatto_law.h -- Laws of damping on Lobatto nodes.          [Chapter 26]
 *
 *     C(Delta(z)/h) (Delta(z)/h)^(-1) = sum_n W_n z^n:                    (26.12)
 *
 * what a law makes of the velocities of the stages, as Delta^(2 alpha - 1) does for a
 * power. The step size IS included. */
#ifndef FVI_LOBATTO_LAW_H
#define FVI_LOBATTO_LAW_H

#include "law_terms.h"
#include "lobatto_weights.h"

/* A law's terms at one step; release with fvi_lobatto_law_free. */
typedef struct {
    fvi_law_simple *term;
    size_t terms;
    double h;
} fvi_lobatto_law;

/* fvi_lobatto_law_of -- a law that has passed fvi_law_check.
 * Returns FVI_SUCCESS; FVI_EUNSUP for orders 2 alpha above 1, where the velocity at the
 * start would act at once without end, and for fractions with 0.9 < 2 alpha < 1, whose
 * poles are too near to the cut; FVI_ENOMEM. */
int fvi_lobatto_law_of(const fvi_law *law, double h, fvi_lobatto_law *ready);

void fvi_lobatto_law_free(fvi_lobatto_law *ready);

/* fvi_lobatto_law_nodes -- as fvi_lobatto_nodes: one set for all terms, a node for the pole
 * of each Maxwell element, one for all springs. Nothing is checked. */
size_t fvi_lobatto_law_nodes(size_t s, const fvi_lobatto_law *ready, double N,
                             double tolerance, double *q, double *p, double *a,
                             size_t stride);

/* fvi_lobatto_law_weights -- W_0, ..., W_{n-1}, n > FVI_LAGS; W as for fvi_lobatto_weights.
 * Accuracy: as there, of the largest of W_0, for each term (no proof; seen 20).
 * Returns FVI_SUCCESS or FVI_ENOMEM. */
int fvi_lobatto_law_weights(size_t s, const fvi_lobatto_law *ready, size_t n,
                            double *W);

#endif
