/* src/problem/typed_force.h -- Hold a force that was typed, as a sum of parts. */
#ifndef FVI_TYPED_FORCE_H
#define FVI_TYPED_FORCE_H

#include <fvi/parse.h>
#include "system/lanes.h"

/* One of: an expression, a table of n rows, an impulse p[0] at p[1] (hits is nonzero), or a step or cosine with the
 * constants p. */
typedef struct {
    fvi_expression *expression;
    char *file; /* name of the table's file */
    size_t n;
    double *t, *F;
    int hits;
    fvi_forcing kind;
    double p[2];
} fvi_force_part;

struct fvi_typed_force {
    size_t count;
    fvi_force_part *parts;
    size_t jump_count; /* the ends of steps and the impulses, then the rows of tables */
    double *jumps;
    size_t impulse_count; /* in the order of their times */
    fvi_impulse *impulses;
    double *J; /* d numbers for each impulse */
};

/* fvi_typed_force_part_value -- Compute the value of one part. Return 0.
 * fvi_typed_force_lanes -- The functions for several lanes whose forces have equally many parts; the params are
 * fvi_typed_force. */
int fvi_typed_force_part_value(const fvi_force_part *p, double t, double *F);
extern const fvi_lane_functions fvi_typed_force_lanes;

#endif
