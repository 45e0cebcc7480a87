/* src/adjoint/adjoint_multipliers.h -- What the memories of the adjoint run take in.  [H 23] */
#ifndef FVI_ADJOINT_MULTIPLIERS_H
#define FVI_ADJOINT_MULTIPLIERS_H

#include <stddef.h>

/* nu of (23.7), which the memories of the terms of a law take in. Where the comment says "each", d
 * numbers. */
typedef struct {
    size_t d;
    int is_first_order; /* of Algorithm 3 it is lambda */
    int is_mean;        /* of fvi-stable, whose memory takes in means */
    double theta;
    double *nu, *behind;    /* each: now, and one node later */
    double *mean, *change;  /* each: what goes in, and its increment */
} fvi_adjoint_multipliers;

/* fvi_adjoint_multipliers_next -- at a node.
 *
 *   is_last      nonzero at node N
 *   right, left  lambda_{k+1} and lambda_k, d numbers each
 *   jump         what lambda_{k+1} has jumped by, (23.27); NULL: nothing */
void fvi_adjoint_multipliers_next(fvi_adjoint_multipliers *f, int is_last, const double *right,
                                  const double *left, const double *jump);

#endif
