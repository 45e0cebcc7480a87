/* src/methods/lobatto_matrices.h -- Take steps with stages for a system with matrices.  [H 27]
 *
 * This header is internal. If the system has matrices, the methods of lobatto_start.c start these
 * steps instead of their own. */
#ifndef FVI_LOBATTO_MATRICES_H
#define FVI_LOBATTO_MATRICES_H

#include "initial_history_force.h"
#include "stages/lobatto_history.h"
#include "stages/stage_solver.h"
#include "step_sums.h"

/* A damper with C = S B^T. Its history has r numbers z = B^T x. Number n of stage i is at [n * s + i] in the arrays for
 * the history, and at [i * r + n] in the arrays for the matrix. */
typedef struct {
    fvi_run_damper of;
    size_t number, r;                  /* number: index among the dampers of the run */
    double W[FVI_STAGES * FVI_STAGES]; /* W_0: the effect of the velocities of a step in the same step */
    double constant[FVI_STAGES];       /* the row sums of W_0: the effect of the constant velocity 1 */
    double scale;                      /* factor of the sums of the history: rho h^(-beta); 1 for a law */
    double *drift;                     /* r numbers: the velocity that the past does not see, or 0 */
    double *slope;                     /* s r numbers, for the history: B^T V_i - drift of this step */
    double *Y;                         /* s r numbers, for the history: its sums */
    double *force;                     /* s r numbers, for the matrix: the force of this step, before the factor S */
    /* s r numbers each, in a linearised run: the derivatives of Y and force by 2 alpha; else NULL */
    double *Ydot, *force_by_order;
    double *z, *zero;                  /* r numbers each: B^T v_k - drift, and zeros */
    /* d impulses so far, and the work so far; kept is NULL if the sums are not kept */
    double *kept, work;
    fvi_lobatto_history *memory;
    fvi_initial_history_force past;
    double impulse[FVI_STAGES];        /* impulses of the past in this step */
} fvi_stage_damper;

/* The step of a small structure as one linear map. Its columns are the results of steps from unit vectors. The map acts
 * on K x_k, K v_k and B^T v_k instead of x_k and v_k. If a stiff structure moves as a rigid body, K x_k is zero, but a
 * map acting on x_k would sum large terms that cancel. `late` holds the rows that no step reads: V_i - v_k, and the
 * forces of the dampers at the stages. */
typedef struct {
    size_t columns, rows, late_rows; /* columns = 0: there is no map */
    /* the matrices column by column (system/dense.h), and vectors for their input and output */
    double *map, *late, *in, *out;
    double *v;                       /* d numbers: v_k of the last step */
    int has_force;                   /* nonzero if the map has columns for the force F(t) */
    int is_late;                     /* nonzero if the late rows of the last step have not been computed yet */
} fvi_step_map;

/* The state of a run. Stage i of unknown j is at [i * d + j]. */
typedef struct {
    fvi_method method; /* a copy of the method that takes these steps */
    const fvi_lobatto_rule *rule;
    size_t s, d, dampers;
    fvi_stage_solver *solver;
    fvi_stage_damper *each;
    double *numbers;   /* one block with all arrays below */
    double *v, *p;     /* d numbers each: M^-1 p and p at the end of the last step */
    double *F, *load;  /* s d numbers each: the forces F(t); the load that remains for the inertia */
    double *V;         /* s d numbers: V_i - v_k */
    double *Kx, *Kv;   /* d numbers each: K x_k and K v_k */
    /* d numbers each: the mean of V_i - v_k with the weights of the rule; the changes of v and p in the step */
    double *mean, *dv, *dp;
    double *room;      /* d numbers of workspace */
    fvi_step_map map;
} fvi_lobatto_matrices;

/* fvi_lobatto_matrices_start -- Start a run with `stages` stages. It is the member `start` of a method. s->method
 * becomes a copy of the method with these steps. Return the codes of fvi_stepper_start; FVI_EUNSUP if the matrices have
 * no complex factors or no product with M. */
int fvi_lobatto_matrices_start(fvi_stepper *s, size_t stages);

/* fvi_lobatto_matrices_of -- Return the state of a stepper that takes these steps, with V and the forces of the dampers
 * of the last step computed. Return NULL for any other stepper. */
fvi_lobatto_matrices *fvi_lobatto_matrices_of(const fvi_stepper *s);

