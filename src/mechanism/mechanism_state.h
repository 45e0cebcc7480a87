/* src/mechanism/mechanism_state.h -- The state of a run with a mechanism.  [H 29]
 *
 * This header is internal. mechanism_start.c allocates the state; the steps change it.
 *
 * A tie is a constraint of the run or a closed contact. A mesh is a sequence of steps of variable length
 * (fvi-adaptive). */
#ifndef FVI_MECHANISM_STATE_H
#define FVI_MECHANISM_STATE_H

#include "mechanism.h"
#include <fvi/events.h>
#include "kernel/kernel_impulses.h"
#include "run/step_force.h"
#include "stages/lobatto_history.h"

/* The history of a damper. */
typedef struct {
    size_t damper;
    fvi_kernel kernel;
    double drift;         /* t drift is subtracted from z - z_0 */
    double first;         /* weight of the present term, for order 1 and nodes */
    fvi_history *history;
    fvi_lobatto_history *stages;
    double *last;         /* the last term; with stages, the sums over the past, s numbers */
} fvi_mechanism_part;

/* A known force of a damper that follows from its start: the force of one term of its kernel, or of the whole
 * kernel. */
typedef struct {
    size_t damper;
    double size; /* rho A h^(1 + e) of (19.3); or A if of_kernel is used */
    fvi_kernel_impulse impulse;
    fvi_impulses_of_kernel *of_kernel; /* used instead of `impulse` unless NULL; owned */
} fvi_mechanism_start_force;

/* The state has d coordinates, r dampers and m ties. Stage i of coordinate j is at [i * d + j]. q is the number of
 * points at which a step evaluates the Lagrangian: s with stages, else 1. The first `permanent` ties are the
 * constraints of the run. The other ties are closed contacts; at most `most` - `permanent` contacts can be closed. */
typedef struct fvi_mechanism_state {
    fvi_method method; /* a copy of the method with these steps; not used on a mesh */
    fvi_mechanism_form form;
    int is_on_mesh;               /* nonzero on a mesh; then t is the beginning of the step that is tried */
    double h, t;                  /* length of a step; its beginning on a mesh */
    double rest_scale;            /* largest distance that the bodies have moved, while a contact is closed; else 0 */
    size_t s, q, d, r, m, n;      /* n: number of unknowns */
    size_t permanent, most, *contact; /* contact: index of the event of each closed contact */
    size_t last_m, *last_contact; /* m and the contacts of the last step, for times within it */
    const fvi_lobatto_rule *rule;
    double E[FVI_STAGES][FVI_STAGES], T[FVI_STAGES][FVI_STAGES],
        next[FVI_STAGES][FVI_STAGES]; /* tables of (29.7) */
    size_t begin;          /* the first unknown stage: 1 in form M, else 0 */
    int has_root;          /* nonzero after the equation is solved: no second derivatives are needed */
    size_t parts, start_forces;
    fvi_mechanism_part *part;
    fvi_mechanism_start_force *start_force;
    char *is_massless; /* for each coordinate: nonzero if it has neither inertia nor a constraint */
    int any_massless;  /* nonzero if a coordinate of the node scheme is massless */

    double *numbers; /* one block with all arrays below */
    size_t saved;    /* number of doubles at its beginning that one step passes to the next */
    double *impulse, *work, *begun, *ended, *tie; /* r, r, m, m, m numbers */
    /* m numbers: for a contact the value of Z at which it has closed, 0 or smaller than the error of a step */
    double *level;
    double *v, *u, *z, *G, *C, *z0; /* d, n, r, r d, m d numbers at the node, and r numbers */
    double *raw; /* 4 d numbers: x_k, x_{k-1}, x_{k-2}, x_{k-3} of the node scheme, for (29.17) and (29.25) */

    double *W; /* r matrices s x s (1 x 1 for nodes): the weight of the present in the force of a damper */
    double *known, *lambda, *zdot; /* r arrays of s numbers each */
    double *start_impulse; /* 2 r numbers, for nodes: the impulses of the start forces at both ends of a step */
    double *X, *V, *f, *Lv, *fx, *fv, *Lxv, *Lvv; /* the quantities at the q points */
    double *load, *elongation, *gradient; /* force F(t), (q + 1) d numbers; q r and q r d numbers */
    double *residual, *matrix, *change, *trial; /* n, n n, n, n numbers */
    double *room; /* workspace of the functions, 4 (d + m + 1)^2 numbers with m = most */
    size_t *order;
} fvi_mechanism_state;

