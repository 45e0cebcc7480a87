/* src/variable_step/variable_mechanism.h -- A mechanism on a mesh of steps of any length.   [H 29, 22]
 *
 * Internal. Form D of (29.7), (29.8) with s = 6 or 8 stages, where damper j has at a step of length h
 *
 *     lambda = H + rho h^{-beta} W0 (zdot - [beta > 0] zdot_e),                (29.18)
 *
 * H its modes (22.10), W0 = (A^{-1})^beta, beta = order - 1, and zdot_e the last zdot of the step before.
 * So an elongation is to its modes what a coordinate is to those of variable_step.h. A law that is more
 * than one power has the modes and the W0 of (26.18). */
#ifndef FVI_VARIABLE_MECHANISM_H
#define FVI_VARIABLE_MECHANISM_H

#include "mechanism/mechanism_state.h"
#include "variable_step.h"

typedef struct {
    double beta, rho;
    fvi_square W0;
    double W1[FVI_LANES]; /* W0 1 of what sees zdot - before, and not zdot */
    double leakage;
    fvi_modes *modes, *rising;
    fvi_variable_step_kernel *kernel; /* NULL: a power */
    double before, now; /* zdot at the end of the last step; behind a jump of the velocity */
    double centre;      /* of a spring: where it rests */
} fvi_mesh_damper;

/* Stages stand as in variable_step.h; Legendre coefficients of functions of a step are those of h f. */
struct fvi_mesh_mechanism {
    size_t r;
    fvi_mesh_damper *damper;
    double h;         /* of the steps for which W0 is */
    double *numbers;  /* all that follows, in one piece */
    double *p_less, *p0, *slope0, *force0, *power0, *by_force0, *impulse0, *work0, *mass,
        *multiplier0;
    double by_force;  /* the work of the forces F until the end of the last step, and its begin */
    double by_force_begin;
    double *slope, *inverse; /* those of p', of the step that is tried; L_vv^{-1} at its end */
};

/* fvi_mesh_start -- s->mechanism and the dampers of a run, and what the start says of steps: o->d is known.
 * Returns as fvi_stepper_start. fvi_mesh_scale -- a size for a tolerance that is none: of x0; or of what the
 * body does in the time of a row; or 1. o->rule must be known to the first. */
int fvi_mesh_start(fvi_stepper *s, fvi_variable_step_state *o);
int fvi_mesh_scale(fvi_stepper *s, double *scale);

/* fvi_mesh_begin -- once T, `least`, y and the groups are there: modes, y, v. */
int fvi_mesh_begin(fvi_stepper *s, fvi_variable_step_state *o);

/* fvi_mesh_shortest -- how short steps may have to be, as a part of T, for what the start, impulses and
 * impacts make of the velocities of dampers; 1 if it asks for nothing.
 * fvi_mesh_takes_kicks -- as o->takes_kicks. */
double fvi_mesh_shortest(const fvi_stepper *s, const fvi_variable_step_state *o);
int fvi_mesh_takes_kicks(const fvi_stepper *s, const fvi_variable_step_state *o);

/* fvi_mesh_try, fvi_mesh_accept -- as fvi_variable_step_try; and the step is taken, but for the time. */
int fvi_mesh_try(fvi_stepper *s, fvi_variable_step_state *o, fvi_length length,
                 double *error);
int fvi_mesh_accept(fvi_stepper *s, fvi_variable_step_state *o);

/* fvi_mesh_coefficients -- Legendre coefficients of the polynomial with such values at the stages, FVI_LANES numbers. */
void fvi_mesh_coefficients(const fvi_variable_step_state *o, const double *values, double *to);

/* fvi_mesh_estimate -- the error of the step that has been tried, NaN if a number is not finite.   (22.16) */
int fvi_mesh_estimate(fvi_stepper *s, const fvi_variable_step_state *o, double *error);

/* fvi_mesh_answer -- how v answers to an impulse r: L_vv^{-1} r, zeros for coordinates without inertia; and with
 * the constraints C v = 0 the first part of the solution of [L_vv C^T; C 0] (v, w) = (r, 0). r has d + m
 * numbers, zeros behind the first d. It takes (d + m)^2 numbers of o->room.
 * Returns FVI_SUCCESS, FVI_ESING. */
int fvi_mesh_answer(const fvi_mechanism_state *o, const double *Lvv, const double *C, double *r);

/* fvi_mesh_jump -- p += factor J at the end of the last step, where x is: v and all zdot follow. With
 * constraints p also takes their own impulses, so that v keeps to them.      (29.22)
 * fvi_mesh_apply_impulse -- the same of an impulse of the force, 1 J, whose work counts after t = 0.
 * Returns what the Lagrangian does, FVI_ESING, FVI_EMAXITER. */
int fvi_mesh_jump(fvi_stepper *s, fvi_variable_step_state *o, const double *J,
                  double factor);
int fvi_mesh_apply_impulse(fvi_stepper *s, fvi_variable_step_state *o, const double *J);

/* fvi_mesh_inverse_along -- n . M^{-1} n at the end of the last step, M = L_vv at the velocity v; M^{-1} as
 * fvi_mesh_answer has it.
 * fvi_mesh_impact -- lambda with n . v(p + lambda n) = n . v + change there, from a guess. v is that of p.
 *                                                                            (29.20)
 * Both return as fvi_mesh_jump. */
int fvi_mesh_inverse_along(fvi_stepper *s, const double *normal, const double *v,
                           double *inverse);
int fvi_mesh_impact(fvi_stepper *s, const double *normal, const double *v, double change,
                    double *lambda);

