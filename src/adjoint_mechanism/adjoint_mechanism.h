/* src/adjoint_mechanism/adjoint_mechanism.h -- A run with a mechanism, backwards.       [H 23, 29]
 *
 * Internal. A step of (29.5) to (29.8) is R(x_k, p_k, u, lambda) = 0 and p_{k+1} = P(...), where the
 * forces lambda of the dampers are sums over all steps. Its transposed equation has the transposed
 * matrix of Newton's method, and its sums are those of the same weights, (23.2) and (17.6):
 *
 *     eta_k = sum_{n >= 0} w_n nu_{k+n},   nu_k = what lambda_k does to the step           (23.29)
 *
 * So the run keeps of each step what its equation was solved at, and the walk back solves one linear
 * system a step. */
#ifndef FVI_ADJOINT_MECHANISM_H
#define FVI_ADJOINT_MECHANISM_H

#include <fvi/sensitivity.h>
#include <fvi/dampers.h>

#include "mechanism/mechanism_state.h"
#include "parameter_derivatives/stage_terms.h"

/* One of several powers of a damper of the past rl, which has a history force of its own: impulses for rho A = 1. */
typedef struct {
    size_t term;
    fvi_kernel_impulse power;
    double unit;
    double by_A, by_A_and_order; /* derivatives of J by A for rho = 1, and by e of that */
} fvi_adjoint_start_power;

/* Of one damper. Of nodes s is 1. */
typedef struct {
    size_t damper, first;       /* the place of its terms among all */
    const fvi_kernel *kernel;
    double weight;              /* of nodes: the first, taken out of the history */
    fvi_history *history;       /* of nu, of nodes; */
    fvi_lobatto_history *stages;
    double last, past[FVI_STAGES]; /* the last nu; of stages the sums over later steps */
    double nu[FVI_STAGES], eta[FVI_STAGES];
    double spring;              /* on a mesh, of a spring: its stiffness */
    /* its start: A is the slope of z, or z itself of the past rl */
    int needs_start_slope, needs_start_place;
    double A, unit;             /* of the impulses for rho A = 1, or A = 1 */
    fvi_kernel_impulse power;   /* of a power; */
    fvi_impulses_of_kernel *impulses; /* else */
    fvi_adjoint_start_power *each;    /* of several powers; owned */
    size_t powers;
    double impulse[FVI_KERNEL_IMPULSE_NODES], slope[FVI_KERNEL_IMPULSE_NODES];
    double by_A, by_A_and_order, by_drift, by_origin; /* derivatives of J by these */
    double factor;              /* by a factor of the kernel */
    /* the numbers of its kernel */
    fvi_node_term *term;        /* of nodes, one for each term; owned */
    fvi_stage_terms of_stages;  /* of stages */
} fvi_adjoint_mechanism_damper;

typedef struct {
    const fvi_run *run;
    const fvi_sensitivities *want;
    const fvi_objective *J;
    fvi_stepper *stepper;       /* of the run; its state is put back to each step */
    fvi_mechanism_state *o;
    size_t d, r, s, n, row;     /* numbers of a record */
    const double *unknown;      /* u of the step at hand */
    double *record;             /* x_k, u, known, start_impulse, v_k, w_k of each step; owned */
    double *last;               /* x_N, p_N, v_N, and w of the constraints there */
    double *G0, *z0, *v0;       /* of the start: r d, r, d */
    double *g, *beta, *next;    /* dJ/dx_{k+1} of all later; multiplier of p_{k+1}; the same of k */
    double *multiplier;         /* n: of the equations */
    double *phi, *kappa, *tau;  /* s d each: what f_i, V_i and L_v,i do */
    double *matrix, *room;
    double *projection, *gradient, *factors; /* of c constraints: (d + c)^2, c d, c */
    double *column;             /* 2 (d + 2) + c (d + 2): by a name */
    double *block;              /* all these; owned */
    size_t *order;
    fvi_adjoint_mechanism_damper *damper; /* r; owned */
    const double *source;       /* s d: what V_i does to J besides; NULL: nothing */
    struct fvi_adjoint_mesh *mesh; /* of steps of any length; NULL else */
} fvi_adjoint_mechanism;

/* fvi_adjoint_mechanism_check -- FVI_EUNSUP for what has no adjoint.
 * fvi_adjoint_mechanism_run -- fvi_adjoint of a checked run; the outputs are zeros before. */
int fvi_adjoint_mechanism_check(const fvi_method *method, const fvi_run *run,
                                const fvi_sensitivities *want);
int fvi_adjoint_mechanism_run(const fvi_method *method, const fvi_run *run,
                              const fvi_objective *J, const fvi_sensitivities *want);

/* fvi_adjoint_mechanism_allocate -- all but the record; the stepper has been started.
 * fvi_adjoint_mechanism_add_velocity -- what v_0 does, by_v, d numbers, goes to p_0, x_0 and what L depends on.
 * fvi_adjoint_mechanism_stop -- give everything back. */
int fvi_adjoint_mechanism_allocate(fvi_adjoint_mechanism *m);
int fvi_adjoint_mechanism_add_velocity(fvi_adjoint_mechanism *m, double *by_v, double *by_x0,
                                       double *by_p0);
void fvi_adjoint_mechanism_stop(fvi_adjoint_mechanism *m);

