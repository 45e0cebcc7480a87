/* src/error_control/step_search.h -- The step that a wanted error needs.      [H 18] */
#ifndef FVI_STEP_SEARCH_H
#define FVI_STEP_SEARCH_H

#include <fvi/trajectory.h>

/* What a search found. */
typedef struct {
    size_t parts;    /* each step of the run was cut into so many */
    double estimate; /* of max |x_k - x(t_k)|, over rows and coordinates */
    double order;    /* q of (18.2); 1 where D is rounding */
    double until;    /* the last time up to which D is no more than the error that was wanted */
} fvi_step_found;

/* fvi_step_search -- halve the step until the error of x is small enough.
 *                                            [(18.1), (18.2), (18.5) - (18.7)]
 * The run is repeated with steps h, h/2, h/4, ...: x^(0), x^(1), x^(2), ... With
 *
 *     D_j = max |x^(j) - x^(j-1)|,   q_j = log2(D_{j-1} / D_j),
 *
 * the error of x^(j) is estimated, after Richardson, to be
 *
 *     D_j / (2^q - 1) + tolerance max |x^(j)|,    q = min(q_{j-1}, q_j, p),
 *
 * p the order of x that the method has on this run at a fixed t, tolerance that of
 * the run's memory (and of its rounding; of eight stages and matrices 5e-12 at least). The search ends when the estimate is
 * <= error and is believed, which takes four runs at least:
 *
 *     q_{j-1}, q_j >= p' - min(1/2, p'/2)                                 (18.5)
 *         (p' = p but for fvi_midpoint_variational, 1, and three stages and more, whose
 *         order over all t may be as low as 3 - 2 alpha, 2 with a law. p = 1 - 2 alpha for
 *         a method with paper_convention, Riemann-Liouville, alpha < 1/2, where a damped
 *         coordinate does not start at 0; p = 1 for kappa != 1/2 in methods that have a kappa;
 *         of several dampers alpha is that of the highest order);
 *     F, at 128 random times, is at most half as far from its linear interpolant
 *         between nodes as with steps twice as long                       (18.7)
 *         (the random times are the same in each search);
 *     if D_{j-1} and D_j are rounding, <= 10 tolerance max |x|, the estimate is
 *         D_j + tolerance max |x| and, in place of (18.5),
 *         h_j^2 max_i sum_j |U_ij| / m_i <= 1 at the rows of the run      (18.6);
 *     with matrices (18.6) is h^2 times the largest eigenvalue of M^-1 K instead
 *     (from below by some percent).
 *
 * A run that overflows, or does not converge, says only that its step is too long.
 *
 *   method  which integrator; its lowest, highest, stages and paper_convention are read
 *   run     as for fvi_stepper_start; run->h and run->steps give the rows t_k = k h, which
 *           stay where they are. If there are less than 128 of them, more times,
 *           evenly between, are compared too
 *   error   what max |x_k - x(t_k)| may be, finite, > 0
 *   most    no run of more steps than this is made
 *   x, p    outputs, (steps + 1) d numbers, rows k = 0, ..., N of the last run; p
 *           may be NULL
 *   found   output
 *
 * It is an estimate, no bound: finitely many samples bound no error. What all steps
 * h / 2^j do wrong alike is not seen unless (18.7) sees it. Where force.bound is there, only
 * steps are believed between whose nodes it leaves room for no more than the error (18.8);
 * where it is not, a pulse shorter than the steps is not seen, nor a fast part
 * of F much smaller than the deviation in (18.7), nor a single jump between two rows: no
 * step that is believed is longer than run->longest. The error of p is another matter.
 * Time: at most twice that of the last run, which is about one halving more than
 * the estimate alone would ask for. Memory: three times that of x; a Hessian more
 * for (18.6), which is taken to fail if it cannot be had.
 *
 * Returns FVI_SUCCESS; FVI_EFAULT if method, run, x or found is NULL; FVI_EDOM if
 * error is not finite and > 0, or if the run has no solution (19.2); FVI_EINVAL if
 * (steps + 1) d numbers cannot be addressed or method->lowest < 1; what fvi_stepper_start
 * returns; FVI_EUNSUP for a method that chooses its steps; FVI_ENOMEM; FVI_ETOL if the
 * error was not reached, because of most or because rounding made it grow again: *found
 * then is the smallest estimate that was believed (infinite if there was none). FVI_ETOL
 * is an answer: no error handler is called for it, nor for the runs that fail. What a
 * callback of the caller's returned comes back; but FVI_EOVRFLW, FVI_EMAXITER or
 * FVI_ESING, in a run, says that its steps are too long, and the search goes on with
 * shorter ones. On error x, p and, but for FVI_ETOL, *found are untouched. */
int fvi_step_search(const fvi_method *method, const fvi_run *run, double error,
                    size_t most, double *x, double *p, fvi_step_found *found);

/* fvi_step_search_other -- a method that may reach what this one did not.
 *
 *   method, run  as above, not NULL; the run is one that fvi_stepper_start takes, and has a
 *                solution (19.2)
 *
 * Of the methods in fvi_methods (methods.h) that take such a run, and have a higher order
 * than method on this run: the one that chooses its steps, if there is one, or else that of
 * the highest order, the first if there are several; NULL if there is none. That it reaches
 * the error is not tried here. */
const fvi_method *fvi_step_search_other(const fvi_method *method,
                                        const fvi_run *run);

#endif
