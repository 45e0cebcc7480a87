/* src/mechanism/mechanism_state.h -- What a run with a mechanism knows at a step.  [H 29]
 *
 * Internal: what mechanism_start.c makes, and the steps change. */
#ifndef FVI_MECHANISM_STATE_H
#define FVI_MECHANISM_STATE_H

#include "mechanism.h"
#include <fvi/events.h>
#include "kernel/kernel_impulses.h"
#include "stages/lobatto_history.h"

/* A damper with a history. */
typedef struct {
    size_t damper;
    fvi_kernel kernel;
    double drift;         /* t drift is taken away from z - z_0 */
    double first;         /* the weight of the present, order 1 and nodes */
    fvi_history *history;
    fvi_lobatto_history *stages;
    double *last;         /* the last term; of stages the sums over the past, s numbers */
} fvi_mechanism_part;

/* A force that the start leaves in a damper, known at every step: of one term of its kernel, or of all. */
typedef struct {
    size_t damper;
    double size; /* rho A h^(1 + e) of (19.3); or A */
    fvi_kernel_impulse impulse;
    fvi_impulses_of_kernel *of_kernel; /* instead of it; owned */
} fvi_mechanism_start_force;

/* d coordinates, r dampers, m constraints; stage i of coordinate j stands at [i * d + j], and q is the
 * number of points at which a step evaluates the Lagrangian: s, or 1. The first `own` constraints are those of
 * the run, and the others are its contacts that are closed, of which there are `most` - `own` at most. */
typedef struct fvi_mechanism_state {
    fvi_method method; /* with these steps; not read on a mesh */
    fvi_mechanism_form form;
    int is_on_mesh;    /* steps of any length, the one that is tried from t on */
    double h, t;       /* the length of a step */
    double rest_scale; /* while a contact is closed: how far the bodies have been; else 0 */
    size_t s, q, d, r, m, n; /* n unknowns */
    size_t own, most, *contact; /* the number of the event of each closed contact */
    size_t last_m, *last_contact; /* m and the contacts of the last step, for times within it */
    const fvi_lobatto_rule *rule;
    double E[FVI_STAGES][FVI_STAGES], T[FVI_STAGES][FVI_STAGES],
        next[FVI_STAGES][FVI_STAGES]; /* (29.7) */
    size_t begin;          /* the first stage that is unknown: 1 in form M */
    int has_root;          /* of the equation: no second derivatives are wanted */
    size_t parts, start_forces;
    fvi_mechanism_part *part;
    fvi_mechanism_start_force *start_force;
    char *is_massless; /* of each coordinate: neither inertia nor constraint */
    int any_massless; /* of the node scheme */

    double *numbers; /* all that follows, in one piece */
    size_t saved;    /* so many of them go from step to step */
    double *impulse, *work, *begun, *ended, *tie; /* r, r, m, m, m */
    double *level; /* m: of a contact the Z at which it has closed, 0 or less than the error of a step */
    double *v, *u, *z, *G, *C, *z0; /* d, n, r, r d, m d: at the node; r */
    double *raw; /* 4 d: x_k, x_{k-1}, x_{k-2}, x_{k-3} of the node scheme, for (29.17) and (29.25) */

    double *W; /* r of s * s (1 of nodes): the present in the force of a damper */
    double *known, *lambda, *zdot; /* r of s */
    double *start_impulse; /* 2 r: of the start forces, at both ends of a step; nodes */
    double *X, *V, *f, *Lv, *fx, *fv, *Lxv, *Lvv; /* of the q points */
    double *load, *elongation, *gradient; /* the force of t, (q + 1) d; q r, q r d */
    double *residual, *matrix, *change, *trial; /* n, n n, n, n */
    double *room; /* whatever a function needs: room_size numbers */
    size_t *order;
} fvi_mechanism_state;

/* fvi_mechanism_of -- of a stepper that takes these steps; NULL else. */
const fvi_mechanism_state *fvi_mechanism_of(const fvi_stepper *s);

/* fvi_mechanism_work_of_impulse -- the work of an impulse J at x, added to *work; p is the momentum behind it. Of
 * masses it is J v with the mean v of before and after, and of a Lagrangian what its energy has gained.
 * Returns FVI_SUCCESS; FVI_ENOMEM; what the Lagrangian returned. */
int fvi_mechanism_work_of_impulse(const fvi_stepper *s, double t, const double *x, const double *p,
                                  const double *J, double *work);

/* fvi_mechanism_copy, _serialize, _free -- as fvi_method has them; s->mechanism is made anew, or given back.
 * What only a mesh has is left to who steps on it. */
