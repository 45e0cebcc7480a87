/* src/adjoint_variable/recorded_steps.h -- A run of fvi_variable_step, recorded step by step. [H 23] */
#ifndef FVI_RECORDED_STEPS_H
#define FVI_RECORDED_STEPS_H

#include "variable_step/variable_step.h"

#include <fvi/sensitivity.h>

/* The beginning and the length of a step. */
typedef struct {
    double t;
    fvi_length length;
    int is_hit; /* nonzero if an impulse acts at its end */
} fvi_recorded_step;

/* The record of a run. Step n has `size` numbers, from numbers[n * size] on. */
typedef struct {
    fvi_stepper *stepper; /* the stepper of the run, at its end; owned */
    size_t d, size, steps, room;
    fvi_recorded_step *step;
    double *numbers;
    double *rows, *p;   /* x at the times of the rows; the last p */
    double *impulse_dv; /* d numbers: the velocity that an impulse at the last time has added */
} fvi_recorded_steps;

/* fvi_recorded_steps_start -- start a run that will be recorded.
 *
 *   for_adjoint  nonzero: start by fvi_variable_step_start_for_adjoint
 *   path         output; give it back with fvi_recorded_steps_free, also after an error
 *
 * Returns what fvi_stepper_start returns; FVI_EINVAL if the rows cannot be addressed; FVI_ENOMEM.
 *
 * fvi_recorded_steps_go -- make this run. After each step `record` writes the path->size numbers of the step.
 *
 * fvi_recorded_steps_run -- start and make a run without a mechanism. The numbers of step n, coordinate j, are x and v
 * at its beginning, at j and d + j; the velocity that an impulse there has added to v, at 2 d + j; and V - v at its
 * stages, from 3 d + j FVI_LANES on.
 *
 * The last two return what fvi_stepper_step returns, too. */
enum { FVI_MESH_NUMBERS = 3 + FVI_LANES };
int fvi_recorded_steps_start(const fvi_run *run, int for_adjoint, fvi_recorded_steps *path);
int fvi_recorded_steps_go(fvi_recorded_steps *path, void (*record)(void *params, double *numbers), void *params);
int fvi_recorded_steps_run(const fvi_run *run, int for_adjoint, fvi_recorded_steps *path);
void fvi_recorded_steps_free(fvi_recorded_steps *path);

/* fvi_recorded_steps_slopes -- ask J for its slopes at row k. Writes dJ/dx_k to Jx, d numbers, and dJ/dp of the last
 * row to Jp. If J depends on all momenta, dJ/dp_k of another row goes to Jk. Jx and Jk are zeroed before. Returns what
 * J's slopes return. */
int fvi_recorded_steps_slopes(const fvi_recorded_steps *path, const fvi_run *run, const fvi_objective *J, size_t k,
                              double *Jx, double *Jp, double *Jk);

#endif
