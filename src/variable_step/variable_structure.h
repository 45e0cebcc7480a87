/* src/variable_step/variable_structure.h -- A system with matrices on a mesh of steps of any length.
 *                                                                    [H 27, 22]
 * Internal. Form D, (22.14), with M, C_j and K in the place of numbers: its equation is solved by the
 * eigenvalues of A^{-1}, (27.14), with factors for each length of steps. */
#ifndef FVI_VARIABLE_STRUCTURE_H
#define FVI_VARIABLE_STRUCTURE_H

#include "run/run_damper.h"
#include "stages/stage_solver.h"
#include "variable_mechanism.h"

/* A damper whose history has r numbers z = B^T x; stage i of number n stands at [i * r + n]. */
typedef struct {
    fvi_run_damper of;
    size_t number, r; /* its place among the dampers of the run */
    fvi_mesh_damper memory;
    double W[FVI_STAGES * FVI_STAGES];
    double *before, *now; /* B^T v at the end of the last step; behind a jump of the velocity */
    double *centre;       /* of a spring: where it rests */
    double *z, *zero;     /* room, and zeros */
    double *force;        /* s r: known in the step that is tried, before S */
    double *slope;        /* s r: B^T V_i */
} fvi_mesh_matrix;

/* So many lengths of steps keep their factors: a mesh goes up and down a few rungs. */
enum { FVI_MESH_RUNGS = 6 };

/* Stage i of unknown j stands at [i * d + j]. */
struct fvi_mesh_structure {
    size_t count;
    fvi_mesh_matrix *damper;
    struct {
        double h;
        size_t used;
        fvi_stage_solver *solver;
    } rung[FVI_MESH_RUNGS];
    size_t uses;
    fvi_stage_solver *solver; /* of the step that is tried */
    double h;                 /* for which W is */
    double *numbers;          /* all that follows, in one piece */
    double *load, *delta;     /* s d */
    double *Kx, *Kv, *last, *size, *ones; /* d */
};

/* fvi_structure_mesh_scale, _start, _begin, _shortest, _takes_kicks -- as those of a mechanism
 * (variable_mechanism.h). */
int fvi_structure_mesh_scale(fvi_stepper *s, double *scale);
int fvi_structure_mesh_start(fvi_stepper *s, fvi_variable_step_state *o);
int fvi_structure_mesh_begin(fvi_stepper *s, fvi_variable_step_state *o);
double fvi_structure_mesh_shortest(const fvi_stepper *s, const fvi_variable_step_state *o);
int fvi_structure_mesh_takes_kicks(const fvi_stepper *s, const fvi_variable_step_state *o);

/* fvi_structure_mesh_starts_with_jump -- does this damper see x_0 as a jump from 0 at t = 0? */
int fvi_structure_mesh_starts_with_jump(const fvi_run_damper *of);

/* fvi_structure_mesh_try -- as fvi_variable_step_try. fvi_structure_mesh_advance -- its step is taken: the
 * histories go on. fvi_structure_mesh_jump -- v += M^{-1} J. */
int fvi_structure_mesh_try(fvi_stepper *s, fvi_variable_step_state *o, fvi_length length,
                           double *error);
int fvi_structure_mesh_advance(fvi_variable_step_state *o);
int fvi_structure_mesh_jump(fvi_stepper *s, fvi_variable_step_state *o, const double *J);

/* ---- variable_structure_forces.c: what the dampers do in the last step ---- */

/* fvi_structure_mesh_weights -- of the s values of a function at the stages of the last step: now of its value at t, sum of
 * its integral from the begin of the step to t.
 * fvi_structure_mesh_force -- force += C S, S the sum of such weights times the answers of damper `number` at the stages:
 * its force, or its impulse; d numbers. Returns what C does.
 * fvi_structure_mesh_power -- of that damper, force times velocity at the stages, FVI_LANES numbers; before the impulses that act
 * at the end of the step, and not of a run that was saved. Returns what C does. */
void fvi_structure_mesh_weights(const fvi_stepper *s, double t, double *now, double *sum);
int fvi_structure_mesh_force(const fvi_stepper *s, size_t number, const double *weights, double *force);
int fvi_structure_mesh_power(const fvi_stepper *s, size_t number, double *power);

/* fvi_structure_mesh_copy, _archive, _free -- as fvi_method has them. */
int fvi_structure_mesh_copy(const fvi_stepper *from, fvi_stepper *to);
int fvi_structure_mesh_archive(fvi_stepper *s, fvi_archive *v);
void fvi_structure_mesh_free(fvi_variable_step_state *o);

/* ---- variable_structure_memory.c ---- */

/* fvi_structure_mesh_begin_dampers -- their modes, for a start with x and v.
 * fvi_structure_mesh_solver -- m->solver for steps of such length, and all W.
 * fvi_structure_mesh_predict -- takes from load what is known of the forces of all dampers, but for what V - v_k
 * makes of them.
 * fvi_structure_mesh_leak -- about how far the memory moves each v_j wrongly, d numbers, where `last` is the last
 * Legendre coefficient of h v' (22.16). */
int fvi_structure_mesh_allocate(const fvi_stepper *s, fvi_variable_step_state *o);
int fvi_structure_mesh_begin_dampers(fvi_stepper *s, fvi_variable_step_state *o);
int fvi_structure_mesh_solver(const fvi_stepper *s, fvi_variable_step_state *o, double h);
int fvi_structure_mesh_predict(fvi_variable_step_state *o);
int fvi_structure_mesh_leak(fvi_variable_step_state *o, const double *last, double *size);

#endif