int fvi_mechanism_copy(const fvi_stepper *from, fvi_stepper *to);
int fvi_mechanism_serialize(fvi_stepper *s, fvi_archive *v);
void fvi_mechanism_free(fvi_mechanism_state *o);

/* ---- mechanism_point.c ---- */

/* fvi_mechanism_point -- L's derivatives and the forces of velocity at point number i: f, fx, fv,
 * Lv, Lxv, Lvv of (X_i, V_i); with_forces 0 leaves the forces of velocity out. */
int fvi_mechanism_point(fvi_stepper *s, size_t i, double t, int with_forces);

/* fvi_mechanism_elongations -- z, r numbers, and G, r d numbers, of all dampers at x. */
int fvi_mechanism_elongations(const fvi_stepper *s, double t, const double *x,
                              double *z, double *G);

/* fvi_mechanism_force -- the force of t alone at t, d numbers; zeros if there is none. */
int fvi_mechanism_force(fvi_stepper *s, double t, double *F);

/* ---- mechanism_memory.c ---- */

/* fvi_mechanism_begin_histories -- the histories and start forces of all dampers, for a start with the
 * velocity v. */
int fvi_mechanism_begin_histories(fvi_stepper *s, const double *v,
                                  fvi_error *error);

/* fvi_mechanism_is_stretched -- at the start: is the elongation of damper j more than roundings (run/solution.h)?
 * fvi_mechanism_check_stretch -- can damper j, from 0, have been stretched at t = 0 at once, the past rl? */
int fvi_mechanism_is_stretched(const fvi_stepper *s, size_t j);
int fvi_mechanism_check_stretch(const fvi_kernel *kernel, size_t j, fvi_error *error);

/* fvi_mechanism_predict_forces -- `known` and `start_impulse` of this step. The force of a damper is then
 * lambda = known + W z at the node scheme, and known + W zdot at stages. */
int fvi_mechanism_predict_forces(fvi_stepper *s);

/* fvi_mechanism_update_histories -- add a step to the histories of the dampers. z is the elongation at the
 * time t less z_0, r numbers; at stages zdot, r s numbers. Of order 1, lambda is an output. */
int fvi_mechanism_update_histories(fvi_stepper *s, double t, const double *z);

/* fvi_mechanism_slope -- the slope of z_j at the start, where the velocity is v. Returns what damper j's rate does. */
int fvi_mechanism_slope(const fvi_stepper *s, size_t j, const double *v, double *zdot);

/* fvi_mechanism_needs_start_slope -- does the force of a damper begin with a term that weights alone give to no
 * full order? Of order 1 they act alone, as in the paper, but for Caputo's past, which has no such term.
 * At stages an order of 2 is a mass, and has none. */
int fvi_mechanism_needs_start_slope(const fvi_mechanism_state *o, const fvi_damper *damper);

/* fvi_mechanism_tolerance -- what the histories of stages keep: a tenth of the tolerance of the run;
 * without one the finest there is. */
double fvi_mechanism_tolerance(const fvi_run *run);

int fvi_mechanism_copy_parts(const fvi_mechanism_state *from,
                             fvi_mechanism_state *to);
int fvi_mechanism_serialize_parts(fvi_stepper *s, fvi_archive *archive);
void fvi_mechanism_free_parts(fvi_mechanism_state *o);

/* ---- mechanism_newton.c ---- */

/* fvi_mechanism_solve -- residual(u) = 0 for the n unknowns u.
 *
 *   assemble  writes residual and matrix, the residual's Jacobian, at u
 *   u         in: the guess; out: the root
 *
 * Where Newton's method from the guess fails it begins again at u = 0, where nothing moves, with
 * steps that are shortened until they make the residual smaller. The first `places` of u are
 * increments of coordinates. Returns FVI_SUCCESS, FVI_EMAXITER, FVI_ESING, or what assemble
 * returned. */
int fvi_mechanism_solve(fvi_stepper *s,
                        int (*assemble)(fvi_stepper *s, const double *u),
                        size_t places, double *u);

/* ---- mechanism_constraints.c ---- */

/* fvi_mechanism_project_momentum -- make p and v obey the hidden constraint, C v + c_t = 0. [(29.4)]
 *
 *   t, x  the place     C  at x, m d numbers
 *   p     in: a momentum; out: p - C^T w, whose velocity keeps to the constraints
 *   v     in: a guess; out: that velocity
 *   w     output, m numbers
 *
 * Without constraints v is that of p. */
int fvi_mechanism_project_momentum(fvi_stepper *s, double t, const double *x,
                                   const double *C, double *p, double *v,
                                   double *w);

/* fvi_mechanism_check_start -- do x0 and p0 keep to the constraints, and are these independent? p
 * loses what its roundings have against them; o->v becomes the velocity. */
