/* src/expression/tape_lanes.h -- A tape at several places at once.        [H 28] */
#ifndef FVI_TAPE_LANES_H
#define FVI_TAPE_LANES_H

#include "tape.h"
#include "system/lanes.h"

/* The longest tape that is so walked: its numbers stand on the stack, 24 kilobytes at most. */
enum { FVI_TAPE_LANES_LONGEST = 128 };

/* fvi_tape_lanes -- the last of n nodes in each lane, for a tape of one coordinate.
 *
 *   x        the coordinate, FVI_MOST_LANES numbers
 *   k        parameter j of lane l at [j * FVI_MOST_LANES + l]
 *   v, a, c  outputs, FVI_MOST_LANES numbers each: the value, its first and its second derivative by
 *            the coordinate. Without the derivatives a and c are NULL
 *
 * The digits of a lane are those of fvi_tape_value, fvi_tape_slope and fvi_tape_second_derivative, or where
 * the latter are defined and the former are not, NaN. */
void fvi_tape_lanes(const fvi_node *node, size_t n, const double *x, const double *k, double *v,
                    double *a, double *c);

#endif
