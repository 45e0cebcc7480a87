/* src/tangent/tangent.h -- A run and its derivatives along directions, step by step. [H 24]
 *
 * Internal. The derivative of a run along a direction is a run of the linearised system by the same method. The
 * direction also changes the equations of each step themselves; these changes are the forces of the linearised run
 * (linearised.h).
 *
 * There are P directions. Arrays of P d numbers have coordinate i along direction j at [j * d + i]. Stages count from 0
 * here; a method without stages has one stage. */
#ifndef FVI_TANGENT_H
#define FVI_TANGENT_H

#include "parameter_derivatives/constant_history.h"
#include "parameter_derivatives/stage_terms.h"
#include "methods/initial_history_force.h"
#include "newton/linearised.h"

/* What the directions change in one damper, whose history keeps r numbers z. */
typedef struct {
    fvi_run_damper of;
    size_t number, first, r;   /* the place of the damper, and of its first term among the terms of all dampers */
    double unit, theta;        /* the factor of the sums for rho = 1; the shift of (23.7) */
    int has_line, is_liouville; /* nonzero: the line x0 + t v0 is subtracted from x before the history gets it; x0 is
                                   not subtracted */
    int is_asked, by_order, by_terms; /* nonzero: directions change the damper; its order; numbers of its law */
    double *zeros, *z, *mean;  /* r each: zeros; z of the last node; the mean of z at the last two nodes */
    double *dz, *change;       /* r each: the increments of z and of the mean */
    double *now, *before;      /* P r each: impulses of the last node and of the node before, without the factor S */
    double *by_theta;          /* r: the change by the shift */
    double *v, *Y, *Ydot;      /* s r each, for stages: velocities without the line, and the sums of two histories over
                                  the past steps */
    double *sum, *sumdot;      /* s r each: the same sums including this step, times unit; zeros if no direction needs
                                  them */
    double *block;             /* the memory of all these arrays; owned */
    fvi_constant_history memory; /* the history of z, at nodes */
    fvi_node_term *term;      /* the terms of a law, at nodes, `terms` of them; owned */
    size_t terms;
    fvi_lobatto_history *of_stages; /* the history of v */
    fvi_stage_terms terms_of_stages;
    fvi_initial_history_force past; /* the impulses of the past for an amplitude of 1 */
    double impulse_unit;            /* the factor of these impulses; 0: the past exerts no force */
    double *CA;                     /* d: the amplitude A, or C A with a matrix; in block */
} fvi_tangent_damper;

typedef struct {
    fvi_run run_copy;         /* the run as its steps see it (fvi_run_normal) */
    const fvi_run *run;       /* points to run_copy */
    const fvi_method *method;
    const fvi_sensitivities *along; /* the directions */
    size_t P, d, s, size;     /* s: how many stages; size: how many numbers a Hessian has */
    double kappa;
    fvi_stepper *stepper;     /* the stepper of the run itself */
    double *x_k, *v0;         /* d each: x at the beginning of the step; p0/m */
    double *dx, *pi;          /* P d each: d x_k, d p_k; pi stands directly behind dx */
    /* The linearised runs. With one coordinate there is one run of P coordinates; else P runs of d coordinates. */
    size_t tangents, width;   /* how many runs; how many coordinates each has */
    fvi_linearised *linearised;
    fvi_system *system;
    fvi_stepper **tangent;
    double *mass, *damping;   /* P each: those of the one coordinate, repeated */
    double *G;                /* s Hessians */
    double *dU;               /* s P d: the changes of grad U at the stages by the parameters, stage by stage */
    double *source;           /* s P d: the forces of the linearised runs (linearised.h), run by run */
    double *left, *right;     /* P d each: what a step without stages subtracts from dp before and after its equation is
                                 solved; with stages left is v at the beginning of the step, and right is room */
    double *room;             /* d numbers, or a Hessian */
    double *block;            /* the memory of all these arrays; owned */
    fvi_tangent_damper *each; /* owned */
    size_t dampers;
    /* for methods with stages */
    const fvi_lobatto_rule *rule;
    double A[FVI_STAGES][FVI_STAGES];
    double *V, *X;            /* s d each: velocities and positions of the stages; without stages V is room */
} fvi_tangent_run;

/* fvi_tangent_start -- start a run and its derivatives at k = 0. run and along stay the caller's.
 *
 *   method  with or without stages
 *   along   P directions
 *   enough  the error that the histories of stages may have in their sums; 0: the error of the histories of the run
 *   o       output; give it back with fvi_tangent_stop, also after an error
 *
 * Returns the codes of fvi_directional_derivatives (adjoint.h). */
int fvi_tangent_start(const fvi_method *method, const fvi_run *run, size_t P,
                      const fvi_sensitivities *along, double enough, fvi_tangent_run *o);

/* fvi_tangent_step -- take a step of the run and of its derivatives. */
int fvi_tangent_step(fvi_tangent_run *o);

void fvi_tangent_stop(fvi_tangent_run *o);

/* fvi_tangent_nodes_step, fvi_tangent_stages_step -- the same for methods without and with stages. */
int fvi_tangent_nodes_step(fvi_tangent_run *o);
int fvi_tangent_stages_step(fvi_tangent_run *o);

/* fvi_tangent_velocity -- p/m at the current node, before the impulses of the force there. Not with matrices. */
void fvi_tangent_velocity(const fvi_tangent_run *o, double *v);

/* fvi_tangent_evaluate_potential -- write Hess U at X to stage i of G, and the changes of grad U at X by the parameters
 * to dU. Returns what a callback returns. */
int fvi_tangent_evaluate_potential(fvi_tangent_run *o, size_t i, const double *X);

/* One damper of the run. A damper that no direction changes costs nothing.
 *
 * fvi_tangent_damper_start -- start it; `of`, `number` and `first` are set before. keep: the tolerance of the histories
 * of stages.
 * fvi_tangent_damper_next -- take node k into the histories, and write the changes of its impulses to a->now.
 * fvi_tangent_damper_impulses -- add these changes, and the changes of the impulses of the past, to left and right of a
 * step from node k.
 *
 * The methods with stages also use these functions of tangent_dampers.c:
 * fvi_tangent_numbers -- by how much direction j changes rho, alpha, time and end of term l.
 * fvi_tangent_rho -- rho of coordinate i, or with matrices rho of the damper.
 * fvi_tangent_multiply -- to += share S y; without matrices S = 1.
 * fvi_tangent_past -- the impulses of the past in step k, and their derivatives by the exponent e if a direction
 * changes an order.
 * fvi_tangent_past_along -- by how much direction j changes n impulses of the past of coordinate i, for an amplitude
 * A = 1. The terms of a law have impulses at the two ends of a step only. */
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

/* fvi_tangent_factor -- by how much direction j changes the factor of a damper; without matrices, of coordinate i.
 * fvi_tangent_order -- by how much direction j changes the order alpha of a power; 0 for a law. */
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
