/* src/adjoint_variable/adjoint_variable.h -- The run that goes backwards over its own mesh. [H 23]
 *
 * Internal: what adjoint.c has for fvi_variable_step. */
#ifndef FVI_ADJOINT_VARIABLE_H
#define FVI_ADJOINT_VARIABLE_H

#include <fvi/sensitivity.h>
#include "recorded_steps.h"
#include "singular_start_adjoint.h"
#include "newton/linearised.h"

/* Stage i of coordinate j stands at [j * FVI_LANES + i]. Where the comment says "each",
 * d numbers. */
typedef struct {
    const fvi_run *run;
    const fvi_objective *J;
    const fvi_sensitivities *want;
    fvi_recorded_steps path;
    const fvi_variable_rule *rule;
    size_t s, d;
    double W_1[FVI_LANES]; /* W0 1, of a law that of its rising terms */
    fvi_square W0_rate;    /* dW0/dbeta, if alpha is wanted */
    int has_history, mass_plus_damping; /* something has a memory; alpha = 1: rho is a mass */
    double *Lambda, *mu, *T, *v, *source; /* LANES d numbers each */
    double *xi, *after, *before;          /* each, see (23.16) */
    double *Jx, *Jp, *column;             /* each */
    double *Jk, *by_mass; /* each: dJ/dp_k of a row, if J has them all; what they have of masses */
    double *kinetic, *sum, *plain, *push; /* each */
    double *subtracted_velocity; /* each: what the memory takes from V, (23.26) */
    fvi_singular_start_adjoint singular_start;
    fvi_linearised linearised;        /* G, stage by stage */
    double *G, *X, *r;                /* s Hessians; s d; s d */
    double *hessian_product;          /* s d: (G Lambda)_i of coordinate j at [i * d + j] */
    double *block;     /* all these; owned */
    fvi_modes *modes;  /* NULL: none is needed */
    fvi_modes *rising; /* of the terms of a law that grow faster than s, or NULL */
    fvi_band J_band;
    size_t row; /* the next row that is asked for its slopes */
} fvi_adjoint_variable_run;

/* fvi_adjoint_variable -- as fvi_adjoint, of a run of fvi_variable_step that is made here; the
 * outputs that are added to are zero. */
int fvi_adjoint_variable(const fvi_run *run, const fvi_objective *objective,
                    const fvi_sensitivities *want);

/* fvi_adjoint_mesh_shape -- by V - v of each stage: what moves x, or v, within a step, by the integrals of
 * powers, (22.18): h times those of fvi_variable_step_twice, or once those of _once.
 * fvi_adjoint_mesh_force -- the force acts at the time t of a stage; the derivative is by its values at the rows,
 * between which it is changed along lines. The multiplier of coordinate j at [j * stride]. */
void fvi_adjoint_mesh_shape(const fvi_variable_rule *rule, double h, const double *integral,
                            double *shape);
void fvi_adjoint_mesh_force(const fvi_run *run, double t, double weight, size_t stride,
                            const double *multiplier, double *force);

/* fvi_adjoint_variable_solve -- (23.16): Lambda and mu of step n, from source, after, xi and the
 * memory, which is told of its length; T is then what mu is not in. Also X, G and G Lambda.
 * Errors: FVI_ESING; what the Hessian returns. */
int fvi_adjoint_variable_solve(fvi_adjoint_variable_run *m, size_t n);

/* What adjoint_variable_singular.c has of the singular part of a start, (23.24) to (23.26):
 * _subtract_velocity  before the first step: subtracted_velocity
 * _accumulate_singular_start  step n begins before t1, and Lambda is there
 * _hand_back  at t1, before the first step that begins there
 * _end_singular_start  at t = 0, where J has by_v0 of v: to the derivatives by x0, p0, mass, damping */
void fvi_adjoint_variable_subtract_velocity(fvi_adjoint_variable_run *m);
void fvi_adjoint_variable_accumulate_singular_start(fvi_adjoint_variable_run *m, size_t n);
void fvi_adjoint_variable_hand_back(fvi_adjoint_variable_run *m);
void fvi_adjoint_variable_end_singular_start(fvi_adjoint_variable_run *m, size_t j, double by_v0);

/* Has x a singular part in step n? And the time of stage i there. */
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

/* The inertia and the damping of coordinate j: alpha = 1 makes rho a mass. */
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
