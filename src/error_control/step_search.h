/* src/error_control/step_search.h -- Find the step size that a wanted error of x needs. [H 18] */
#ifndef FVI_STEP_SEARCH_H
#define FVI_STEP_SEARCH_H

#include <fvi/trajectory.h>

/* The result of a search. */
typedef struct {
    size_t parts;    /* each step of the run was cut into so many */
    double estimate; /* of max |x_k - x(t_k)|, over rows and coordinates */
    double order;    /* q of (18.2); 1 where D is rounding */
    double until;    /* the last time up to which D is no more than the wanted error */
} fvi_step_found;

/* fvi_step_search -- halve the step until the error of x is small enough. [(18.1), (18.2), (18.5) - (18.7)]
 *
 * The run is repeated with steps h, h/2, h/4, ...: x^(0), x^(1), x^(2), ... Let
 *
 *     D_j = max |x^(j) - x^(j-1)|,   q_j = log2(D_{j-1} / D_j),
 *
 * Richardson's estimate of the error of x^(j) is
 *
 *     D_j / (2^q - 1) + tolerance max |x^(j)|,    q = min(q_{j-1}, q_j, p),
 *
 * where p is the order of x that the method has on this run at a fixed t. The tolerance is the tolerance of the run's
 * memory and of its rounding; for eight stages and matrices it is 5e-12 at least. The search ends when the estimate
 * is <= error and is believed, which takes four runs at least. An estimate is believed under two conditions:
 *
 *     q_{j-1}, q_j >= p' - min(1/2, p'/2)                                 (18.5)
 *         (p' = p but for fvi_midpoint_variational, 1, and three stages and more, whose
 *         order over all t may be as low as 3 - 2 alpha, 2 with a law. p = 1 - 2 alpha for
 *         a method with paper_convention, Riemann-Liouville, alpha < 1/2, where a damped
 *         coordinate does not start at 0; p = 1 for kappa != 1/2 in methods that have a kappa;
 *         with several dampers alpha is the highest order);
 *     F, at 128 random times, is at most half as far from its linear interpolant
 *         between nodes as with steps twice as long                       (18.7)
 *         (the random times are the same in each search).
 *
 * If D_{j-1} and D_j are rounding errors, <= 10 tolerance max |x|, the estimate is D_j + tolerance max |x| instead. In
 * place of (18.5) it needs
 *
 *     h_j^2 max_i sum_j |U_ij| / m_i <= 1 at the rows of the run           (18.6);
 *
 * with matrices the left side is h^2 times the largest eigenvalue of M^-1 K, estimated from below by some percent.
 *
 * A run that overflows, or does not converge, says only that its step is too long.
 *
 *   method  its lowest, highest, stages and paper_convention are read
 *   run     as for fvi_stepper_start; run->h and run->steps give the rows t_k = k h, which stay where they are. If
 *           there are fewer than 128 rows, times evenly between them are compared, too
 *   error   the wanted bound of max |x_k - x(t_k)|, finite, > 0
 *   most    no run of more steps than this is made
 *   x, p    outputs, (steps + 1) d numbers, rows k = 0, ..., N of the last run; p may be NULL
 *   found   output
 *
 * The result is an estimate, not a bound, because finitely many samples bound no error. An error that all steps h / 2^j
 * make alike is not seen unless (18.7) sees it. With force.bound a step is believed only if the bound leaves room for
 * no more than the error between its nodes (18.8). Without force.bound three things are not seen: a pulse shorter than
 * the steps, a fast part of F much smaller than the deviation in (18.7), and a single jump between two rows. But no
 * step that is believed is longer than run->longest. The error of p may be larger.
 *
 * Time: at most twice the time of the last run, which has about one halving more than the estimate alone asks for.
 * Memory: three times that of x, and a Hessian for (18.6). If there is no memory for the Hessian, (18.6) counts as
 * failed.
 *
 * Returns FVI_SUCCESS; FVI_EFAULT if method, run, x or found is NULL; FVI_EDOM if error is not finite and > 0, or if
 * the run has no solution (19.2); FVI_EINVAL if (steps + 1) d numbers cannot be addressed or method->lowest < 1; what
 * fvi_stepper_start returns; FVI_EUNSUP for a method that chooses its steps; FVI_ENOMEM; FVI_ETOL if the error was not
 * reached, because of `most` or because rounding made it grow again: *found then is the smallest estimate that was
 * believed (infinite if there was none). FVI_ETOL is a result: no error handler is called for it, nor for the runs that
 * fail. A code that a callback of the caller returned is returned here. But if a run returns FVI_EOVRFLW, FVI_EMAXITER
 * or FVI_ESING, its steps are too long, and the search goes on with shorter ones. On error x, p and, but for FVI_ETOL,
 * *found are untouched. */
int fvi_step_search(const fvi_method *method, const fvi_run *run, double error,
                    size_t most, double *x, double *p, fvi_step_found *found);

/* fvi_step_search_other -- a method that may reach an error which this method did not reach.
 *
 *   method, run  as above, not NULL; the run is one that fvi_stepper_start takes, and has a solution (19.2)
 *
 * The candidates are the methods in fvi_methods (methods.h) that take such a run, and have a higher order than `method`
 * on this run. Returns the candidate that chooses its steps, if there is one; or else the candidate of the highest
 * order, the first if there are several; NULL if there is none. Whether that method reaches the error is not tried
 * here. */
const fvi_method *fvi_step_search_other(const fvi_method *method,
                                        const fvi_run *run);

#endif
