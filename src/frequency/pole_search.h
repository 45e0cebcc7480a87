/* src/frequency/pole_search.h -- One pole of a system, from an undamped mode.  [H 30] */
#ifndef FVI_POLE_SEARCH_H
#define FVI_POLE_SEARCH_H

#include "dynamic_stiffness.h"

/* A pole on its way: s, d numbers v, the residual of fvi_poles, and |Z v| over what it is summed
 * from, which is 1 where nothing cancels: near s = 0, say. */
typedef struct {
    double complex s, *v;
    double residual, uncancelled;
} fvi_pole_candidate;

/* fvi_pole_is_found -- is it a pole that oscillates, with arg s < widest? */
int fvi_pole_is_found(const fvi_pole_candidate *p, double widest);

/* fvi_pole_newton -- from s and v, which have some digits, to a pole near them.   (30.9)
 * Returns FVI_SUCCESS, whether it is one or not, or FVI_ENOMEM. */
int fvi_pole_newton(fvi_response *response, fvi_pole_candidate *p);

/* fvi_pole_start -- s of an undamped mode v with its lambda: i sqrt(lambda), or, where lambda is not
 * positive, i times the rate at which its inertia and its damping are equal; 0 if there is none.
 * `form` has room for a number of each term of Z. */
double complex fvi_pole_start(const fvi_response *response, double lambda,
                              const double complex *v, double complex *form);

/* fvi_pole_estimate -- the zero of v^T Z(s) v near i sqrt(lambda) for an undamped mode v: no factors are
 * made, and it is off by the square of what the damping changes of the shape. lambda > 0. */
double complex fvi_pole_estimate(const fvi_response *response, double lambda,
                                 const double complex *v, double complex *form);

/* fvi_pole_follow -- from an undamped mode with s = i omega, v along the damping, from none of it
 * to all. The smaller `tight` <= 1 is, the shorter are the steps.            (30.10)
 * Returns as fvi_pole_newton. */
int fvi_pole_follow(fvi_response *response, double tight, fvi_pole_candidate *p);

#endif