int fvi_mechanism_check_start(fvi_stepper *s, fvi_error *error);

/* ---- mechanism_contacts.c ---- */

/* fvi_mechanism_contact_count -- how many events of a run are contacts.
 * fvi_mechanism_tie_values, _gradients, _hessians -- as fvi_constraints has them, of all m constraints. */
size_t fvi_mechanism_contact_count(const fvi_run *run);
int fvi_mechanism_tie_values(const fvi_stepper *s, double t, const double *x, double *c);
int fvi_mechanism_tie_gradients(const fvi_stepper *s, double t, const double *x, double *C,
                                double *ct);
int fvi_mechanism_tie_hessians(const fvi_stepper *s, double t, const double *x,
                               const double *factor, double *H);

/* fvi_mechanism_contact_increments -- a step may be so short that Z of stage i has no digits left. Then it is the
 * increments times the mean slope of both ends, where the two agree to rounding and the surface is so little bent that
 * the errors of many steps do not add up. C: gradients there, o->room. */
int fvi_mechanism_contact_increments(const fvi_stepper *s, const double *u, size_t i, const double *C,
                                     double *c);

/* fvi_mechanism_close_contact, _open_contact -- between two steps, at t and x: the contact that is event number
 * `event` holds Z where it is from here on, or no longer. o->C follows; p and v do not. Return what the gradients do.
 * fvi_mechanism_row_of_contact -- its row, m if it is open.
 * fvi_mechanism_keep_contacts -- a step is taken: they are those of the last step.
 * fvi_mechanism_swap_contacts -- those of the last step become those that hold, until the second call.
 * fvi_mechanism_serialize_contacts -- as fvi_mechanism_serialize, where the run has contacts. */
int fvi_mechanism_serialize_contacts(fvi_stepper *s, fvi_archive *v);
int fvi_mechanism_close_contact(fvi_stepper *s, double t, const double *x, size_t event);
int fvi_mechanism_open_contact(fvi_stepper *s, double t, const double *x, size_t event);
size_t fvi_mechanism_row_of_contact(const fvi_mechanism_state *o, size_t event);
void fvi_mechanism_keep_contacts(fvi_mechanism_state *o);
void fvi_mechanism_swap_contacts(fvi_mechanism_state *o);

/* ---- mechanism_stage_forces.c: for the increments u of the stages ---- */

/* fvi_mechanism_stage_time -- of stage i. fvi_mechanism_inner_time -- from within the step at its ends: a jump
 * at a node belongs to neither side. */
double fvi_mechanism_stage_time(const fvi_stepper *s, size_t i);
double fvi_mechanism_inner_time(const fvi_stepper *s, size_t i);

/* fvi_mechanism_increment -- of stage i, coordinate j. */
double fvi_mechanism_increment(const fvi_mechanism_state *o, const double *u, size_t i, size_t j);

/* fvi_mechanism_evaluate_stages -- X, V, the derivatives of L, elongations, lambda; f has all forces.
 * fvi_mechanism_add_curvature -- second derivatives of elongations and constraints: what lambda and Lambda
 * change of fx. */
int fvi_mechanism_evaluate_stages(fvi_stepper *s, const double *u);
int fvi_mechanism_add_curvature(fvi_stepper *s, const double *u);

/* ---- mechanism_nodes.c, mechanism_stages.c ---- */

int fvi_mechanism_step_nodes(fvi_stepper *s);
int fvi_mechanism_step_stages(fvi_stepper *s);

/* fvi_mechanism_solve_stages -- the stages of a step, from the guess o->u, for the forces o->known + o->W
 * zdot of dampers: nothing that goes from step to step has changed.
 * fvi_mechanism_keep_dampers -- such a step is taken: impulses and work, z, G and v at its end. */
int fvi_mechanism_solve_stages(fvi_stepper *s);
void fvi_mechanism_keep_dampers(fvi_mechanism_state *o);

/* fvi_mechanism_linearise -- everything at the unknowns u of the step that begins at s->x: `matrix`, and all
 * that it was made of. */
int fvi_mechanism_linearise(fvi_stepper *s, const double *u);
int fvi_mechanism_linearise_nodes(fvi_stepper *s, const double *u);

/* fvi_mechanism_end_constraints -- behind that: s->p loses the impulses of the multipliers, and what the hidden
 * constraint says of it. fvi_mechanism_subtract_multipliers -- the first alone, of p, d numbers; C is room for
 * m d numbers. */
int fvi_mechanism_end_constraints(fvi_stepper *s);
int fvi_mechanism_subtract_multipliers(const fvi_stepper *s, double *C, double *p);

/* fvi_mechanism_tables -- E, T and next of the form. */
void fvi_mechanism_tables(fvi_mechanism_state *o);

#endif
