/* src/tangent/tangent.h -- A run and its derivatives, side by side.            [H 24]
 *
 * Internal. The derivative of a run along a direction is a run of the linearised system by the same method. The
 * forces of this run (linearised.h) are what the direction changes in the equations of each step. Arrays of
 * P d numbers: coordinate i along direction j at [j * d + i]. Stages count from 0 here; methods without
 * stages have one. */
#ifndef FVI_TANGENT_H
#define FVI_TANGENT_H

#include "parameter_derivatives/constant_history.h"
#include "parameter_derivatives/stage_terms.h"
#include "methods/initial_history_force.h"
#include "newton/linearised.h"

/* What the directions change in one damper, whose history has r numbers. */
typedef struct {
    fvi_run_damper of;
    size_t number, first, r;   /* the place of the damper, and of its first term among those of all dampers */
    double unit, theta;        /* what stands before the sums for rho = 1; the shift of (23.7) */
    int has_line, is_liouville; /* is the line x0 + t v0 subtracted in the history? is x0 not? */
    int is_asked, by_order, by_terms; /* do directions change it, through its order, through numbers of a law? */
    double *zeros, *z, *mean;  /* r each: zeros; z of the last node, and the mean of the last two */
    double *dz, *change;       /* r each: their increments */
    double *now, *before;      /* P r each: impulses of the last node and of the node before, before S */
    double *by_theta;          /* r: what the shift changes */
    double *v, *Y, *Ydot;      /* s r each, of stages: velocities less the line, and what two histories have of the past */
    double *sum, *sumdot;      /* s r each: the same with this step, times unit; zeros where nobody asks */
    double *block;             /* all these; owned */
    fvi_constant_history memory; /* of z, at nodes */
    fvi_node_term *term;      /* of a law, at nodes, `terms` of them; owned */
    size_t terms;
    fvi_lobatto_history *of_stages; /* of v */
    fvi_stage_terms terms_of_stages;
    fvi_initial_history_force past; /* its impulses for an amplitude of 1 */
    double impulse_unit;            /* 0: no past acts */
    double *CA;                     /* d: the amplitude A, or C A of a matrix; in block */
} fvi_tangent_damper;

typedef struct {
    fvi_run own;              /* the run as its steps see it */
    const fvi_run *run;       /* &own */
    const fvi_method *method;
    const fvi_sensitivities *along; /* the directions */
    size_t P, d, s, size;     /* s: stages; size: numbers of a Hessian */
    double kappa;
    fvi_stepper *stepper;     /* of the run */
    double *x_k, *v0;         /* d each: x at the beginning of the step; p0/m */
    double *dx, *pi;          /* P d each: d x_k, d p_k; pi stands behind dx */
    /* the linearised runs: of one coordinate one run of P coordinates; else P runs of d coordinates */
    size_t tangents, width;   /* how many; coordinates of each */
    fvi_linearised *linearised;
    fvi_system *system;
    fvi_stepper **tangent;
    double *mass, *damping;   /* P each: of one coordinate */
    double *G;                /* s Hessians */
    double *dU;               /* s P d: what the parameters change in grad U at the stages, stage by stage */
    double *source;           /* s P d: forces, as fvi_linearised takes them, run by run */
    double *left, *right;     /* P d each: what a step without stages loses before and behind its solution; with
                               * stages left is v at its beginning, and right is room */
    double *room;             /* d, or a Hessian */
    double *block;            /* all these arrays; owned */
    fvi_tangent_damper *each; /* owned */
    size_t dampers;
    /* of stages */
    const fvi_lobatto_rule *rule;
    double A[FVI_STAGES][FVI_STAGES];
    double *V, *X;            /* s d each: velocities, positions; without stages V is room */
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

/* One damper of the run; what no direction changes costs nothing.
 * fvi_tangent_damper_start -- `of`, `number` and `first` are there. keep: the tolerance of the histories of stages.
 * fvi_tangent_damper_next -- of node k: the impulses that the directions change, in now.
 * fvi_tangent_damper_impulses -- of a step from node k: these impulses and those of the past are added to left and
 * right.
 *
 * What methods with stages ask of tangent_dampers.c, too:
 * fvi_tangent_numbers -- by what direction j changes rho, alpha, time and end of term l.
 * fvi_tangent_rho -- rho of coordinate i, or with matrices that of the damper.
 * fvi_tangent_multiply -- to += share S y; without matrices S = 1.
 * fvi_tangent_past -- the impulses of the past in step k, and their slopes by e if an order is changed.
 * fvi_tangent_past_along -- by what direction j changes n impulses of the past of coordinate i, for an A of 1. Terms
 * of a law have impulses at the two ends of a step. */
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
    return o->source + (o->tangents == 1 && o->P > 1 ? i * o->P + j : (j * o->s + i) * o->d);
}

/* fvi_tangent_factor -- by what direction j changes the factor of a damper; without matrices that of coordinate i.
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
