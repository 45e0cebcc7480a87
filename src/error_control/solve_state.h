/* src/error_control/solve_state.h -- The state of a call of fvi_solve. Internal to the room. */
#ifndef FVI_SOLVE_STATE_H
#define FVI_SOLVE_STATE_H

#include "variable_step_search.h"

#include <fvi/solve.h>

/* A problem as a run, and the outputs that the caller wants. */
typedef struct {
    const fvi_outputs *out;
    const fvi_method *method;
    fvi_run run;
    double tolerance;
    size_t most_steps;
    fvi_report *report;
    fvi_error *error;
    fvi_error failure; /* why a step failed, if code is not 0: the runs have it as their `failure` */
    fvi_variable_step_found found; /* the result of a search by fvi-adaptive */
    fvi_event_list events;         /* of the run whose rows are given out */
    size_t reported;               /* so many of these events have been reported to the caller */
    int is_between; /* nonzero if some times lie within steps of one length, where the path of the stages gives x and
                       p */
} fvi_solve_state;

/* fvi_solve_by_steps -- make the run o->run by its steps, and give out its rows and events. Returns FVI_SUCCESS, or a
 * code with *o->error written. */
int fvi_solve_by_steps(fvi_solve_state *o);

/* fvi_solve_between -- solve to o->tolerance, where some of the times lie within the steps of a method with stages. The
 * first step is the one that o->run needs for its rows. It is halved until two runs agree at the times.
 *
 *   most  no run of more steps is made
 *   x, p  outputs: all rows
 *
 * o->report is written. Returns what fvi_step_search and the steps return; FVI_ETOL if more than `most` steps are
 * needed. */
int fvi_solve_between(fvi_solve_state *o, size_t most, double *x, double *p);

/* fvi_solve_prepare -- make a checked run of the caller's problem: o->method, o->run, o->tolerance and o->most_steps.
 * o->out and o->error are set before. Returns FVI_SUCCESS, or a code with *o->error written. */
int fvi_solve_prepare(fvi_solve_state *o, const fvi_problem *problem,
                      const fvi_solve_options *options,
                      const fvi_accuracy *accuracy);

#endif
