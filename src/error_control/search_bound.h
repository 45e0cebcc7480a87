/* src/error_control/search_bound.h -- Steps that pass over nothing of the force.  [H 18] */
#ifndef FVI_SEARCH_BOUND_H
#define FVI_SEARCH_BOUND_H

#include <fvi/trajectory.h>

/* fvi_search_least_parts -- into how many parts each step of the run has to be cut, a power
 * of two, so that none is longer than run->longest, and what force.bound lets happen between
 * the nodes moves no coordinate farther than the wanted error (18.8).
 *
 *   error  of x, > 0
 *   most   no more parts than these are tried
 *   parts  output: the number; or the first power of two above `most`
 *
 * Returns FVI_SUCCESS, FVI_ENOMEM, or what force.bound returned. */
int fvi_search_least_parts(const fvi_run *run, double error, size_t most,
                           size_t *parts);

#endif
