/* src/error_control/variable_step_search.h -- Find the tolerance of variable steps that a wanted error of x needs.
 * [H 22] */
#ifndef FVI_VARIABLE_STEP_SEARCH_H
#define FVI_VARIABLE_STEP_SEARCH_H

#include "event_list.h"

#include <fvi/variable_steps.h>

/* The result of fvi_variable_step_search. */
typedef struct {
    double estimate; /* of max |x_k - x(t_k)|, over rows and coordinates */
    fvi_step_statistics counts; /* of the run whose rows are given out */
    double until; /* the last time up to which the error is no more than the wanted one; or, if no run came to its end,
                     the time that the last run reached */
    double step_error, longest; /* the tolerance of a step of that run, the limits of its steps, */
    int growth, fine;
    size_t first; /* and into how many parts its rows were divided */
    double rest;  /* a body whose hops are no higher than this is at rest; 0 without events */
    size_t rows;  /* so many of the times are not after an event that ends the run */
    fvi_event_agreement common; /* of the last two runs */
    fvi_event_list events; /* of that run, on success; free them with fvi_event_list_free */
} fvi_variable_step_found;

/* fvi_variable_step_again -- start a stepper that repeats the run that was found, to the bit. Returns the codes of
 * fvi_stepper_start. */
int fvi_variable_step_again(const fvi_run *run, size_t most,
                            const fvi_variable_step_found *found,
                            fvi_stepper **stepper);

/* fvi_variable_step_search -- compute a run at given times to a wanted error.
 *
 * The search compares two runs whose meshes cannot coincide. The second run has a tenth of the first one's step_error,
 * steps at most half as long as the longest step of the first run, and a growth of at most 2.2 from step to step. The
 * estimate is their largest difference in the rows, plus 3e-14 max |x| for rounding, or plus the error that their
 * coarse modes may have. It estimates the error of the first run. The rows are those of the second run, which are
 * mostly some 500 times better. While the estimate is above `error`, a run with a tenth of the last step_error is
 * compared with the last run.
 *
 *   run       as for fvi_stepper_start; step_error and most_steps are not read
 *   count, t  the times, increasing, within the run; NULL: those of its rows
 *   error     the wanted bound of max |x_k - x(t_k)|, finite, > 0
 *   most      no run of more steps than this is made
 *   x, p      outputs, count d numbers, or (steps + 1) d; p may be NULL
 *   found     output
 *
 * With events, a body is at rest in all runs once its hops are no higher than `error`, and two runs must have the same
 * events. The estimate is then no smaller than the difference of x at each event, nor than the largest speed of x times
 * the difference of the two times. So the time of an event is right to error / speed, except for lift-offs, whose times
 * are not compared. If the lists of events differ, there is no estimate, and the next run decides.
 *
 * The result is an estimate, not a bound. What both runs pass over is not seen, for example a pulse of a force without
 * bounds that is shorter than their steps, or a small jump that is not declared. The error of p may be larger. If five
 * runs in a row fail within a thousandth of one t, no finer run is tried.
 *
 * Returns FVI_SUCCESS; FVI_EFAULT if run, x or found is NULL; FVI_EDOM if error is not finite and > 0; FVI_EINVAL if
 * (steps + 1) d numbers cannot be addressed; what fvi_stepper_start and fvi_stepper_step return; FVI_ENOMEM; FVI_ETOL
 * if rounding keeps the estimate above error, or because of `most`, or because no two runs have the same events:
 * found->estimate is then the smallest estimate, infinite if there was none. On error x, p and, but for FVI_ETOL and
 * found->until, *found are untouched. */
int fvi_variable_step_search(const fvi_run *run, size_t count, const double *t,
                             double error, size_t most, double *x, double *p,
                             fvi_variable_step_found *found);

#endif
