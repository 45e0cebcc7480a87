/* src/sensitivity/tangent.h -- A run with its derivatives, on its way.            [H 24]
 *
 * Internal. The derivative of a run along a direction is a run of the same method, of the linearised system,
 * with forces of its own (linearised.h): what the direction changes in the equations of each step. Arrays of
 * P d numbers: coordinate i along direction j at [j * d + i]. Stages count from 0 here; methods without
 * stages have one. */
#ifndef FVI_TANGENT_H
#define FVI_TANGENT_H

#include "adjoint_constant.h"
#include "adjoint_lobatto_terms.h"
#include "methods/initial_history_force.h"
#include "newton/linearised.h"

/* What the numbers of one damper change; r numbers are remembered. */
typedef struct {
    fvi_run_damper of;
    size_t number, first, r;   /* its place; that of its terms among all */
    double unit, theta;        /* before its sums for rho = 1; the shift of (23.7) */
    int has_line, is_liouville; /* does its history know the line x0 + t v0; does it begin at 0? */
    int is_asked, by_order, by_terms; /* do directions change it, by its order, by numbers of a law? */
    double *zeros, *z, *mean;  /* r each: zeros; z of the last node, and mean of the last two */
    double *dz, *change;       /* r each: their increments */
    double *now, *before;      /* P r: impulses of the last node and of the one before, before S */
    double *by_theta;          /* r: what the shift changes */
    double *v, *Y, *Ydot;      /* s r, of stages: velocities less the line, and two sums */
    double *block;             /* all these; owned */
    fvi_adjoint_constant memory; /* of z, at nodes */
    fvi_adjoint_term *term;      /* of a law; owned; so many of them: */
    size_t terms;
    fvi_lobatto_history *of_stages; /* of v */
    fvi_stage_terms terms_of_stages;
    fvi_initial_history_force past; /* its impulses for an amplitude of 1 */
    double impulse_unit;            /* 0: no past acts */
    double *CA;                     /* d: A, or C A of a matrix; owned */
} fvi_tangent_damper;

typedef struct {
    fvi_run own;              /* as its steps see it */
    const fvi_run *run;       /* it */
    const fvi_method *method;
    const fvi_sensitivities *along; /* the directions */
    size_t P, d, s, size;     /* s: stages; size: of a Hessian */
    double kappa;
    fvi_stepper *stepper;     /* of the run */
    double *x_k, *v0;         /* d: x at the beginning of the step; p0/m */
    double *dx, *pi;          /* P d each: d x_k, d p_k; pi stands behind dx */
    /* the linearised runs: of one coordinate one run with P of them, else P runs */
    size_t lanes, width;
    fvi_linearised *linearised;
    fvi_system *system;
    fvi_stepper **lane;
    double *mass, *damping;   /* P each: of one coordinate */
    double *G;                /* s Hessians */
    double *dU;               /* s P d: what the parameters change in grad U at the stages, stage by stage */
    double *source;           /* s P d: forces, as fvi_linearised takes them, run by run */
    double *left, *right;     /* P d each: what a step without stages loses before and behind its solution */
    double *room;             /* d, or a Hessian */
    double *block;            /* all these arrays; owned */
    fvi_tangent_damper *each; /* owned */
    size_t dampers;
    /* of stages */
    const fvi_lobatto_rule *rule;
    double A[FVI_STAGES][FVI_STAGES];
    double *V, *X;            /* s d: velocities, positions */
} fvi_tangent_run;

/* fvi_tangent_start -- at k = 0; run and along stay the caller's.
 *
 *   method  without stages, or with
 *   along   P directions
 *   enough  what the histories of stages have to keep of their sums; 0: what that of the run keeps
 *   o       output, which fvi_tangent_stop gives back in any case
 *
 * Returns as fvi_directional_derivatives (adjoint.h). */
int fvi_tangent_start(const fvi_method *method, const fvi_run *run, size_t P,
                      const fvi_sensitivities *along, double enough, fvi_tangent_run *o);

/* fvi_tangent_step -- a step of the run and of its derivatives. */
int fvi_tangent_step(fvi_tangent_run *o);

