/* src/adjoint_mechanism/adjoint_mechanism.h -- The adjoint run of a system with a mechanism. [H 23, 29]
 *
 * Internal. A step of (29.5) to (29.8) is R(x_k, p_k, u, lambda) = 0 and p_{k+1} = P(...). The forces lambda of the
 * dampers are sums over all steps. The transposed equation of a step has the transposed matrix of Newton's method. The
 * transposed sums have the same weights, (23.2) and (17.6):
 *
 *     eta_k = sum_{n >= 0} w_n nu_{k+n},   nu_k the derivative of J by lambda_k through its own step    (23.29)
 *
 * So the run keeps, for each step, the point at which its equation was solved. The walk back solves one linear system
 * in each step. */
#ifndef FVI_ADJOINT_MECHANISM_H
#define FVI_ADJOINT_MECHANISM_H

#include <fvi/sensitivity.h>
#include <fvi/dampers.h>

#include "mechanism/mechanism_state.h"
#include "parameter_derivatives/stage_terms.h"

/* A power of the kernel of a damper. Each has a history force of its own: impulses for rho A = 1. */
typedef struct {
    size_t term;
    fvi_kernel_impulse power;
    double unit;
    double by_A, by_A_and_order; /* derivatives of J by A for rho = 1, and of that by e */
} fvi_adjoint_start_power;

/* One damper. For the methods without stages s is 1. */
typedef struct {
    size_t damper, first;       /* the place of its first term among the terms of all dampers */
    const fvi_kernel *kernel;
    double weight;              /* without stages: the first weight, taken out of the history */
    fvi_history *history;       /* without stages: the history of nu */
    fvi_lobatto_history *stages;
    double last, past[FVI_STAGES]; /* the last nu; with stages the sums over later steps */
    double nu[FVI_STAGES], eta[FVI_STAGES];
    double spring;              /* on a mesh, for a damper of order 0: its stiffness */
    /* The start. The amplitude A is the slope of z, or for the past rl z itself. */
    int needs_start_slope, needs_start_place;
    double A;
    fvi_adjoint_start_power *each;    /* for powers; owned */
    size_t powers;
    fvi_impulses_of_kernel *impulses; /* for any other kernel, for A = 1 */
    double by_A, by_drift, by_origin; /* derivatives of J by A through `impulses`, by the drift t A of z, and by z_0 */
    double factor;              /* the derivative by a factor of the kernel */
    /* for the numbers of its kernel */
    fvi_node_term *term;        /* without stages, one for each term; owned */
    fvi_stage_terms of_stages;  /* with stages */
} fvi_adjoint_mechanism_damper;

typedef struct {
    const fvi_run *run;
    const fvi_sensitivities *want;
    const fvi_objective *J;
    fvi_stepper *stepper;       /* the stepper of the run; its state is put back to each step */
    fvi_mechanism_state *o;
    size_t d, r, s, n, row;     /* row: how many numbers a record has */
    const double *unknown;      /* u of the current step */
    double *record;             /* x_k, u, known, start_impulse, v_k, w_k of each step; owned */
    double *last;               /* x_N, p_N, v_N, and the impulse w of the constraints there */
    double *G0, *z0, *v0;       /* at the start: gradients of the elongations, elongations, velocities; r d, r, d, and
                                   m zeros behind v0 */
    double *g, *beta, *next;    /* d each: dJ/dx_{k+1} through all later steps; the multiplier of p_{k+1}; the same as g
                                   for x_k */
    double *multiplier;         /* n: the multipliers of the equations of the step */
    double *phi, *kappa, *tau;  /* s d each: the derivatives of J by the force f_i, by V_i and by L_v,i */
    double *matrix, *room;
    double *projection, *gradient, *factors; /* for c constraints: (d + c)^2, c d, c */
    double *column;             /* 2 (d + 2) + c (d + 2): the derivatives of an elongation or of the constraints by a
                                   name */
    double *block;              /* the memory of all these arrays; owned */
    size_t *order;
    fvi_adjoint_mechanism_damper *damper; /* r; owned */
    const double *source;       /* s d: further derivatives of J by V_i; NULL: none */
    struct fvi_adjoint_mesh *mesh; /* for steps of any length; NULL otherwise */
} fvi_adjoint_mechanism;

/* fvi_adjoint_mechanism_check -- refuse what has no adjoint. Returns FVI_SUCCESS, FVI_EINVAL or FVI_EUNSUP.
 * fvi_adjoint_mechanism_run -- fvi_adjoint for a checked run; the outputs are zeros before. */
int fvi_adjoint_mechanism_check(const fvi_method *method, const fvi_run *run,
                                const fvi_sensitivities *want);
int fvi_adjoint_mechanism_run(const fvi_method *method, const fvi_run *run,
                              const fvi_objective *J, const fvi_sensitivities *want);

/* fvi_adjoint_mechanism_allocate -- allocate everything but the records; the stepper has been started.
 * fvi_adjoint_mechanism_add_velocity -- carry the derivative by v_0, by_v, d numbers, over to p_0 (beta), x_0 (g) and
 * the numbers that L depends on. At the start the multipliers of the constraints are 0.
 * fvi_adjoint_mechanism_stop -- free everything. */
int fvi_adjoint_mechanism_allocate(fvi_adjoint_mechanism *m);
int fvi_adjoint_mechanism_add_velocity(fvi_adjoint_mechanism *m, const double *by_v);
void fvi_adjoint_mechanism_stop(fvi_adjoint_mechanism *m);

