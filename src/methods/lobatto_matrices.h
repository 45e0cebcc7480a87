/* src/methods/lobatto_matrices.h -- Stages of a system with matrices.      [H 27]
 *
 * Internal: the methods of lobatto_start.c start these steps in place of their own where the
 * system has matrices. */
#ifndef FVI_LOBATTO_MATRICES_H
#define FVI_LOBATTO_MATRICES_H

#include "initial_history_force.h"
#include "stages/lobatto_history.h"
#include "stages/stage_solver.h"
#include "step_sums.h"

/* A damper of C = S B^T, whose history has r numbers z = B^T x. Number n of stage i stands at
 * [n * s + i] where the history reads and writes, and at [i * r + n] where the matrix does. */
typedef struct {
    fvi_run_damper of;
    size_t number, r;                  /* its place among the dampers of the run */
    double W[FVI_STAGES * FVI_STAGES]; /* what the velocities of a step do in this step */
    double constant[FVI_STAGES];       /* the sums of its rows: what a velocity that stays 1 does */
    double scale;                      /* rho h^(-beta) before the sums of the history; 1 of a law */
    double *drift;                     /* r: of a velocity that the past does not see, else 0 */
    double *slope;                     /* s r: B^T V_i - drift of the step at hand, for the history */
    double *Y;                         /* s r: its sums */
    double *force;                     /* s r: of the step at hand, before S, for the matrix */
    double *Ydot, *force_by_order;     /* s r each, of a linearised run: their derivatives by 2 alpha; or NULL */
    double *z, *zero;                  /* r: B^T v_k - drift, and zeros */
    double *kept, work;                /* d impulses up to now, and the work; NULL: nobody asked */
    fvi_lobatto_history *memory;
    fvi_initial_history_force past;
    double impulse[FVI_STAGES];        /* of the past in the step at hand */
} fvi_stage_damper;

/* A step of a small structure as one linear map, whose columns are steps from unit vectors. It takes K x_k, K v_k and
 * B^T v_k, not x_k and v_k: where a stiff structure moves as a whole K x_k is zero, and the product of the map with x_k
 * would be the sum of large terms that cancel. `late` has the rows that no step reads: V_i - v_k, and the forces of the
 * dampers at the stages. */
typedef struct {
    size_t columns, rows, late_rows; /* columns 0: there is no map */
    double *map, *late, *in, *out;   /* the matrices by columns (system/dense.h), and room */
    double *v;                       /* d: v_k of the last step */
    int has_force;                   /* does it take forces of t? */
    int is_late;                     /* are the late rows of the last step yet to be made? */
} fvi_step_map;

/* Stage i of unknown j stands at [i * d + j]. */
typedef struct {
    fvi_method method; /* with these steps */
    const fvi_lobatto_rule *rule;
    size_t s, d, dampers;
    fvi_stage_solver *solver;
    fvi_stage_damper *each;
    double *numbers;   /* all that follows, in one piece */
    double *v, *p;     /* d: M^-1 p and p where the last step ended; go from step to step */
    double *F, *load;  /* s d: the forces of t; what is left for the inertia to answer */
    double *V;         /* s d: V_i - v_k */
    double *Kx, *Kv;   /* d: K x_k and K v_k */
    double *mean, *dv, *dp; /* d: the mean of V_i - v_k by the weights of the rule; what the step adds to v and p */
    double *room;      /* d */
    fvi_step_map map;
} fvi_lobatto_matrices;

/* fvi_lobatto_matrices_start -- as the start of a method; s->method becomes a copy of it with these
 * steps. Errors as fvi_stepper_start; FVI_EUNSUP where the matrices have no complex factors, or no
 * product with M. */
int fvi_lobatto_matrices_start(fvi_stepper *s, size_t stages, int damped);

/* fvi_lobatto_matrices_of -- of a stepper that takes these steps, V and the forces of the dampers of the last step
 * included; NULL else. */
fvi_lobatto_matrices *fvi_lobatto_matrices_of(const fvi_stepper *s);

