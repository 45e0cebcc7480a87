/* src/stages/lobatto_kernel.h -- Laws of damping on Lobatto nodes.          [H 26]
 *
 *     C(Delta(z)/h) (Delta(z)/h)^(-1) = sum_n W_n z^n:                    (26.12)
 *
 * what a law makes of the velocities of the stages, as Delta^(2 alpha - 1) does for a
 * power. The step size IS included. */
#ifndef FVI_LOBATTO_KERNEL_H
#define FVI_LOBATTO_KERNEL_H

#include "kernel/kernel_terms.h"
#include "lobatto_weights.h"

/* A law's terms at one step; release with fvi_lobatto_kernel_free. */
typedef struct {
    const fvi_kernel *law;
    fvi_kernel_simple *term; /* its fractions of powers */
    size_t terms;
    double h;
    double strip;  /* of the terms that are none, the narrowest */
    int has_nodes; /* all of them: W_n is a sum of powers, for n > FVI_LAGS */
} fvi_lobatto_kernel;

/* fvi_lobatto_kernel_prepare -- a law that has passed fvi_kernel_check. Fractions with 2 alpha > 0.9
 * but for 1 have no nodes: their poles are too near to the cut, or off it.
 * Returns FVI_SUCCESS; FVI_EUNSUP of a DAVIDSON or a SYMBOL whose weights are not all in its
 * values on the cut; FVI_ENOMEM. */
int fvi_lobatto_kernel_prepare(size_t s, const fvi_kernel *law, double h,
                               fvi_lobatto_kernel *ready);

void fvi_lobatto_kernel_free(fvi_lobatto_kernel *ready);

/* fvi_lobatto_kernel_nodes -- as fvi_lobatto_nodes: one set for all terms, a node for the pole
 * of each Maxwell element, one for all springs, none for a term without nodes. Nothing is
 * checked. */
size_t fvi_lobatto_kernel_nodes(size_t s, const fvi_lobatto_kernel *ready, double N,
                             double tolerance, double *q, double *p, double *a,
                             size_t stride);

/* fvi_lobatto_kernel_few_nodes -- the same by fewer nodes, as fvi_lobatto_few_nodes where all weights of the cut have one
 * sign: the `count` numbers q and then as many mu, a block that the caller frees. a and p are made of mu by
 * fvi_lobatto_solve_nodes. Returns FVI_SUCCESS or FVI_ENOMEM. */
int fvi_lobatto_kernel_few_nodes(size_t s, const fvi_lobatto_kernel *ready, double N, double tolerance, size_t *count,
                                 double **nodes);

/* fvi_lobatto_kernel_weights -- W_0, ..., W_{n-1}, n > FVI_LAGS; W as for fvi_lobatto_weights.
 * Accuracy: as there, of the largest of W_0, for each term (no proof; seen 20). Not so for a
 * ZENER with 2 alpha > 1: it rings, and keeps roundings for as long as it does (seen 1700 u
 * in 150 matrices, alpha = 1).
 * Cost: O(n Q), and O(n^2 s^3) for each fraction without nodes.
 * Returns FVI_SUCCESS or FVI_ENOMEM. */
int fvi_lobatto_kernel_weights(size_t s, const fvi_lobatto_kernel *ready, size_t n,
                            double *W);

#endif