/* fvi_mechanism_of -- Return the state of a stepper that takes these steps, else NULL. */
const fvi_mechanism_state *fvi_mechanism_of(const fvi_stepper *s);

/* fvi_mechanism_work_of_impulse -- Add the work of an impulse J at x to *work; p is the momentum after the impulse. For
 * masses the work is J times the mean of the velocities before and after. For a Lagrangian it is the gain of energy.
 * Return FVI_SUCCESS; FVI_ENOMEM; or the code of the Lagrangian. */
int fvi_mechanism_work_of_impulse(const fvi_stepper *s, double t, const double *x, const double *p,
                                  const double *J, double *work);

/* fvi_mechanism_copy, fvi_mechanism_serialize -- The members copy and serialize of a method. A copy allocates
 * s->mechanism. The functions leave out the data of a mesh, which belong to src/variable_step.
 * fvi_mechanism_free -- Free the state. NULL is allowed. */
int fvi_mechanism_copy(const fvi_stepper *from, fvi_stepper *to);
int fvi_mechanism_serialize(fvi_stepper *s, fvi_archive *v);
void fvi_mechanism_free(fvi_mechanism_state *o);

/* ---- mechanism_point.c ---- */

/* fvi_mechanism_point -- Evaluate the derivatives of L and the forces of velocity at point i, (X_i, V_i): f, fx, fv,
 * Lv, Lxv, Lvv. with_forces = 0 leaves out the forces of velocity. Return FVI_SUCCESS, or the code of the Lagrangian or
 * of the force. */
int fvi_mechanism_point(fvi_stepper *s, size_t i, double t, int with_forces);

/* fvi_mechanism_elongations -- Compute z, r numbers, and G, r d numbers, of all dampers at x. Return FVI_SUCCESS, or
 * the code of an elongation. */
int fvi_mechanism_elongations(const fvi_stepper *s, double t, const double *x,
                              double *z, double *G);

/* fvi_elongation_rate_is_fixed -- Find out whether the rate of an elongation at t = 0 is the same at x0 and beside it.
 * If not, the rate has derivatives by x0, which no callback gives. room has d numbers. Return FVI_SUCCESS, or the code
 * of the elongation. */
int fvi_elongation_rate_is_fixed(const fvi_elongation *of, size_t d, const double *x0, double *room, int *is_fixed);

/* fvi_mechanism_force -- Write the force F(t) to F, d numbers; zeros if there is none. Return FVI_SUCCESS, or the code
 * of the force. */
int fvi_mechanism_force(fvi_stepper *s, double t, double *F);

/* fvi_mechanism_finite_forces, fvi_mechanism_finite_elongations -- Check that the d forces of velocity F, or the r
 * elongations z, are finite, as fvi_check_finite does. */
int fvi_mechanism_finite_forces(const fvi_stepper *s, double t, const double *F);
int fvi_mechanism_finite_elongations(const fvi_stepper *s, double t, const double *z);

/* fvi_mechanism_explain -- Find out whether a step failed because a function of the system is not finite at a time of
 * the step: at the place and with the velocity at which the step began, the Lagrangian, the forces of velocity, the
 * elongations and the constraints must be finite. status is the code of the step. Return FVI_EBADFUNC with a
 * description in s->error, or else status. */
int fvi_mechanism_explain(fvi_stepper *s, int status);

/* ---- mechanism_memory.c ---- */

/* fvi_mechanism_begin_histories -- Allocate the histories and the start forces of all dampers. v is the velocity at the
 * start. Return FVI_SUCCESS; FVI_ENOMEM; or the code of a history or of the past rl. */
int fvi_mechanism_begin_histories(fvi_stepper *s, const double *v,
                                  fvi_error *error);

/* fvi_mechanism_is_stretched -- Return nonzero if the elongation of damper j at the start is more than a rounding
 * error (run/solution.h).
 * fvi_mechanism_check_stretch -- Check whether damper j, counted from 0, can have been stretched suddenly at t = 0,
 * which the past rl means. Return FVI_SUCCESS; FVI_EDOM for a power of an order above 1; FVI_EUNSUP for another
 * kernel. */
int fvi_mechanism_is_stretched(const fvi_stepper *s, size_t j);
int fvi_mechanism_check_stretch(const fvi_kernel *kernel, size_t j, fvi_error *error);

