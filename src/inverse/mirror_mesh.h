/* src/inverse/mirror_mesh.h -- The run that goes backwards over its own mesh. [Chapter 23]
 *
 * Internal: what adjoint.c has for fvi_adaptive. */
#ifndef FVI_MIRROR_MESH_H
#define FVI_MIRROR_MESH_H

#include <fvi/adjoint.h>
#include "mesh_path.h"
#include "mirror_pull.h"
#include "system/band.h"

/* Stage i of coordinate j stands at [j * FVI_LANES + i]. Where the comment says "each",
 * d numbers. */
typedef struct {
    const fvi_run *run;
    const fvi_objective *J;
    const fvi_gradients *want;
    fvi_mesh_path path;
    const fvi_variable_rule *rule;
    size_t s, d;
    double W_1[FVI_LANES]; /* W0 1 */
    fvi_square W0_rate;    /* dW0/dbeta, if alpha is wanted */
    int remembers, heavy; /* something has a memory; alpha = 1: rho is a mass */
    double *Lambda, *mu, *T, *v, *source; /* LANES d numbers each */
    double *xi, *after, *before;          /* each, see (23.16) */
    double *Jx, *Jp, *column;             /* each */
    double *kinetic, *sum, *plain, *push; /* each */
    double *still; /* each: what the memory takes from V, (23.26) */
    fvi_mirror_pull pull;
    double *G, *X, *r; /* s Hessians; s d; s d */
    double *block;     /* all these; owned */
    fvi_modes *modes;  /* NULL: none is needed */
    fvi_band J_band;
    size_t row; /* the next row that is asked for its slopes */
} fvi_mirror_mesh_run;

/* fvi_mirror_mesh -- as fvi_adjoint, of a run of fvi_adaptive that is made here; the
 * outputs that are added to are zero. */
int fvi_mirror_mesh(const fvi_run *run, const fvi_objective *objective,
                    const fvi_gradients *want);

/* fvi_mirror_mesh_solve -- (23.16): Lambda and mu of step n, from source, after, xi and the
 * memory, which is told of its length; T is then what mu is not in. Also X, and G.
 * Errors: FVI_ESING; what the Hessian returns. */
int fvi_mirror_mesh_solve(fvi_mirror_mesh_run *m, size_t n);

/* fvi_mirror_mesh_bent -- (G Lambda)_i of coordinate j. */
double fvi_mirror_mesh_bent(const fvi_mirror_mesh_run *m, size_t j, size_t i);

/* What mirror_mesh_pull.c has of the singular part of a start, (23.24) to (23.26):
 * _rest       before the first step: still
 * _meet_pull  step n begins before t1, and Lambda is there
 * _hand_back  at t1, before the first step that begins there
 * _end_pull   at t = 0, where J has by_v0 of v: to the derivatives by x0, p0, mass, damping */
void fvi_mirror_mesh_rest(fvi_mirror_mesh_run *m);
void fvi_mirror_mesh_meet_pull(fvi_mirror_mesh_run *m, size_t n);
void fvi_mirror_mesh_hand_back(fvi_mirror_mesh_run *m);
void fvi_mirror_mesh_end_pull(fvi_mirror_mesh_run *m, size_t j, double by_v0);

/* Has x a singular part in step n? And the time of stage i there. */
static inline int fvi_mirror_mesh_pulls(const fvi_mirror_mesh_run *m, size_t n)
{
    return m->pull.is && fvi_singular_before(&m->pull.bare, m->path.step[n].t);
}

static inline double fvi_mirror_mesh_time(const fvi_mirror_mesh_run *m,
                                          size_t n, size_t i)
{
    const fvi_mesh_step *step = &m->path.step[n];
    return fvi_adaptive_stage_time(m->rule, step->t, step->length.h, i);
}

/* The inertia and the damping of coordinate j: alpha = 1 makes rho a mass. */
static inline double fvi_mirror_mesh_mass(const fvi_mirror_mesh_run *m,
                                          size_t j)
{
    const fvi_system *system = m->run->system;
    return system->mass[j] + (m->heavy ? system->damping[j] : 0);
}

static inline double fvi_mirror_mesh_damping(const fvi_mirror_mesh_run *m,
                                             size_t j)
{
    return m->heavy ? 0 : m->run->system->damping[j];
}

#endif