/* fvi_lobatto_matrices_step -- Take a step. It is the member `step` of a method. [(27.14)] */
int fvi_lobatto_matrices_step(fvi_stepper *s);

/* fvi_lobatto_matrices_solve -- Solve the equation of a step. The input is Kx, Kv, F, and z, Y and impulse of each
 * damper. The output is V_i - v_k in V, mean, dv and dp, and slope and force of each damper. The output is linear in
 * the input. Y is changed. Return FVI_SUCCESS, or the code of a function of the matrices. */
int fvi_lobatto_matrices_solve(const fvi_stepper *s, fvi_lobatto_matrices *o);

/* fvi_lobatto_matrices_ends -- Compute the sums of the last step, as fvi_step_ends does. */
int fvi_lobatto_matrices_ends(const fvi_stepper *s, fvi_step_sums *sums);

/* fvi_lobatto_matrices_has_initial_history_force -- Return nonzero if the initial history of a
 * damper has a force. (19.3) */
int fvi_lobatto_matrices_has_initial_history_force(const fvi_stepper *s);

/* ---- lobatto_matrices_dampers.c ---- */

/* fvi_stage_dampers_tolerance -- Return the tolerance for the histories of a run. */
double fvi_stage_dampers_tolerance(const fvi_run *run);

/* fvi_stage_dampers_start -- Allocate the dampers of a run and their histories. v is the velocity at t = 0. */
int fvi_stage_dampers_start(fvi_stepper *s, const double *v);

/* fvi_stage_dampers_read -- Compute z of this step, and the impulses of the pasts. */
int fvi_stage_dampers_read(const fvi_stepper *s, fvi_lobatto_matrices *o);

/* fvi_stage_dampers_begin_step -- Subtract from load the forces of the pasts and of the histories in this step, and the
 * damping of the constant velocity v_k. */
int fvi_stage_dampers_begin_step(const fvi_stepper *s, fvi_lobatto_matrices *o);

/* fvi_stage_dampers_end_step -- Compute the forces and the slopes of the step from V. */
int fvi_stage_dampers_end_step(fvi_lobatto_matrices *o);

/* fvi_stage_dampers_push -- Push the slopes of the step into the histories. */
int fvi_stage_dampers_push(fvi_lobatto_matrices *o);

/* fvi_stage_damper_sums -- Add the impulse of the last step to `impulse`, d numbers, and its work to *work. */
int fvi_stage_damper_sums(const fvi_stepper *s, size_t i, double *impulse, double *work);

int fvi_stage_dampers_keep(fvi_stepper *s);
int fvi_stage_dampers_told(const fvi_stepper *s, size_t j, double *impulse, double *work);
int fvi_stage_dampers_copy(const fvi_stepper *from, fvi_stepper *to);
int fvi_stage_dampers_serialize(fvi_stepper *s, fvi_archive *archive);
void fvi_stage_dampers_stop(fvi_lobatto_matrices *o);

/* ---- lobatto_matrices_map.c ---- */

/* fvi_step_map_start -- Compute the map at k = 0, after everything else has been started, if the structure is small,
 * the run is long enough, and the run is not a linearised one. Cost: about two steps without the map for each column.
 * Return FVI_SUCCESS; FVI_ENOMEM; or the code of fvi_lobatto_matrices_solve. */
int fvi_step_map_start(fvi_stepper *s, fvi_lobatto_matrices *o);

/* fvi_step_map_apply -- Do the work of fvi_lobatto_matrices_solve, except for V and the forces, and return 1. Return 0
 * if there is no map, or if the system has got a force since the start. The result differs from
 * fvi_lobatto_matrices_solve by rounding errors. */
int fvi_step_map_apply(fvi_stepper *s, fvi_lobatto_matrices *o);

/* fvi_step_map_finish -- Compute V and the forces of the last step, if they have not been computed yet. */
void fvi_step_map_finish(fvi_lobatto_matrices *o);

/* fvi_step_map_copy -- Copy the map of a structure with d unknowns to `to`, which has no map. Return
 * FVI_SUCCESS or FVI_ENOMEM. */
int fvi_step_map_copy(size_t d, const fvi_step_map *from, fvi_step_map *to);
void fvi_step_map_stop(fvi_step_map *map);

#endif
