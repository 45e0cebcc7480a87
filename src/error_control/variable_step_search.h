/* src/error_control/variable_step_search.h -- The tolerance of variable steps that a wanted error
 * needs.                                                             [H 22] */
#ifndef FVI_VARIABLE_STEP_SEARCH_H
#define FVI_VARIABLE_STEP_SEARCH_H

#include "event_list.h"

#include <fvi/variable_steps.h>

/* What fvi_variable_step_search found. */
typedef struct {
    double estimate; /* of max |x_k - x(t_k)|, over rows and coordinates */
    fvi_step_statistics counts; /* of the run whose rows are given out, */
    double until; /* the last time up to which the error is no more than was wanted; or, if no run came to its end, the time
                   * to which the last one came */
    double step_error, longest; /* its tolerance of a step, its limits, */
    int growth, fine;
    size_t first; /* and into how many its rows were divided */
    double rest;  /* a body whose hops are no higher is at rest; 0 without events */
    size_t rows;  /* so many of the times are before an event that ends the run, or at it */
    fvi_event_agreement common; /* of the last two runs */
    fvi_event_list events; /* on success those of that run: give them back with fvi_event_list_free */
} fvi_variable_step_found;

/* fvi_variable_step_again -- a stepper that makes that run again, to the bit. Errors as of
 * fvi_stepper_start. */
int fvi_variable_step_again(const fvi_run *run, size_t most,
                            const fvi_variable_step_found *found,
                            fvi_stepper **stepper);

/* fvi_variable_step_search -- a run at given times, right to a wanted error.
 *
 * Two runs whose meshes cannot coincide: the second with a tenth of the first one's
 * step_error, steps at most half as long as its longest, growing at most 2.2-fold. Their
 * largest difference in the rows, and 3e-14 max |x| for the rounding, or what their modes
 * may be off by, is the estimate. It tells the error of the first run;
 * the rows are those of the second, and mostly some 500 times better. While the estimate is above `error`, a run with
 * a tenth again is compared with the last.
 *
 *   run    as for fvi_stepper_start; step_error and most_steps are not read
 *   count, t  the times, increasing, within the run; NULL: those of its rows
 *   error  what max |x_k - x(t_k)| may be, finite, > 0
 *   most   no run of more steps than this is made
 *   x, p   outputs, count d numbers, or (steps + 1) d; p may be NULL
 *   found  output
 *
 * With events both runs call a body at rest whose hops are no higher than `error`, and two runs must have
 * the same events: the estimate is no smaller than the difference of x at each event, and than the largest
 * speed of x times the difference of the two times. So the time of an event is right to error / speed, but for
 * lift-offs, whose times are not compared.
 * Where the lists differ there is no estimate, and the next run decides.
 *
 * It is an estimate, no bound: what both runs pass over, a pulse of a force without bounds
 * that is shorter than their steps, say, is not seen, nor perhaps a small jump that is not declared. The
 * error of p is another matter. Where five runs in a row fail within a thousandth of one t,
 * no finer one is tried.
 * Returns FVI_SUCCESS; FVI_EFAULT if run, x or found is NULL; FVI_EDOM if error is not
 * finite and > 0; FVI_EINVAL if (steps + 1) d numbers cannot be addressed; what fvi_stepper_start
 * and fvi_stepper_step return; FVI_ENOMEM; FVI_ETOL if rounding keeps the estimate above error, or
 * because of most, or because no two runs have the same events: found->estimate is then the smallest one,
 * infinite if there was none. On
 * error x, p and, but for FVI_ETOL and found->until, *found are untouched. */
int fvi_variable_step_search(const fvi_run *run, size_t count, const double *t,
                             double error, size_t most, double *x, double *p,
                             fvi_variable_step_found *found);

#endif
