/* src/expression/tape_lanes.h -- Evaluate a tape at several places at once.        [H 28] */
#ifndef FVI_TAPE_LANES_H
#define FVI_TAPE_LANES_H

#include "tape.h"
#include "system/lanes.h"

/* The longest tape that can be evaluated in this way. Its numbers are on the stack, at most 24 kilobytes. */
enum { FVI_TAPE_LANES_LONGEST = 128 };

/* fvi_tape_lanes -- Compute the last of n nodes in each lane. The tape has one coordinate.
 *
 *   x        the coordinate, FVI_MOST_LANES numbers
 *   k        parameter j of lane l at [j * FVI_MOST_LANES + l]
 *   v, a, c  outputs, FVI_MOST_LANES numbers each: the value, its first and its second derivative by
 *            the coordinate. a and c are NULL if the derivatives are not needed
 *
 * The digits of a lane are those of fvi_tape_value, fvi_tape_slope and fvi_tape_second_derivative. If
 * fvi_tape_second_derivative gives NaN where fvi_tape_slope gives a number, the lane has NaN. */
void fvi_tape_lanes(const fvi_node *node, size_t n, const double *x, const double *k, double *v,
                    double *a, double *c);

#endif
