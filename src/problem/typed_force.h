/* src/problem/typed_force.h -- Hold a force that was typed, as a sum of parts. */
#ifndef FVI_TYPED_FORCE_H
#define FVI_TYPED_FORCE_H

#include <fvi/parse.h>
#include "system/lanes.h"

/* One part of a force. It is an expression, a table, an impulse, or else of the given kind. */
typedef struct {
    fvi_force force;            /* the part as a force of one number; no function for an impulse */
    fvi_expression *expression; /* an expression in t, owned; NULL: the part is none */
    char *file;                 /* name of the table's file, owned; or NULL */
    fvi_force_rows table;       /* its rows, one block that begins with t, owned; t is NULL: no table */
    int is_impulse;
    fvi_forcing kind;
    /* the constants: amplitude and end of a step, amplitude and frequency of a cosine, size and time of an impulse */
    double constants[2];
} fvi_force_part;

/* A force that was typed: the sum of its parts, the same on each of d coordinates. */
struct fvi_typed_force {
    size_t count;          /* number of parts */
    fvi_force_part *parts;
    size_t jump_count;     /* number of times at which the force is not smooth */
    double *jumps;         /* the ends of steps and the times of impulses, then the rows of tables */
    size_t impulse_count;
    fvi_impulse *impulses; /* in the order of their times */
    double *J;             /* the vectors of the impulses, d numbers each */
};

/* fvi_typed_force_finish -- Fill in `force` of each part. The parts must stay where they are from then on.
 * fvi_typed_force_part_value -- Compute the value of one part at t. An impulse has the value 0. Return FVI_SUCCESS.
 * fvi_typed_force_lanes -- The functions for several lanes whose forces have equally many parts; the params are
 * fvi_typed_force. */
void fvi_typed_force_finish(fvi_typed_force *f);
int fvi_typed_force_part_value(const fvi_force_part *p, double t, double *F);
extern const fvi_lane_functions fvi_typed_force_lanes;

#endif