/* ---- adjoint_mechanism_mesh.c: steps of any length ---- */

/* fvi_adjoint_mesh_run -- as fvi_adjoint_mechanism_run, for fvi_variable_step.
 * fvi_adjoint_mesh_check -- FVI_EUNSUP for what has no adjoint on a mesh only.
 * fvi_adjoint_mesh_push -- push the nu of a step into the histories, and add the part of springs to g. */
int fvi_adjoint_mesh_run(const fvi_run *run, const fvi_objective *J, const fvi_sensitivities *want);
int fvi_adjoint_mesh_check(const fvi_run *run, const fvi_objective *J, const fvi_sensitivities *want);
int fvi_adjoint_mesh_push(fvi_adjoint_mechanism *m);

/* ---- adjoint_mechanism_dampers.c ---- */

/* fvi_adjoint_mechanism_damper_start -- start the histories of damper j of a run at k = 0.
 *
 *   _impulses  take in the impulses of the past in step k; by[i] is the derivative of J by impulse i
 *   _push      push nu of a step, which gives eta. Add the derivatives by the numbers of the kernel. zeta: the
 *              elongation less z_0 and the drift; with stages zdot less the drift, s numbers
 *   _ahead     without stages: eta of this step without the term weight nu
 *   _end       add the derivatives through its start to by_x0 and by_v, d numbers each, and write all derivatives by
 *              its kernel
 *   _bar       write NaN to by_x0 for a place that would stretch the damper where no motion starts so, (19.2) */
int fvi_adjoint_mechanism_damper_start(fvi_adjoint_mechanism *m, size_t j);
void fvi_adjoint_mechanism_damper_impulses(const fvi_adjoint_mechanism *m, size_t k,
                                           fvi_adjoint_mechanism_damper *a, const double *by);
int fvi_adjoint_mechanism_damper_ahead(const fvi_adjoint_mechanism_damper *a, double *eta);
int fvi_adjoint_mechanism_damper_push(fvi_adjoint_mechanism *m, fvi_adjoint_mechanism_damper *a,
                                      const double *zeta);
int fvi_adjoint_mechanism_damper_end(fvi_adjoint_mechanism *m, fvi_adjoint_mechanism_damper *a,
                                     double *by_x0, double *by_v);
int fvi_adjoint_mechanism_damper_bar(fvi_adjoint_mechanism *m,
                                     const fvi_adjoint_mechanism_damper *a, double *by_x0);
void fvi_adjoint_mechanism_damper_stop(fvi_adjoint_mechanism_damper *a);

/* ---- adjoint_mechanism_nodes.c, adjoint_mechanism_stages.c ---- */

/* Go from node k + 1 to node k: compute g and beta. The stepper stands at step k, and its equation is linearised. */
int fvi_adjoint_mechanism_nodes(fvi_adjoint_mechanism *m, size_t k);
int fvi_adjoint_mechanism_stages(fvi_adjoint_mechanism *m, size_t k);

/* ---- adjoint_mechanism_names.c: derivatives by want->names through a step, a node, the start of a damper ---- */

/* fvi_adjoint_mechanism_names_nodes, _stages -- through step k, or the step of the stepper. Its multipliers and those
 * of its dampers are known, and beta still belongs to p_{k+1}.
 *
 *   _node   through p at node k. beta is the multiplier of the p that comes out, and delta that of C v + c_t
 *   _start  through g at x_0, and through the slope that damper j begins with
 *   _check  NaN for a name that would move x_0 or p_0
 *   _bar    NaN for a name that would stretch damper e at x_0, where it must not be stretched */
int fvi_adjoint_mechanism_names_bar(fvi_adjoint_mechanism *m, size_t e);
int fvi_adjoint_mechanism_names_nodes(fvi_adjoint_mechanism *m, size_t k, double ahead);
int fvi_adjoint_mechanism_names_stages(fvi_adjoint_mechanism *m);
int fvi_adjoint_mechanism_names_node(fvi_adjoint_mechanism *m, double t, const double *x,
                                     const double *v, const double *w, const double *delta);
int fvi_adjoint_mechanism_names_start(fvi_adjoint_mechanism *m, size_t j, double by_place,
                                      double by_slope);
int fvi_adjoint_mechanism_names_check(fvi_adjoint_mechanism *m);

/* fvi_adjoint_mechanism_share -- the factor of grad g of damper e at an end of a step without stages. */
double fvi_adjoint_mechanism_share(const fvi_adjoint_mechanism *m, size_t e, size_t end);

/* fvi_adjoint_mechanism_project -- go back through the projection of p at a node.
 *
 *   beta  (of m) in: the derivative by the p that comes out; out: by the p that goes in; m->g is changed, too
 *   v, w  the velocity there, and the impulse of the constraints
 *   by_v  the derivative of J by v itself, or NULL */
int fvi_adjoint_mechanism_project(fvi_adjoint_mechanism *m, double t, const double *x,
                                  const double *v, const double *w, const double *by_v);

/* fvi_adjoint_mechanism_point -- add the derivatives by masses and by the parameters of the potential or the Lagrangian
 * through point number i of a step, at the time t. tau is the derivative of J by L_v there, and phi by the force f. */
int fvi_adjoint_mechanism_point(fvi_adjoint_mechanism *m, size_t i, double t, const double *tau,
                                const double *phi);

#endif
