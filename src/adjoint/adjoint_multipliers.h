/* src/adjoint/adjoint_multipliers.h -- The multipliers nu, as the histories of an adjoint run take them in. [H 23] */
#ifndef FVI_ADJOINT_MULTIPLIERS_H
#define FVI_ADJOINT_MULTIPLIERS_H

#include <stddef.h>

/* The sequence nu of (23.7), for the histories of the terms of a law; "each" means that an array has d numbers. */
typedef struct {
    size_t d;
    int is_first_order; /* for Algorithm 3, where nu = lambda */
    int is_mean;        /* for fvi-stable, whose history takes in means of two nodes */
    double theta;
    double *nu, *behind;    /* each: nu at this node and at the node after it */
    double *mean, *change;  /* each: the input of the histories, and its increment */
} fvi_adjoint_multipliers;

/* fvi_adjoint_multipliers_next -- compute nu, mean and change at the next node. The walk goes from node N backwards.
 *
 *   is_last      nonzero at node N
 *   right, left  lambda_{k+1} and lambda_k, d numbers each
 *   jump         by how much lambda_{k+1} has jumped, (23.27); NULL: by nothing */
void fvi_adjoint_multipliers_next(fvi_adjoint_multipliers *f, int is_last, const double *right,
                                  const double *left, const double *jump);

#endif