/* fvi_lobatto_matrices_step -- as fvi_stepper_step.                        [(27.14)] */
int fvi_lobatto_matrices_step(fvi_stepper *s);

/* fvi_lobatto_matrices_solve -- from Kx, Kv, F, and the z, the Y and the impulse of each damper: V_i - v_k in V, mean, dv
 * and dp, and the slope and the force of each damper. Linear in what it reads. Changes Y. Returns what the functions of
 * the matrices return. */
int fvi_lobatto_matrices_solve(const fvi_stepper *s, fvi_lobatto_matrices *o);

/* fvi_lobatto_matrices_ends -- as fvi_step_ends. */
int fvi_lobatto_matrices_ends(const fvi_stepper *s, fvi_step_sums *sums);

/* fvi_lobatto_matrices_has_initial_history_force -- has a damper an initial history with a force? (19.3) */
int fvi_lobatto_matrices_has_initial_history_force(const fvi_stepper *s);

/* ---- lobatto_matrices_dampers.c ---- */

/* fvi_stage_dampers_tolerance -- the tolerance that the histories of a run are asked for. */
double fvi_stage_dampers_tolerance(const fvi_run *run);

/* fvi_stage_dampers_start -- the dampers of a run, with their histories; v is the velocity at t = 0. */
int fvi_stage_dampers_start(fvi_stepper *s, const double *v);

/* fvi_stage_dampers_read -- the z of this step, and the impulses of the pasts. */
int fvi_stage_dampers_read(const fvi_stepper *s, fvi_lobatto_matrices *o);

/* fvi_stage_dampers_begin_step -- takes from load what the pasts and the histories do in this step, and
 * what the damping makes of a constant velocity v_k. */
int fvi_stage_dampers_begin_step(const fvi_stepper *s, fvi_lobatto_matrices *o);

/* fvi_stage_dampers_end_step -- V is there: the forces of the step, and its slopes. */
int fvi_stage_dampers_end_step(fvi_lobatto_matrices *o);

/* fvi_stage_dampers_push -- the slopes go into the histories, which are a step on. */
int fvi_stage_dampers_push(fvi_lobatto_matrices *o);

/* fvi_stage_damper_sums -- adds the impulse of the last step to `impulse`, d numbers, and its work to
 * *work. */
int fvi_stage_damper_sums(const fvi_stepper *s, size_t i, double *impulse, double *work);

int fvi_stage_dampers_keep(fvi_stepper *s);
int fvi_stage_dampers_told(const fvi_stepper *s, size_t j, double *impulse, double *work);
int fvi_stage_dampers_copy(const fvi_stepper *from, fvi_stepper *to);
int fvi_stage_dampers_serialize(fvi_stepper *s, fvi_archive *archive);
void fvi_stage_dampers_stop(fvi_lobatto_matrices *o);

/* ---- lobatto_matrices_map.c ---- */

/* fvi_step_map_start -- at k = 0, after all else: a map, if the structure is small, the run is long enough and is not a
 * linearised one. Cost about that of twice as many steps without the map as it has columns. Returns FVI_SUCCESS; FVI_ENOMEM;
 * what fvi_lobatto_matrices_solve returns. */
int fvi_step_map_start(fvi_stepper *s, fvi_lobatto_matrices *o);

/* fvi_step_map_apply -- what fvi_lobatto_matrices_solve does, but for V and the forces, and returns 1; 0 without a map, or
 * if the system has got a force since the start. Digits: both differ by roundings. */
int fvi_step_map_apply(fvi_stepper *s, fvi_lobatto_matrices *o);

/* fvi_step_map_finish -- V and the forces of the last step, if they are missing. */
void fvi_step_map_finish(fvi_lobatto_matrices *o);

/* fvi_step_map_copy -- of a structure with d unknowns; `to` has none. Returns FVI_SUCCESS or FVI_ENOMEM. */
int fvi_step_map_copy(size_t d, const fvi_step_map *from, fvi_step_map *to);
void fvi_step_map_stop(fvi_step_map *map);

#endif