/* fvi_mechanism_predict_forces -- Compute `known` and `start_impulse` of this step. Then the force of a damper is
 * lambda = known + W z for nodes, and lambda = known + W zdot for stages. */
int fvi_mechanism_predict_forces(fvi_stepper *s);

/* fvi_mechanism_update_histories -- Add a step to the histories of the dampers. For nodes z is the elongation at the
 * time t minus z_0, r numbers; for stages z is zdot, r s numbers. For nodes and order 1 lambda is an output. */
int fvi_mechanism_update_histories(fvi_stepper *s, double t, const double *z);

/* fvi_mechanism_slope -- Write the time derivative of z_j at the start to *zdot, for the velocity v. Return
 * FVI_SUCCESS, or the code of `rate` of damper j. */
int fvi_mechanism_slope(const fvi_stepper *s, size_t j, const double *v, double *zdot);

/* fvi_mechanism_needs_start_slope -- Return nonzero if the force of a damper begins with a term for which weights alone
 * lose order. The scheme of order 1 uses weights alone, as in the paper, except for Caputo's past, which has no such
 * term. With stages an order of 2 is a mass and has no such term. */
int fvi_mechanism_needs_start_slope(const fvi_mechanism_state *o, const fvi_damper *damper);

/* fvi_mechanism_tolerance -- Return the tolerance of the histories with stages: a tenth of the tolerance of the run,
 * and 1e-14, the smallest one, if the run has none. */
double fvi_mechanism_tolerance(const fvi_run *run);

int fvi_mechanism_copy_parts(const fvi_mechanism_state *from,
                             fvi_mechanism_state *to);
int fvi_mechanism_serialize_parts(fvi_stepper *s, fvi_archive *archive);
void fvi_mechanism_free_parts(fvi_mechanism_state *o);

/* ---- mechanism_newton.c ---- */

/* fvi_mechanism_solve -- Solve residual(u) = 0 for the n unknowns u.
 *
 *   assemble  writes the residual and its Jacobian `matrix` at u
 *   places    the first `places` unknowns are increments of coordinates
 *   u         input: the initial guess; output: the solution
 *
 * If Newton's method fails from the guess, it starts again from u = 0, where nothing moves, with shortened steps that
 * reduce the residual; not on a mesh. Return FVI_SUCCESS, FVI_EMAXITER, FVI_ESING, or the code of assemble. */
int fvi_mechanism_solve(fvi_stepper *s,
                        int (*assemble)(fvi_stepper *s, const double *u),
                        size_t places, double *u);

/* ---- mechanism_constraints.c ---- */

/* fvi_mechanism_project_momentum -- Make p and v satisfy the hidden constraint C v + c_t = 0. [(29.4)]
 *
 *   t, x  the time and the position
 *   C     gradients at x, m d numbers
 *   p     input: a momentum; output: p - C^T w, whose velocity satisfies the constraints
 *   v     input: an initial guess; output: that velocity
 *   w     output, m numbers
 *
 * Without ties v is the velocity of p. Return FVI_SUCCESS; FVI_EMAXITER; FVI_ESING; FVI_EOVRFLW; or the code of the
 * Lagrangian or of a tie. */
int fvi_mechanism_project_momentum(fvi_stepper *s, double t, const double *x,
                                   const double *C, double *p, double *v,
                                   double *w);

/* fvi_mechanism_check_start -- Check that x0 and p0 satisfy the constraints and that the constraints are independent.
 * Remove from p the rounding errors that violate them, and write the velocity to o->v. Return FVI_SUCCESS, or a code
 * with the reason in *error. */
int fvi_mechanism_check_start(fvi_stepper *s, fvi_error *error);

/* ---- mechanism_contacts.c ---- */

/* fvi_mechanism_contact_count -- Return the number of events of a run that are contacts.
 * fvi_mechanism_tie_values, fvi_mechanism_tie_gradients, fvi_mechanism_tie_hessians -- Evaluate all m ties, as the
 * functions of fvi_constraints do. */
size_t fvi_mechanism_contact_count(const fvi_run *run);
int fvi_mechanism_tie_values(const fvi_stepper *s, double t, const double *x, double *c);
int fvi_mechanism_tie_gradients(const fvi_stepper *s, double t, const double *x, double *C,
                                double *ct);
int fvi_mechanism_tie_hessians(const fvi_stepper *s, double t, const double *x,
                               const double *factor, double *H);

