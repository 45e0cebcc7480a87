/* src/expression/enclosure.h -- What a function can be in an interval of t.  [H 22]
 *
 * Interval arithmetic along a tape. It takes t from an interval and gives, of each node f,
 * an interval that holds all its values, and bounds of its derivatives:
 *
 *     low <= f(t) <= high,
 *     |f^(k)(t)| / k! <= most[k],                k = 0, ..., order
 *     |f^(k)(t)| / k! <= part[k] |f(t)|.
 *
 * A sum of squares that is far from 0, or an exponential, changes by a small part of itself
 * while it is astronomically large or small: part says so where most cannot. Every number is
 * rounded outward, by more than its operations and the functions of the C library lose. A
 * bound that is not known, or derivatives that do not exist, are INFINITY. Bounds hold in
 * the interval and may be far too large: sin(t) - sin(t) is between -2 and 2. The shorter
 * the interval the nearer they come. */
#ifndef FVI_ENCLOSURE_H
#define FVI_ENCLOSURE_H

#include "tape.h"

enum { FVI_ENCLOSURE_ORDER = FVI_BOUND_ORDER };

typedef struct {
    double low, high;
    double most[FVI_ENCLOSURE_ORDER + 1], part[FVI_ENCLOSURE_ORDER + 1];
    int top; /* the most[k] and part[k] beyond are 0 */
} fvi_enclosure;

/* fvi_tape_enclose -- of the last of n nodes, for every t in [from, to].
 *
 *   k      parameters
 *   order  FVI_ENCLOSURE_ORDER at most; derivatives beyond are left alone
 *
 * Coordinates are all the same t. Cost O(n order^2). Returns FVI_SUCCESS or FVI_ENOMEM. */
int fvi_tape_enclose(const fvi_node *node, size_t n, double from, double to,
                     const double *k, int order, fvi_enclosure *f);

/* fvi_enclosure_half -- half of the range, at least; 0 of a number. */
double fvi_enclosure_half(const fvi_enclosure *f);

#endif
