/* src/step_search.h -- The step that a wanted error needs.      [Chapter 18] */
#ifndef FVI_STEP_SEARCH_H
#define FVI_STEP_SEARCH_H

#include "trajectory.h"

/* What a search found. */
typedef struct {
    size_t parts;    /* each step of the run was cut into so many */
    double estimate; /* of max |x_k - x(t_k)|, over rows and coordinates */
    double order;    /* q of (18.2) */
} fvi_step_found;

/* fvi_step_search -- halve the step until the error of x is small enough.
 *                                                               [(18.1), (18.2)]
 * The run is repeated with steps h, h/2, h/4, ...: x^(0), x^(1), x^(2), ... With
 *
 *     D_j = max |x^(j) - x^(j-1)|,   q_j = log2(D_{j-1} / D_j),
 *
 * the error of x^(j) is estimated, after Richardson, to be
 *
 *     D_j / (2^q - 1) + tolerance max |x^(j)|,    q = min(max(q_j, 1/4), p),
 *
 * p the lowest order of the method, the number with which method->order begins,
 * tolerance that of the run's memory (and of its rounding). In place of 1/4 stands
 * 1 - 2 alpha, the order, where that is less: fvi_fractional, Riemann-Liouville, a
 * damped coordinate that does not start at 0. The search ends when the estimate is
 * <= error. A run that overflows, or does not converge, says only that its step is
 * too long (the error handler is called, though).
 *
 *   method  which integrator
 *   run     as for fvi_start; run->h and run->steps give the rows t_k = k h, which
 *           stay where they are. If there are less than 128 of them, more times,
 *           evenly between, are compared too
 *   error   what max |x_k - x(t_k)| may be, finite, > 0
 *   most    no run of more steps than this is made
 *   x, p    outputs, (steps + 1) d numbers, rows k = 0, ..., N of the last run; p
 *           may be NULL
 *   found   output
 *
 * The estimate cannot see what all steps h / 2^j do wrong alike: a jump of F
 * that is not at a row is such a thing, and the error of p is another matter.
 * Time: at most twice that of the last run. Memory: three times that of x.
 *
 * Returns GSL_SUCCESS; GSL_EFAULT if method, run, x or found is NULL; GSL_EDOM if
 * error is not finite and > 0; GSL_EINVAL if (steps + 1) d numbers cannot be
 * addressed; what fvi_start returns; GSL_ENOMEM; GSL_ETOL if the error was not
 * reached, because of most or because rounding made it grow again: *found then
 * is the smallest estimate seen (infinite if there was none). On error x, p and,
 * but for GSL_ETOL, *found are untouched. */
int fvi_step_search(const fvi_method *method, const fvi_run *run, double error,
                    size_t most, double *x, double *p, fvi_step_found *found);

#endif
