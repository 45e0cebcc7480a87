/* src/adjoint_variable/adjoint_variable.h -- The adjoint run of a chain on its mesh. [H 23]
 *
 * Internal: adjoint.c calls this for fvi_variable_step. */
#ifndef FVI_ADJOINT_VARIABLE_H
#define FVI_ADJOINT_VARIABLE_H

#include <fvi/sensitivity.h>
#include "recorded_steps.h"
#include "singular_start_adjoint.h"
#include "newton/linearised.h"

/* Stage i of coordinate j stands at [j * FVI_LANES + i]; "each" means that an array has d numbers. */
typedef struct {
    const fvi_run *run;
    const fvi_objective *J;
    const fvi_sensitivities *want;
    fvi_recorded_steps path;
    fvi_variable_step_state *o; /* of the stepper of the run; its modes become those of the adjoint run */
    const fvi_variable_rule *rule;
    size_t s, d;
    double W_1[FVI_LANES]; /* W0 1; with a law W0 1 of its terms that grow faster than s */
    fvi_square W0_rate;    /* dW0/dbeta, if alpha is wanted */
    int has_history, mass_plus_damping; /* something has a history; alpha = 1: rho is added to the mass */
    double *Lambda, *mu, *T, *v, *source; /* FVI_LANES d numbers each: the multipliers; the same in reverse order; the
                                             sums of the history; room; the derivatives of J through the rows of a step
                                             by V - v */
    double *xi, *after, *before;          /* each: xi of (23.16); the derivative of J by v at the end of the step; the
                                             last mu of the step after */
    double *Jx, *Jp, *column;             /* each */
    double *Jk, *by_mass; /* each: dJ/dp_k of a row, if J depends on all momenta; the derivatives by masses through
                             these */
    double *kinetic, *sum, *plain, *push; /* each: the derivative by the mass; sums of velocities times T, of T, and of
                                             Lambda */
    double *subtracted_velocity; /* each: the velocity that the history subtracts from V, (23.26) */
    fvi_singular_start_adjoint singular_start;
    fvi_linearised linearised;        /* G, stage by stage */
    double *G, *X, *r;                /* s Hessians; s d; s d numbers */
    double *hessian_product;          /* s d: entry j of G Lambda at stage i at [i * d + j] */
    double *block;     /* the memory of all these arrays; owned */
    fvi_band J_band;
    size_t row; /* the next row that J's slopes are asked for */
} fvi_adjoint_variable_run;

/* fvi_adjoint_variable -- as fvi_adjoint, for a chain by fvi_variable_step. The run is made here. The outputs that are
 * added to must be zero. */
int fvi_adjoint_variable(const fvi_run *run, const fvi_objective *objective,
                    const fvi_sensitivities *want);

/* fvi_adjoint_mesh_shape -- how much V - v of each stage moves x, or v, at a time within a step (22.18): `shape` is h
 * times the integrals of powers by fvi_variable_step_twice for x, and with h = 1 the integrals by
 * fvi_variable_step_once for v.
 * fvi_adjoint_mesh_force -- add the derivatives by the force of a stage at the time t to `force`. The derivatives are
 * by the force at the rows, and the force changes along straight lines between them. The multiplier of coordinate j
 * stands at [j * stride]. */
void fvi_adjoint_mesh_shape(const fvi_variable_rule *rule, double h, const double *integral,
                            double *shape);
void fvi_adjoint_mesh_force(const fvi_run *run, double t, double weight, size_t stride,
                            const double *multiplier, double *force);

/* fvi_adjoint_variable_solve -- compute Lambda and mu of step n from source, after, xi and the history (23.16). Begins
 * the step in the modes. Also writes T, the part of the history without mu, and X, G and G Lambda. Returns FVI_SUCCESS;
 * FVI_ESING; what the Hessian returns. */
int fvi_adjoint_variable_solve(fvi_adjoint_variable_run *m, size_t n);

/* The functions of adjoint_variable_singular.c, for the singular part of a start, (23.24) to (23.26):
 *
 *   _subtract_velocity   before the first step: write subtracted_velocity
 *   _accumulate_singular_start  in a step n that begins before t1, after Lambda is known
 *   _transfer_back       at t1, before the first step that begins there
 *   _end_singular_start  at t = 0: add to the derivatives by x0, p0, mass and damping; by_v0 is dJ/dv_0 */
void fvi_adjoint_variable_subtract_velocity(fvi_adjoint_variable_run *m);
void fvi_adjoint_variable_accumulate_singular_start(fvi_adjoint_variable_run *m, size_t n);
void fvi_adjoint_variable_transfer_back(fvi_adjoint_variable_run *m);
void fvi_adjoint_variable_end_singular_start(fvi_adjoint_variable_run *m, size_t j, double by_v0);

/* Return nonzero if x has a singular part in step n. */
static inline int fvi_adjoint_variable_is_singular(const fvi_adjoint_variable_run *m, size_t n)
{
    return m->singular_start.is && fvi_singular_before(&m->singular_start.undamped, m->path.step[n].t);
}

static inline double fvi_adjoint_variable_time(const fvi_adjoint_variable_run *m,
                                          size_t n, size_t i)
{
    const fvi_recorded_step *step = &m->path.step[n];
    return fvi_variable_step_stage_time(m->rule, step->t, step->length.h, i);
}

/* The mass and the damping of coordinate j in the equation of a step: at alpha = 1 rho is added to the mass. */
static inline double fvi_adjoint_variable_mass(const fvi_adjoint_variable_run *m,
                                          size_t j)
{
    const fvi_system *system = m->run->system;
    return system->mass[j] + (m->mass_plus_damping ? system->damping[j] : 0);
}

static inline double fvi_adjoint_variable_damping(const fvi_adjoint_variable_run *m,
                                             size_t j)
{
    return m->mass_plus_damping ? 0 : m->run->system->damping[j];
}

#endif