/* fvi_mechanism_contact_increments -- Correct the values c of the contacts at stage i. A step may be so short that Z
 * has lost all digits. Then Z is replaced by the increments times the mean gradient of both ends, if both agree up to
 * rounding errors and the surface is so flat that the errors of many steps do not add up. C holds the gradients at
 * stage i and stands in o->room. */
int fvi_mechanism_contact_increments(const fvi_stepper *s, const double *u, size_t i, const double *C,
                                     double *c);

/* fvi_mechanism_close_contact, fvi_mechanism_open_contact -- Close or open the contact of event number `event`, between
 * two steps, at t and x. A closed contact keeps Z at its present value. o->C is updated; p and v are not. Return
 * FVI_SUCCESS, or the code of a gradient.
 * fvi_mechanism_row_of_contact -- Return the row of the contact, or m if it is open.
 * fvi_mechanism_keep_contacts -- Record the contacts as those of the last step, after a step.
 * fvi_mechanism_swap_contacts -- Exchange the present contacts with those of the last step. A
 * second call restores them.
 * fvi_mechanism_serialize_contacts -- Serialise the contacts of a run. Return FVI_SUCCESS; FVI_EINVAL if the archive
 * holds no possible contacts; or the code of the archive. */
int fvi_mechanism_serialize_contacts(fvi_stepper *s, fvi_archive *v);
int fvi_mechanism_close_contact(fvi_stepper *s, double t, const double *x, size_t event);
int fvi_mechanism_open_contact(fvi_stepper *s, double t, const double *x, size_t event);
size_t fvi_mechanism_row_of_contact(const fvi_mechanism_state *o, size_t event);
void fvi_mechanism_keep_contacts(fvi_mechanism_state *o);
void fvi_mechanism_swap_contacts(fvi_mechanism_state *o);

/* ---- mechanism_stage_forces.c: u holds the increments of the stages ---- */

/* fvi_mechanism_stage_time -- Return the time of stage i.
 * fvi_mechanism_inner_time -- Return the time of stage i, but at the ends of the step a time just within it, because a
 * jump of a force at a node belongs to neither side. */
double fvi_mechanism_stage_time(const fvi_stepper *s, size_t i);
double fvi_mechanism_inner_time(const fvi_stepper *s, size_t i);

/* fvi_mechanism_increment -- Return the increment of stage i, coordinate j. */
double fvi_mechanism_increment(const fvi_mechanism_state *o, const double *u, size_t i, size_t j);

/* fvi_mechanism_evaluate_stages -- Compute X, V, the derivatives of L, the elongations and lambda. On return
 * f contains all forces.
 * fvi_mechanism_add_curvature -- Add the second derivatives of the elongations (times lambda) and of the
 * ties (times Lambda) to fx. */
int fvi_mechanism_evaluate_stages(fvi_stepper *s, const double *u);
int fvi_mechanism_add_curvature(fvi_stepper *s, const double *u);

/* ---- mechanism_nodes.c, mechanism_stages.c ---- */

int fvi_mechanism_step_nodes(fvi_stepper *s);
int fvi_mechanism_step_stages(fvi_stepper *s);

/* fvi_mechanism_solve_stages -- Solve for the stages of a step, from the guess o->u, with the forces o->known + o->W
 * zdot of the dampers. The data that one step passes to the next do not change, except o->u.
 * fvi_mechanism_keep_dampers -- Add the impulses and the work of the dampers after such a step, and store
 * z, G and v of its end. */
int fvi_mechanism_solve_stages(fvi_stepper *s);
void fvi_mechanism_keep_dampers(fvi_mechanism_state *o);

/* fvi_mechanism_linearise -- Compute `matrix` and the quantities it depends on, for the unknowns u of the step that
 * begins at s->x. */
int fvi_mechanism_linearise(fvi_stepper *s, const double *u);
int fvi_mechanism_linearise_nodes(fvi_stepper *s, const double *u);

/* fvi_mechanism_end_constraints -- Subtract the impulses of the multipliers from s->p, and project s->p to the hidden
 * constraint, after fvi_mechanism_solve_stages.
 * fvi_mechanism_subtract_multipliers -- Subtract only the impulses of the multipliers from p, d numbers; C is workspace
 * for m d numbers. */
int fvi_mechanism_end_constraints(fvi_stepper *s);
int fvi_mechanism_subtract_multipliers(const fvi_stepper *s, double *C, double *p);

/* fvi_mechanism_tables -- Compute E, T and next for the form. */
void fvi_mechanism_tables(fvi_mechanism_state *o);

#endif
