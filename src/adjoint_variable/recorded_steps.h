/* src/adjoint_variable/recorded_steps.h -- A run of fvi_variable_step, step by step.      [H 23] */
#ifndef FVI_RECORDED_STEPS_H
#define FVI_RECORDED_STEPS_H

#include "variable_step/variable_step.h"

#include <fvi/sensitivity.h>

/* A step: where it begins and how long it is. */
typedef struct {
    double t;
    fvi_length length;
} fvi_recorded_step;

/* What is kept of a run. Of step n, x and v at its beginning, what an impulse there has
 * added to v, and V - v at its stages stand at numbers[n * FVI_MESH_NUMBERS * d], those of
 * coordinate j at j, d + j, 2 d + j, and 3 d + j FVI_LANES. */
enum { FVI_MESH_NUMBERS = 3 + FVI_LANES };
typedef struct {
    const fvi_variable_rule *rule;
    const fvi_square *to_x; /* X = x + h c v + h to_x (V - v) */
    fvi_square W0;
    double beta, T, least;
    fvi_modes_kind modes_kind;
    fvi_singular singular; /* as it begins, without its arrays */
    size_t d, steps, room;
    fvi_recorded_step *step;
    double *numbers;
    double *rows, *p; /* x at the times of the rows; the last p */
    double *impulse_dv;     /* what an impulse at the last time added to v, d numbers */
    fvi_stepper *stepper;   /* of a run with a law, or of a structure, which knows its kernels; else NULL */
} fvi_recorded_steps;

/* fvi_recorded_steps_run -- the run, recorded. path: output; fvi_recorded_steps_free it in any case.
 *   open  as fvi_variable_step_start_for_adjoint
 * Returns what fvi_stepper_start and fvi_stepper_step return; FVI_EINVAL if the rows cannot be addressed;
 * FVI_ENOMEM. */
int fvi_recorded_steps_run(const fvi_run *run, int for_adjoint, fvi_recorded_steps *path);
void fvi_recorded_steps_free(fvi_recorded_steps *path);

/* fvi_recorded_steps_slopes -- dJ/dx of row k to Jx, d numbers, and dJ/dp of the last row to Jp, of another row to Jk
 * where J has all momenta; Jx and Jk are zeroed before. Returns what J's slopes do. */
int fvi_recorded_steps_slopes(const fvi_recorded_steps *path, const fvi_run *run, const fvi_objective *J, size_t k,
                              double *Jx, double *Jp, double *Jk);

#endif
