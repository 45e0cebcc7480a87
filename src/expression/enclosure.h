/* src/expression/enclosure.h -- Enclose the values and derivatives of a function in an interval of t.  [H 22]
 *
 * This is interval arithmetic along a tape. t is any number of an interval. For each node f it gives an interval that
 * contains all values of f, and bounds of its derivatives:
 *
 *     low <= f(t) <= high,
 *     |f^(k)(t)| / k! <= most[k],                k = 0, ..., order
 *     |f^(k)(t)| / k! <= part[k] |f(t)|.
 *
 * A sum of squares that is far from 0, or an exponential, changes by a small part of itself even where it is extremely
 * large or small. part tells this where most cannot. Every number is rounded outward, by more than the rounding errors
 * of its operations and of the functions of the C library. A bound is INFINITY if it is not known or if the derivative
 * does not exist. The bounds hold in the interval, but may be far too large: for example, sin(t) - sin(t) is enclosed
 * by -2 and 2. They get better as the interval gets shorter. */
#ifndef FVI_ENCLOSURE_H
#define FVI_ENCLOSURE_H

#include "tape.h"

enum { FVI_ENCLOSURE_ORDER = FVI_BOUND_ORDER };

typedef struct {
    double low, high;
    double most[FVI_ENCLOSURE_ORDER + 1], part[FVI_ENCLOSURE_ORDER + 1];
    int top; /* most[k] and part[k] are 0 for k > top, and not stored */
} fvi_enclosure;

/* fvi_tape_enclose -- Enclose the last of n nodes for all t in [from, to].
 *
 *   k      parameters
 *   order  at most FVI_ENCLOSURE_ORDER; higher derivatives are not written
 *
 * All coordinates are the same t. Cost O(n order^2). Return FVI_SUCCESS or FVI_ENOMEM. */
int fvi_tape_enclose(const fvi_node *node, size_t n, double from, double to,
                     const double *k, int order, fvi_enclosure *f);

/* fvi_enclosure_half -- Return an upper bound of half the width of the range; 0 for a number. */
double fvi_enclosure_half(const fvi_enclosure *f);

#endif
