/* src/error_control/search_bound.h -- Find steps that cannot pass over a pulse of the force. [H 18] */
#ifndef FVI_SEARCH_BOUND_H
#define FVI_SEARCH_BOUND_H

#include <fvi/trajectory.h>

/* fvi_search_node_factors -- compute the factors C_k of (18.8) for the nodes of 2^n steps of length 1: factor[n][k].
 *
 *   stages  3 to 8: the nodes are Lobatto's nodes of each step; else they are the ends of the steps
 *   factor  output, for k = 1 up to the number of nodes and up to FVI_BOUND_ORDER. The factors of more than
 *           2^FVI_BOUND_DOUBLINGS steps are not larger than the last ones */
enum { FVI_BOUND_DOUBLINGS = 4 };
typedef double fvi_node_factors[FVI_BOUND_DOUBLINGS + 1][FVI_BOUND_ORDER + 1];
void fvi_search_node_factors(size_t stages, fvi_node_factors factor);

/* fvi_search_least_parts -- compute into how many parts each step of the run must be cut. The number is a power of two.
 * With it no step is longer than run->longest, and the changes that force.bound allows between the nodes move no
 * coordinate farther than the wanted error (18.8).
 *
 *   stages  of the method, which evaluates the force at Lobatto's nodes; below 3 at the ends of steps
 *   error   of x, > 0
 *   most    no larger number is tried
 *   parts   output: the number; or the first power of two above `most`
 *
 * Returns FVI_SUCCESS, FVI_ENOMEM, or what force.bound returned. */
int fvi_search_least_parts(const fvi_run *run, size_t stages, double error,
                           size_t most, size_t *parts);

/* fvi_search_is_too_long -- nonzero if this status of a run says only that its step is too long.
 * fvi_search_agreed -- how many rows, from the first on, differ by no more than `error` between two runs; d numbers a
 * row. */
int fvi_search_is_too_long(int status);
size_t fvi_search_agreed(size_t rows, size_t d, const double *x, const double *before, double error);

#endif
