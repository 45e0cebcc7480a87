/* src/error_control/search_bound.h -- Steps that pass over nothing of the force.  [H 18] */
#ifndef FVI_SEARCH_BOUND_H
#define FVI_SEARCH_BOUND_H

#include <fvi/trajectory.h>

/* fvi_search_node_factors -- C_k of (18.8), for the nodes of 2^n steps of length 1, in [n][k].
 *
 *   stages  3 to 8: Lobatto's nodes of each step; else its ends
 *   factor  output, for k = 1 up to the number of nodes and FVI_BOUND_ORDER. More than
 *           2^FVI_BOUND_DOUBLINGS steps have no larger ones */
enum { FVI_BOUND_DOUBLINGS = 4 };
typedef double fvi_node_factors[FVI_BOUND_DOUBLINGS + 1][FVI_BOUND_ORDER + 1];
void fvi_search_node_factors(size_t stages, fvi_node_factors factor);

/* fvi_search_least_parts -- into how many parts each step of the run has to be cut, a power
 * of two, so that none is longer than run->longest, and what force.bound lets happen between
 * the nodes moves no coordinate farther than the wanted error (18.8).
 *
 *   stages of the method, which sees the force at Lobatto's nodes; below 3 at the ends of steps
 *   error  of x, > 0
 *   most   no more parts than these are tried
 *   parts  output: the number; or the first power of two above `most`
 *
 * Returns FVI_SUCCESS, FVI_ENOMEM, or what force.bound returned. */
int fvi_search_least_parts(const fvi_run *run, size_t stages, double error,
                           size_t most, size_t *parts);

/* fvi_search_is_too_long -- does a run that returned this say no more than that its step is too long?
 * fvi_search_agreed -- how many rows, from the first on, are no further apart in two runs than the error; d numbers each. */
int fvi_search_is_too_long(int status);
size_t fvi_search_agreed(size_t rows, size_t d, const double *x, const double *before, double error);

#endif
