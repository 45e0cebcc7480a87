/* src/inverse/mesh_path.h -- A run of fvi_adaptive, step by step.      [Chapter 23] */
#ifndef FVI_MESH_PATH_H
#define FVI_MESH_PATH_H

#include "adaptive/adaptive.h"

/* A step: where it begins and how long it is. */
typedef struct {
    double t;
    fvi_length length;
} fvi_mesh_step;

/* What is kept of a run. Of step n, x and v at its beginning, what an impulse there has
 * added to v, and V - v at its stages stand at numbers[n * FVI_MESH_NUMBERS * d], those of
 * coordinate j at j, d + j, 2 d + j, and 3 d + j FVI_LANES. */
enum { FVI_MESH_NUMBERS = 3 + FVI_LANES };
typedef struct {
    const fvi_variable_rule *rule;
    const fvi_square *to_x; /* X = x + h c v + h to_x (V - v) */
    fvi_square W0;
    double beta, T, least;
    fvi_singular singular; /* as it begins, without its arrays */
    size_t d, steps, room;
    fvi_mesh_step *step;
    double *numbers;
    double *rows, *p; /* x at the times of the rows; the last p */
    double *kick;     /* what an impulse at the last time added to v, d numbers */
} fvi_mesh_path;

/* fvi_mesh_path_run -- the run, recorded. path: output; fvi_mesh_path_free it in any case.
 *   open  as fvi_adaptive_start_open
 * Returns what fvi_start and fvi_step return; FVI_EINVAL if the rows cannot be addressed;
 * FVI_ENOMEM. */
int fvi_mesh_path_run(const fvi_run *run, int open, fvi_mesh_path *path);
void fvi_mesh_path_free(fvi_mesh_path *path);

#endif
