/* src/frequency/pole_search.h -- Find one pole of a system, from an undamped mode.  [H 30] */
#ifndef FVI_POLE_SEARCH_H
#define FVI_POLE_SEARCH_H

#include "dynamic_stiffness.h"

#include <stdint.h>

/* A candidate for a pole: s, the shape v (d numbers), the residual as in fvi_poles, and |Z v| divided by the sum of the
 * norms of its terms. The last number is near 1 if nothing cancels, for example near s = 0. */
typedef struct {
    double complex s, *v;
    double residual, uncancelled;
} fvi_pole_candidate;

/* A pole with a larger arg s is taken for a real one, and is no oscillation, unless (30.7) says that it is one. */
#define FVI_NEARLY_REAL 3.14

/* fvi_pole_is_found -- Return nonzero if the candidate is a pole that oscillates, with arg s < widest. */
int fvi_pole_is_found(const fvi_pole_candidate *p, double widest);

/* fvi_pole_is_close -- Return nonzero if two candidates have one s, to rounding errors.
 * fvi_pole_is_same -- Return nonzero if they have one shape, too. A pole with two shapes is two poles. */
int fvi_pole_is_close(const fvi_pole_candidate *a, const fvi_pole_candidate *b);
int fvi_pole_is_same(size_t d, const fvi_pole_candidate *a, const fvi_pole_candidate *b);

/* fvi_pole_newton -- Find a pole near s and v, which are right to some digits.   (30.9)
 * Return FVI_SUCCESS, whether a pole is found or not; or FVI_ENOMEM. */
int fvi_pole_newton(fvi_response *response, fvi_pole_candidate *p);

/* fvi_pole_newton_from -- Find a pole near s alone. The shape begins as numbers that look random and follow from *seed,
 * which changes. So the next call may end at another shape of the pole.
 * Return as fvi_pole_newton. */
int fvi_pole_newton_from(fvi_response *response, fvi_pole_candidate *p, uint64_t *seed);

/* fvi_pole_start -- Return s for an undamped mode v with its lambda: i sqrt(lambda). If lambda is not positive, return
 * i times the frequency at which inertia and damping are equal, or 0 if there is none. `form` has room for a number for
 * each term of Z. */
double complex fvi_pole_start(const fvi_response *response, double lambda,
                              const double complex *v, double complex *form);

/* fvi_pole_estimate -- Return the zero of v^T Z(s) v near i sqrt(lambda) for an undamped mode v. No factors are
 * computed. The error is the square of the change of the shape by the damping. lambda > 0. */
double complex fvi_pole_estimate(const fvi_response *response, double lambda,
                                 const double complex *v, double complex *form);

/* fvi_pole_follow -- Follow a pole from an undamped mode with s = i omega and shape v, from no damping to all of it. A
 * smaller `limit_factor` <= 1 makes the steps shorter.            (30.10)
 * Return as fvi_pole_newton. */
int fvi_pole_follow(fvi_response *response, double limit_factor, fvi_pole_candidate *p);

#endif