/* ---- variable_mechanism_contact.c: contacts that are closed ---- */

/* fvi_mesh_contact_force -- Lambda of the constraint in row l at theta of the step that has been tried.
 * fvi_mesh_contact_noise -- what roundings of the places make of it there.
 * fvi_mesh_contact_error -- what (22.16) would say of the places at the stages if the body moved with the acceleration
 * of the closed contacts: so the steps know how a contact force changes, though the body lies still. *error becomes no
 * less. Returns FVI_SUCCESS, FVI_ESING.
 * fvi_mesh_find_tensile_contact -- after p += factor J, the event whose closed contact is under tension, or SIZE_MAX.
 * Nothing changes. side: of each event, the sign of Z where its body is. Returns as fvi_mesh_jump. */
double fvi_mesh_contact_force(const fvi_stepper *s, const fvi_variable_step_state *o, size_t l,
                              double theta);
double fvi_mesh_contact_noise(const fvi_stepper *s, const fvi_variable_step_state *o, size_t l);
int fvi_mesh_contact_error(fvi_stepper *s, const fvi_variable_step_state *o, double *error);
int fvi_mesh_find_tensile_contact(fvi_stepper *s, fvi_variable_step_state *o, const double *J,
                                  double factor, const double *side, size_t *event);

/* fvi_mesh_momentum -- p at theta of the last step, or of the one that is tried.
 * fvi_mesh_end -- x and p at the end of the one that is tried. Returns what the constraints do, FVI_ENOMEM. */
void fvi_mesh_momentum(const fvi_stepper *s, const fvi_variable_step_state *o, double theta,
                       int is_tried, double *p);
int fvi_mesh_end(const fvi_stepper *s, const fvi_variable_step_state *o, double *x, double *p);

/* fvi_mesh_sums -- of damper j at a time t in the last step: force, impulse and work.
 * fvi_mesh_work_of_forces -- what F gave until then. fvi_mesh_multiplier -- of constraint i there.
 * fvi_mesh_velocity -- the velocity of x and p there. fvi_mesh_project -- and p keeps to the hidden constraint,
 * from a guess of v: the stages know it to a lower order than the ends of steps do. fvi_mesh_project_within -- the
 * same within the last step, with the contacts that were closed there. */
void fvi_mesh_sums(const fvi_stepper *s, size_t j, double t, double *force, double *impulse,
                   double *work);
double fvi_mesh_work_of_forces(const fvi_stepper *s, double t);
double fvi_mesh_multiplier(const fvi_stepper *s, size_t i, double t);
int fvi_mesh_project(const fvi_stepper *s, double t, const double *x, double *p, double *v);
int fvi_mesh_project_within(const fvi_stepper *s, double t, const double *x, double *p, double *v);
int fvi_mesh_velocity(const fvi_stepper *s, double t, const double *x, const double *p,
                      double *v);

/* fvi_mesh_copy, _archive, _free -- as fvi_method has them. */
int fvi_mesh_copy(const fvi_stepper *from, fvi_stepper *to);
int fvi_mesh_archive(fvi_stepper *s, fvi_archive *v);
void fvi_mesh_free(fvi_variable_step_state *o);

/* ---- variable_mechanism_memory.c: each of all dampers ---- */

/* fvi_mesh_begin_damper -- the modes and W0 of a damper whose history has `count` numbers; j is its number, for
 * what is refused. fvi_mesh_present_damper -- the present part of its force for steps of length h, s s numbers,
 * row by row. */
int fvi_mesh_begin_damper(fvi_stepper *s, const fvi_variable_step_state *o,
                          const fvi_kernel *kernel, size_t count, size_t j,
                          fvi_mesh_damper *to);
void fvi_mesh_present_damper(const fvi_variable_step_state *o, double h, fvi_mesh_damper *of,
                             double *W);

/* What else a damper whose history has `count` numbers does, on its own modes; s stages.
 *
 * fvi_mesh_stretch_damper -- before the first step: the numbers z are a jump from 0 at t = 0, y = sigma z in every mode.
 * fvi_mesh_add_history -- in a step of such length: known += rho H, of number n at stage i at [i * count + n].
 * fvi_mesh_advance_damper -- the step is taken: number n had the rates v at the stages, FVI_LANES numbers, zeros behind
 * the s-th, and *before at the end of the step before, which becomes the last of them.
 * fvi_mesh_copy_damper, _archive_damper, _free_damper -- the modes and the law: *to is a damper of its own. FVI_ENOMEM. */
void fvi_mesh_stretch_damper(fvi_variable_step_state *o, fvi_mesh_damper *of, size_t count, const double *z);
void fvi_mesh_add_history(const fvi_mesh_damper *of, fvi_length length, size_t s, size_t count, double *known);
void fvi_mesh_advance_damper(const fvi_mesh_damper *of, size_t n, size_t s, const double *v, double *before);
int fvi_mesh_copy_damper(const fvi_mesh_damper *from, fvi_mesh_damper *to);
int fvi_mesh_archive_damper(fvi_mesh_damper *of, fvi_archive *v);
void fvi_mesh_free_damper(fvi_mesh_damper *of);

int fvi_mesh_allocate(fvi_variable_step_state *o, size_t r, size_t m);
int fvi_mesh_begin_dampers(fvi_stepper *s, fvi_variable_step_state *o);
void fvi_mesh_present(const fvi_stepper *s, fvi_variable_step_state *o);
void fvi_mesh_predict(const fvi_stepper *s, fvi_variable_step_state *o);
void fvi_mesh_advance(const fvi_stepper *s, fvi_variable_step_state *o);

#endif