/* ---- adjoint_mechanism_mesh.c: steps of any length ---- */

/* fvi_adjoint_mesh_run -- as fvi_adjoint_mechanism_run, of fvi_variable_step.
 * fvi_adjoint_mesh_check -- FVI_EUNSUP for what has no adjoint there alone.
 * fvi_adjoint_mesh_push -- the nu of a step go into the memories, and what springs do into g. */
int fvi_adjoint_mesh_run(const fvi_run *run, const fvi_objective *J, const fvi_sensitivities *want);
int fvi_adjoint_mesh_check(const fvi_run *run, const fvi_objective *J, const fvi_sensitivities *want);
int fvi_adjoint_mesh_push(fvi_adjoint_mechanism *m);

/* ---- adjoint_mechanism_dampers.c ---- */

/* fvi_adjoint_mechanism_damper_start -- the memories of damper j of a run at k = 0.
 * _impulses  those of step k, and their derivatives by the order of a power
 * _powers    those of several powers in step k, impulse i of which by[i] multiplies
 * _push      nu of a step goes in: eta, and at nodes what the numbers of its kernel have of it, which
 *            meets zeta; with_stages: zdot less the drift, s numbers, in zeta
 * _ahead     of nodes: eta of this step but for weight nu
 * _end       by its start, into by_x0 and by_v, d numbers each, and all derivatives by its kernel
 * _bar       NaN into by_x0 where another place would stretch it and leave no motion, (19.2) */
int fvi_adjoint_mechanism_damper_start(fvi_adjoint_mechanism *m, size_t j);
void fvi_adjoint_mechanism_damper_powers(const fvi_adjoint_mechanism *m, size_t k,
                                         fvi_adjoint_mechanism_damper *a, const double *by);
void fvi_adjoint_mechanism_damper_impulses(const fvi_adjoint_mechanism *m, size_t k,
                                           fvi_adjoint_mechanism_damper *a);
int fvi_adjoint_mechanism_damper_ahead(const fvi_adjoint_mechanism_damper *a, double *eta);
int fvi_adjoint_mechanism_damper_push(fvi_adjoint_mechanism *m, fvi_adjoint_mechanism_damper *a,
                                      const double *zeta);
int fvi_adjoint_mechanism_damper_end(fvi_adjoint_mechanism *m, fvi_adjoint_mechanism_damper *a,
                                     double *by_x0, double *by_v);
int fvi_adjoint_mechanism_damper_bar(fvi_adjoint_mechanism *m,
                                     const fvi_adjoint_mechanism_damper *a, double *by_x0);
void fvi_adjoint_mechanism_damper_stop(fvi_adjoint_mechanism_damper *a);

/* ---- adjoint_mechanism_nodes.c, adjoint_mechanism_stages.c ---- */

/* From node k + 1 to node k: g, beta; the stepper stands at step k, whose equation is linearised. */
int fvi_adjoint_mechanism_nodes(fvi_adjoint_mechanism *m, size_t k);
int fvi_adjoint_mechanism_stages(fvi_adjoint_mechanism *m, size_t k);

/* ---- adjoint_mechanism_names.c: what want->names have of a step, of a node, and of the start of damper j ---- */

/* fvi_adjoint_mechanism_names_nodes, _stages -- of step k, or of that of the stepper, once its multipliers and those of its dampers are
 * known, and before beta becomes that of p_k.
 * _node   of p at node k, where beta multiplies what comes out, and delta what C v + c_t is
 * _start  of g at x_0 and of the slope that damper j begins with
 * _check  NaN for those that would move x_0 or p_0
 * _bar    NaN for those that would stretch damper e at x_0, where it must not be */
int fvi_adjoint_mechanism_names_bar(fvi_adjoint_mechanism *m, size_t e);
int fvi_adjoint_mechanism_names_nodes(fvi_adjoint_mechanism *m, size_t k, double ahead);
int fvi_adjoint_mechanism_names_stages(fvi_adjoint_mechanism *m);
int fvi_adjoint_mechanism_names_node(fvi_adjoint_mechanism *m, double t, const double *x,
                                     const double *v, const double *w, const double *delta);
int fvi_adjoint_mechanism_names_start(fvi_adjoint_mechanism *m, size_t j, double by_place,
                                      double by_slope);
int fvi_adjoint_mechanism_names_check(fvi_adjoint_mechanism *m);

/* fvi_adjoint_mechanism_share -- what multiplies grad g of damper e at an end of a step of nodes. */
double fvi_adjoint_mechanism_share(const fvi_adjoint_mechanism *m, size_t e, size_t end);

/* fvi_adjoint_mechanism_project -- what the constraints do to p at a node: beta in, of what comes out,
 * and out, of what comes in; g. v is the velocity there, and w their impulse. by_v: what v itself does to J, or
 * NULL. */
int fvi_adjoint_mechanism_project(fvi_adjoint_mechanism *m, double t, const double *x,
                                  const double *v, const double *w, const double *by_v);

/* fvi_adjoint_mechanism_point -- what masses and the parameters of the potential or the Lagrangian have
 * of the point number i of a step at the time t: tau multiplies L_v there, and phi the force f. */
int fvi_adjoint_mechanism_point(fvi_adjoint_mechanism *m, size_t i, double t, const double *tau,
                                const double *phi);

#endif
