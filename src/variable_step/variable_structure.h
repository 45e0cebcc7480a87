/* src/variable_step/variable_structure.h -- A system with matrices in a run with variable steps. [H 27, 22]
 *
 * Internal to the library. A step is form D, (22.14), with the matrices M, C_j and K in place of numbers. The
 * eigenvalues of A^{-1} separate its stages, (27.14), and each length of steps has its own factors. */
#ifndef FVI_VARIABLE_STRUCTURE_H
#define FVI_VARIABLE_STRUCTURE_H

#include "run/run_damper.h"
#include "stages/stage_solver.h"
#include "variable_mechanism.h"

/* A damper whose history has r numbers z = B^T x. Stage i of number n stands at [i * r + n]. */
typedef struct {
    fvi_run_damper of;
    size_t number, r; /* its index among the dampers of the run */
    fvi_mesh_damper memory;
    double W[FVI_STAGES * FVI_STAGES];
    double *before, *now; /* B^T v at the end of the last step: before and after a jump of the velocity */
    double *centre;       /* for a spring: z at rest */
    double *z, *zero;     /* room for r numbers; r zeros */
    double *force;        /* s r: the known part of the forces in the step that is tried, before S of C = S B^T */
    double *slope;        /* s r: B^T delta */
} fvi_mesh_matrix;

/* The factors of the last lengths of steps are kept, because the lengths of a run go up and down by a few rungs. */
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
    double h;                 /* of the steps that all W are for; 0: none */
    double *numbers;          /* all arrays below, in one piece */
    double *load, *delta;     /* s d numbers each */
    double *Kx, *Kv, *last, *size, *ones; /* d numbers each */
};

/* fvi_structure_mesh_scale, _start, _begin, _shortest -- the functions of a mechanism (variable_mechanism.h) for a
 * system with matrices. They return FVI_SUCCESS; FVI_EUNSUP if the matrices have no
 * complex factors or a damper has the order 2; FVI_ENOMEM; the codes of the matrices. */
int fvi_structure_mesh_scale(fvi_stepper *s, double *scale);
int fvi_structure_mesh_start(fvi_stepper *s, fvi_variable_step_state *o);
int fvi_structure_mesh_begin(fvi_stepper *s, fvi_variable_step_state *o);
double fvi_structure_mesh_shortest(const fvi_stepper *s, const fvi_variable_step_state *o);

/* fvi_structure_mesh_starts_with_jump -- return nonzero if the history of this damper contains a jump of x from 0 to
 * x_0 at t = 0. */
int fvi_structure_mesh_starts_with_jump(const fvi_run_damper *of);

/* fvi_structure_mesh_try -- try a step as fvi_variable_step_try does.
 *
 * fvi_structure_mesh_advance -- advance the histories of all dampers by this step.
 *
 * fvi_structure_mesh_jump -- add factor M^{-1} J to v.
 *
 * They return FVI_SUCCESS; FVI_ENOMEM; the codes of the matrices and of the force. */
int fvi_structure_mesh_try(fvi_stepper *s, fvi_variable_step_state *o, fvi_length length,
                           double *error);
int fvi_structure_mesh_advance(fvi_variable_step_state *o);
int fvi_structure_mesh_jump(fvi_stepper *s, fvi_variable_step_state *o, const double *J, double factor);

/* ---- variable_structure_forces.c: the forces of dampers in the last step ---- */

/* fvi_structure_mesh_weights -- compute weights of the s values of a function at the stages of the last step. now: for
 * its value at t; sum: for its integral from the start of the step to t. FVI_LANES numbers each.
 *
 * fvi_structure_mesh_force -- add S z to force, d numbers, where C = S B^T is the matrix of damper `number` and z is
 * the sum of its answers at the stages times the weights. With the weights `now` this is the force of the damper, with
 * `sum` its impulse.
 *
 * fvi_structure_mesh_power -- compute force times velocity of this damper at the stages, FVI_LANES numbers. Call it
 * before the impulses at the end of the step act, and not in a run that comes from an archive before its next step.
 *
 * The last two return FVI_SUCCESS or the code of the damping matrix. */
void fvi_structure_mesh_weights(const fvi_stepper *s, double t, double *now, double *sum);
int fvi_structure_mesh_force(const fvi_stepper *s, size_t number, const double *weights, double *force);
int fvi_structure_mesh_power(const fvi_stepper *s, size_t number, double *power);

/* fvi_structure_mesh_copy, _archive, _free -- the parts of the functions of fvi_method for a system with matrices. */
int fvi_structure_mesh_copy(const fvi_stepper *from, fvi_stepper *to);
int fvi_structure_mesh_archive(fvi_stepper *s, fvi_archive *v);
void fvi_structure_mesh_free(fvi_variable_step_state *o);

/* ---- variable_structure_memory.c ---- */

/* fvi_structure_mesh_allocate -- allocate o->structure. fvi_structure_mesh_free frees it, also after an error.
 *
 * fvi_structure_mesh_begin_dampers -- allocate the modes of all dampers, for a start with x and v.
 *
 * fvi_structure_mesh_solver -- set m->solver and all W for steps of length h.
 *
 * fvi_structure_mesh_predict -- subtract from load the known part of the forces of all dampers, that is without the
 * effect of V - v_k.
 *
 * fvi_structure_mesh_leak -- compute about how much the memory changes each v_j wrongly: d numbers, in size. `last` is
 * the last Legendre coefficient of h v' of each coordinate. (22.16)
 *
 * They return FVI_SUCCESS; FVI_EUNSUP if a pole of a law is too near to its cut; FVI_ENOMEM; the codes of the
 * matrices. */
int fvi_structure_mesh_allocate(const fvi_stepper *s, fvi_variable_step_state *o);
int fvi_structure_mesh_begin_dampers(fvi_stepper *s, fvi_variable_step_state *o);
int fvi_structure_mesh_solver(const fvi_stepper *s, fvi_variable_step_state *o, double h);
int fvi_structure_mesh_predict(fvi_variable_step_state *o);
int fvi_structure_mesh_leak(fvi_variable_step_state *o, const double *last, double *size);

#endif
