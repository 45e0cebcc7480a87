/* src/problem/typed_force.h -- What the text of a force has become: a sum of parts. */
#ifndef FVI_TYPED_FORCE_H
#define FVI_TYPED_FORCE_H

#include <fvi/parse.h>
#include "system/lanes.h"

/* One of: an expression, a table of n rows, an impulse p[0] at p[1], a force of the
 * library's. */
typedef struct {
    fvi_expression *expression;
    char *file; /* the name of the table's */
    size_t n;
    double *t, *F;
    int hits;
    fvi_forcing kind;
    double p[2];
} fvi_force_part;

struct fvi_typed_force {
    size_t count;
    fvi_force_part *parts;
    size_t jump_count; /* the ends of steps, then the rows of tables */
    double *jumps;
    size_t impulse_count; /* in the order of their times */
    fvi_impulse *impulses;
    double *J; /* d numbers each */
};

/* fvi_typed_force_part_value -- of one part. Returns 0.
 * fvi_typed_force_lanes -- of forces of as many parts in each lane; the params are fvi_typed_force. */
int fvi_typed_force_part_value(const fvi_force_part *p, double t, double *F);
extern const fvi_lane_functions fvi_typed_force_lanes;

#endif
