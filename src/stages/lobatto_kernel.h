/* src/stages/lobatto_kernel.h -- Weights and modes of a damping law on Lobatto nodes.          [H 26]
 *
 *     C(Delta(z)/h) (Delta(z)/h)^(-1) = sum_n W_n z^n                    (26.12)
 *
 * The W_n map the velocities of the stages to the force of the law, as Delta^(2 alpha - 1) does for a power. They
 * include the step size. */
#ifndef FVI_LOBATTO_KERNEL_H
#define FVI_LOBATTO_KERNEL_H

#include "kernel/kernel_general.h"
#include "lobatto_weights.h"

/* A law prepared for one step length. Free it with fvi_lobatto_kernel_free. */
typedef struct {
    const fvi_kernel *law;
    fvi_kernel_simple *term; /* the simple terms of the law */
    size_t terms;
    double h;
    double strip;  /* the narrowest strip of its general terms */
    int has_nodes; /* nonzero if all terms have nodes: then W_n is a sum of powers for n > FVI_LAGS */
} fvi_lobatto_kernel;

/* fvi_lobatto_kernel_prepare -- Prepare a law that has passed fvi_kernel_check. Some fractions have no nodes: those
 * with a denominator of order 2 below > 0.9, except a Maxwell element, because their poles are too near the cut or off
 * it; and those whose weight on the cut changes its sign. General terms, which are a DAVIDSON and a HAVRILIAK that are
 * no fraction, and a SYMBOL, have modes of their own.
 *
 * Return FVI_SUCCESS; FVI_EUNSUP if the modes of a general term (kernel_general.h) do not represent its weights;
 * FVI_ENOMEM. */
int fvi_lobatto_kernel_prepare(size_t s, const fvi_kernel *law, double h,
                               fvi_lobatto_kernel *ready);

void fvi_lobatto_kernel_free(fvi_lobatto_kernel *ready);

/* fvi_lobatto_kernel_nodes -- Compute the nodes of a law, as fvi_lobatto_nodes does for a power.
 *
 *   is_few  nonzero: replace the nodes of the cut that hardly decay within N steps by fewer nodes if all their weights
 *           have one sign
 *   nodes   output: a list of the numbers mu (rate) and q (weight), which the caller frees, also after an error.
 *           fvi_lobatto_solve_nodes computes a and p from mu
 *
 * There is one set of nodes for all terms with a cut, one node for the pole of each Maxwell element, and one for all
 * springs. Terms without nodes are left out. Return FVI_SUCCESS; FVI_EUNSUP, without a call of the error handler, if a
 * term has no modes; FVI_ENOMEM. */
int fvi_lobatto_kernel_nodes(size_t s, const fvi_lobatto_kernel *ready, double N, double tolerance, int is_few,
                             fvi_kernel_modes *nodes);

/* fvi_lobatto_kernel_weights -- Compute W_0, ..., W_{n-1}, n > FVI_LAGS. W is ordered as for fvi_lobatto_weights.
 *
 * Accuracy for each term: as for fvi_lobatto_weights, relative to the largest entry of W_0 (no proof; seen 20 u). A
 * ZENER with 2 alpha > 1 is less accurate: it rings, and rounding errors stay as long as it rings (seen 1700 u in 150
 * matrices, alpha = 1). Cost: O(n Q), and O(n^2 s^3) for each fraction without nodes. Return FVI_SUCCESS; FVI_ENOMEM;
 * the code of the interrupter (error.h). */
int fvi_lobatto_kernel_weights(size_t s, const fvi_lobatto_kernel *ready, size_t n,
                            double *W);

#endif