void fvi_tangent_stop(fvi_tangent_run *o);

/* fvi_tangent_nodes_step, fvi_tangent_stages_step -- that of methods without stages, and with. */
int fvi_tangent_nodes_step(fvi_tangent_run *o);
int fvi_tangent_stages_step(fvi_tangent_run *o);

/* fvi_tangent_velocity -- p/m at the node at hand, before anything hits the body there; without matrices. */
void fvi_tangent_velocity(const fvi_tangent_run *o, double *v);

/* fvi_tangent_evaluate_potential -- Hess U at X into stage i of G, and what the parameters change in grad U
 * there into dU. Returns what a callback does. */
int fvi_tangent_evaluate_potential(fvi_tangent_run *o, size_t i, const double *X);

/* fvi_tangent_damper_start -- damper j, where directions change it; keep: the tolerance of stages.
 * fvi_tangent_damper_next -- node k: the impulses that the directions change, in now.
 * fvi_tangent_damper_impulses -- a step from node k: they, and the impulses of the past, are added to what the
 * step loses.
 *
 * What methods with stages ask of tangent_dampers.c, too:
 * fvi_tangent_numbers -- rho, alpha, time and end of term l along direction j.
 * fvi_tangent_rho -- rho of number i, or that of the damper.
 * fvi_tangent_multiply -- to += share S y, or share y.
 * fvi_tangent_past -- the impulses of the past in step k, and their slopes by e if they are asked for.
 * fvi_tangent_past_along -- what direction j changes in n of them for an A of 1, of coordinate i; those of the
 * terms of a law at two ends. */
int fvi_tangent_damper_start(fvi_tangent_run *o, double keep, fvi_tangent_damper *a);
int fvi_tangent_damper_next(fvi_tangent_run *o, size_t k, fvi_tangent_damper *a);
int fvi_tangent_damper_impulses(fvi_tangent_run *o, size_t k, fvi_tangent_damper *a);
void fvi_tangent_numbers(const fvi_tangent_run *o, const fvi_tangent_damper *a, size_t j, size_t l,
                         double number[4]);
double fvi_tangent_rho(const fvi_tangent_run *o, const fvi_tangent_damper *a, size_t i);
int fvi_tangent_multiply(const fvi_tangent_run *o, const fvi_tangent_damper *a, double share, const double *y,
                         double *to);
void fvi_tangent_past(const fvi_tangent_damper *a, size_t k, double *at, double *slope);
void fvi_tangent_past_along(const fvi_tangent_run *o, const fvi_tangent_damper *a, size_t k, size_t j, size_t i,
                            const double *at, const double *slope, size_t n, double *change);
void fvi_tangent_damper_stop(fvi_tangent_damper *a);

/* fvi_tangent_source -- the forces along direction j at stage i, d numbers. */
static inline double *fvi_tangent_source(const fvi_tangent_run *o, size_t j, size_t i)
{
    return o->source + (o->lanes == 1 && o->P > 1 ? i * o->P + j : (j * o->s + i) * o->d);
}

/* fvi_tangent_factor -- by what a direction changes the factor of a damper, of its coordinate i where there are no
 * matrices.
 * fvi_tangent_order -- by what it changes the order of a power. */
static inline double fvi_tangent_factor(const fvi_tangent_run *o, const fvi_tangent_damper *a, size_t j, size_t i)
{
    const fvi_sensitivities *along = o->along + j;
    const int has_dampers = o->run->system->mechanism != NULL;
    double factor = along->damping ? along->damping[o->run->system->matrices ? a->number : i] : 0;
    if (has_dampers)
        factor *= a->of.rho;
    return factor + (has_dampers && !a->of.law && along->terms ? along->terms[a->first] : 0);
}

static inline double fvi_tangent_order(const fvi_tangent_run *o, const fvi_tangent_damper *a, size_t j)
{
    const fvi_sensitivities *along = o->along + j;
    const double *order = o->run->system->mechanism ? (along->orders ? along->orders + a->first : NULL) : along->alpha;
    return order && !a->of.law ? *order : 0;
}

#endif
