/* src/error_control/solve_state.h -- What fvi_solve keeps. Internal to the room. */
#ifndef FVI_SOLVE_STATE_H
#define FVI_SOLVE_STATE_H

#include "variable_step_search.h"

#include <fvi/solve.h>

/* A problem as a run, and what its caller wants of it. */
typedef struct {
    const fvi_outputs *out;
    const fvi_method *method;
    fvi_run run;
    double tolerance;
    size_t most_steps;
    fvi_report *report;
    fvi_error *error;
    fvi_variable_step_found found; /* of a search by fvi-adaptive */
    fvi_event_list events;         /* of the run whose rows are given out, */
    size_t told;                   /* of which the caller knows so many */
    int is_between; /* nonzero if times stand between steps of one length, where stages give a path */
} fvi_solve_state;

/* fvi_solve_between -- to o->tolerance, at times of which some lie within the steps of a method with stages: the step that
 * o->run needs at its rows, and half of it until two runs agree at the times. x and p of all rows are written, and
 * o->report. Returns what fvi_step_search and the steps return; FVI_ETOL if it would take more than `most` steps. */
int fvi_solve_between(fvi_solve_state *o, size_t most, double *x, double *p);

/* fvi_solve_prepare -- from what is asked for to a run that is checked: o->method, o->run, o->tolerance
 * and o->most_steps. o->out and o->error are there. Returns FVI_SUCCESS, or a code with *o->error
 * written. */
int fvi_solve_prepare(fvi_solve_state *o, const fvi_problem *problem,
                      const fvi_solve_options *options,
                      const fvi_accuracy *accuracy);

#endif
