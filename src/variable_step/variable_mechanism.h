/* src/variable_step/variable_mechanism.h -- A mechanism in a run with variable steps. [H 29, 22]
 *
 * Internal to the library. A step is form D of (29.7), (29.8) with s = 6 or 8 stages. In a step of length h the force
 * of a damper is
 *
 *     lambda = H + rho h^{-beta} W0 (zdot - [beta > 0] zdot_e),                (29.18)
 *
 * where H is the history of its modes (22.10), W0 = (A^{-1})^beta, beta = order - 1, and zdot_e is the last zdot of the
 * step before. So the modes of an elongation z are like the modes of a coordinate in variable_step.h. A law that is not
 * a single power has the modes and the W0 of (26.18). */
#ifndef FVI_VARIABLE_MECHANISM_H
#define FVI_VARIABLE_MECHANISM_H

#include "mechanism/mechanism_state.h"
#include "variable_step.h"

typedef struct {
    double beta, rho;
    fvi_square W0;
    double W1[FVI_LANES]; /* W0 1 of the terms that depend on zdot - before, and not on zdot */
    double leakage;
    fvi_modes *modes, *rising;
    fvi_variable_step_kernel *kernel; /* NULL: a power */
    double before, now; /* zdot at the end of the last step: before and after a jump of the velocity */
    double centre;      /* for a spring (order 0): the elongation at rest */
} fvi_mesh_damper;

/* The r dampers of a mechanism. Stages stand as in variable_step.h. Legendre coefficients of a function f in a step are
 * those of h f. An array with 0 in its name belongs to the last step. */
struct fvi_mesh_mechanism {
    size_t r;
    fvi_mesh_damper *damper;
    double h;         /* of the steps that W0 is for; 0: none */
    double *numbers;  /* all arrays below, in one piece */
    double *p_compensation, *p0, *slope0, *force0, *power0, *by_force0, *impulse0, *work0, *mass,
        *multiplier0;
    double by_force;  /* the work of the forces F until the end of the last step, and until its start */
    double by_force_begin;
    double *slope, *inverse; /* slope: p' in the step that is tried; inverse: L_vv^{-1} at its end */
};

/* fvi_mesh_start -- allocate s->mechanism and the dampers of a run, and check the start. o->d and o->rule must be
 * known. Returns FVI_SUCCESS; FVI_EUNSUP for a damper of order 2; FVI_ENOMEM; the codes of fvi_mechanism_start.
 *
 * fvi_mesh_scale -- compute the size of the motion for a tolerance that is relative: |x0|, or the distance that the
 * body moves between two rows, or 1. Returns FVI_SUCCESS or FVI_ENOMEM. */
int fvi_mesh_start(fvi_stepper *s, fvi_variable_step_state *o);
int fvi_mesh_scale(fvi_stepper *s, double *scale);

/* fvi_mesh_begin -- set modes, y, v and the groups. T, `least` and the arrays of o must be known. Returns FVI_SUCCESS;
 * FVI_ENOMEM; FVI_ESING; the codes of fvi_mesh_begin_damper, of fvi_mechanism_check_stretch and of the Lagrangian. */
int fvi_mesh_begin(fvi_stepper *s, fvi_variable_step_state *o);

/* fvi_mesh_shortest -- return how short steps may have to be, as a part of T, because velocities of dampers jump at the
 * start, by impulses or by impacts; 1 if nothing makes steps short; 0 if no step is short enough. */
double fvi_mesh_shortest(const fvi_stepper *s, const fvi_variable_step_state *o);

/* fvi_mesh_try, fvi_mesh_accept -- try a step as fvi_variable_step_try does; and take it, except for the time. They
 * return FVI_SUCCESS; FVI_EMAXITER or FVI_ESING if the step cannot be solved; FVI_ENOMEM; the codes of the Lagrangian,
 * of the constraints and of the forces. */
int fvi_mesh_try(fvi_stepper *s, fvi_variable_step_state *o, fvi_length length,
                 double *error);
int fvi_mesh_accept(fvi_stepper *s, fvi_variable_step_state *o);

/* fvi_mesh_coefficients -- compute the Legendre coefficients of the polynomial with these values at the stages,
 * FVI_LANES numbers. */
void fvi_mesh_coefficients(const fvi_variable_step_state *o, const double *values, double *to);

/* fvi_mesh_estimate -- estimate the error of the step that has been tried; NaN if a number is not finite. Returns
 * FVI_SUCCESS; FVI_EMAXITER or FVI_ESING if the velocities at the stages cannot be projected; FVI_ENOMEM; the codes of
 * the constraints. (22.16) */
int fvi_mesh_estimate(fvi_stepper *s, const fvi_variable_step_state *o, double *error);

/* fvi_mesh_answer -- compute how v changes by an impulse r: r becomes L_vv^{-1} r, with zeros for coordinates without
 * inertia. With constraints C v = 0, r becomes the first part of the solution of [L_vv C^T; C 0] (v, w) = (r, 0).
 *
 *   r  d + m numbers, zeros behind the first d
 *
 * It takes (d + m)^2 numbers of o->room. Returns FVI_SUCCESS or FVI_ESING. */
int fvi_mesh_answer(const fvi_mechanism_state *o, const double *Lvv, const double *C, double *r);

/* fvi_mesh_jump -- add factor J to p at the end of the last step, where x is. v and all zdot follow. With constraints p
 * also gets their impulses, so that v keeps to the constraints. (29.22)
 *
 * fvi_mesh_apply_impulse -- apply an impulse J of the force in this way, and add its work to by_force, except at
 * t = 0, where the energy of the start contains it.
 *
 * Both return FVI_SUCCESS; FVI_ESING; FVI_EMAXITER; the codes of the Lagrangian. */
int fvi_mesh_jump(fvi_stepper *s, fvi_variable_step_state *o, const double *J,
                  double factor);
int fvi_mesh_apply_impulse(fvi_stepper *s, fvi_variable_step_state *o, const double *J);

/* fvi_mesh_inverse_along -- compute n . M^{-1} n at the end of the last step, where M is L_vv at the velocity v, and
 * M^{-1} is the map of fvi_mesh_answer.
 *
 * fvi_mesh_impact -- compute lambda with n . v(p + lambda n) = n . v + change, also at the end of the last step. The
 * input value of lambda is a guess, and v is the velocity of p. (29.20)
 *
 * Both return the codes of fvi_mesh_jump, and the second FVI_EOVRFLW. */
int fvi_mesh_inverse_along(fvi_stepper *s, const double *normal, const double *v,
                           double *inverse);
int fvi_mesh_impact(fvi_stepper *s, const double *normal, const double *v, double change,
                    double *lambda);

/* ---- variable_mechanism_contact.c: closed contacts ---- */

/* fvi_mesh_contact_force -- return the multiplier Lambda of the constraint in row l at theta of the step that has been
 * tried.
 *
 * fvi_mesh_contact_noise -- return the effect of rounding errors of the positions on this multiplier.
 *
 * fvi_mesh_contact_error -- raise *error to the error that (22.16) gives for the positions at the stages of a body that
 * moves with the acceleration of the closed contacts. So the steps follow a contact force that changes while the body
 * does not move. Returns FVI_SUCCESS or FVI_ESING.
 *
 * fvi_mesh_find_tensile_contact -- find the event whose closed contact would be under the largest tension after p +=
 * factor J; SIZE_MAX if no contact would. Nothing changes.
 *
 *   side   one number for each event, the sign of Z on the side of its body
 *   event  output
 *
 * Returns the codes of fvi_mesh_jump. */
double fvi_mesh_contact_force(const fvi_stepper *s, const fvi_variable_step_state *o, size_t l,
                              double theta);
double fvi_mesh_contact_noise(const fvi_stepper *s, const fvi_variable_step_state *o, size_t l);
int fvi_mesh_contact_error(fvi_stepper *s, const fvi_variable_step_state *o, double *error);
int fvi_mesh_find_tensile_contact(fvi_stepper *s, fvi_variable_step_state *o, const double *J,
                                  double factor, const double *side, size_t *event);

/* fvi_mesh_momentum -- compute p at theta of the last step, or of the step that is tried.
 *
 * fvi_mesh_end -- compute x and p at the end of the step that is tried. Returns FVI_SUCCESS; FVI_ENOMEM; the codes of
 * the constraints. */
void fvi_mesh_momentum(const fvi_stepper *s, const fvi_variable_step_state *o, double theta,
                       int is_tried, double *p);
int fvi_mesh_end(const fvi_stepper *s, const fvi_variable_step_state *o, double *x, double *p);

/* fvi_mesh_sums -- compute the force, the impulse and the work of damper j at a time t in the last step.
 * fvi_mesh_work_of_forces -- return the work of the forces F until t.
 * fvi_mesh_multiplier -- return the multiplier of constraint i at t.
 * fvi_mesh_velocity -- compute the velocity v of x and p at t.
 * fvi_mesh_project -- project p onto the hidden constraint, C v + c_t = 0, and compute its v from a guess of v. Within
 * a step p satisfies it to a lower order than at the ends.
 * fvi_mesh_project_within -- do the same within the last step, with the contacts that were closed in that step.
 *
 * The functions with a code return FVI_SUCCESS; FVI_ENOMEM; the codes of the constraints and of the Lagrangian. */
void fvi_mesh_sums(const fvi_stepper *s, size_t j, double t, double *force, double *impulse,
                   double *work);
double fvi_mesh_work_of_forces(const fvi_stepper *s, double t);
double fvi_mesh_multiplier(const fvi_stepper *s, size_t i, double t);
int fvi_mesh_project(const fvi_stepper *s, double t, const double *x, double *p, double *v);
int fvi_mesh_project_within(const fvi_stepper *s, double t, const double *x, double *p, double *v);
int fvi_mesh_velocity(const fvi_stepper *s, double t, const double *x, const double *p,
                      double *v);

/* fvi_mesh_copy, _archive, _free -- the parts of the functions of fvi_method for a mechanism. */
int fvi_mesh_copy(const fvi_stepper *from, fvi_stepper *to);
int fvi_mesh_archive(fvi_stepper *s, fvi_archive *v);
void fvi_mesh_free(fvi_variable_step_state *o);

/* ---- variable_mechanism_memory.c: the memory of dampers ---- */

/* fvi_mesh_begin_damper -- allocate the modes and W0 of a damper.
 *
 *   count  the history of the damper has so many numbers
 *   j      the number of the damper, for an error message
 *
 * Returns FVI_SUCCESS; FVI_EUNSUP if a pole of the law is too near to its cut; FVI_ENOMEM.
 *
 * fvi_mesh_present_damper -- compute the present part W of its force for steps of length h: s s numbers, row by row. */
int fvi_mesh_begin_damper(fvi_stepper *s, const fvi_variable_step_state *o,
                          const fvi_kernel *kernel, size_t count, size_t j,
                          fvi_mesh_damper *to);
void fvi_mesh_present_damper(const fvi_variable_step_state *o, double h, fvi_mesh_damper *of,
                             double *W);

/* The other functions of a damper whose history has `count` numbers, with s stages.
 *
 * fvi_mesh_stretch_damper -- before the first step: the numbers z jump from 0 at t = 0, so y = sigma z in every mode.
 *
 * fvi_mesh_add_history -- in a step of this length: known += rho H. Number n at stage i stands at [i * count + n].
 *
 * fvi_mesh_advance_damper -- advance number n by a step. v: its rates at the stages, FVI_LANES numbers, zeros behind
 * the s-th. *before: its rate at the end of the step before; replaced by the last rate of v.
 *
 * fvi_mesh_copy_damper, _archive_damper, _free_damper -- copy, serialise and free the modes and the law. The copy
 * returns FVI_SUCCESS or FVI_ENOMEM. */
void fvi_mesh_stretch_damper(fvi_variable_step_state *o, fvi_mesh_damper *of, size_t count, const double *z);
void fvi_mesh_add_history(const fvi_mesh_damper *of, fvi_length length, size_t s, size_t count, double *known);
void fvi_mesh_advance_damper(const fvi_mesh_damper *of, size_t n, size_t s, const double *v, double *before);
int fvi_mesh_copy_damper(const fvi_mesh_damper *from, fvi_mesh_damper *to);
int fvi_mesh_archive_damper(fvi_mesh_damper *of, fvi_archive *v);
void fvi_mesh_free_damper(fvi_mesh_damper *of);

/* The parts of the functions above for all dampers. */
int fvi_mesh_allocate(fvi_variable_step_state *o, size_t r, size_t m);
int fvi_mesh_begin_dampers(fvi_stepper *s, fvi_variable_step_state *o);
void fvi_mesh_present(const fvi_stepper *s, fvi_variable_step_state *o);
void fvi_mesh_predict(const fvi_stepper *s, fvi_variable_step_state *o);
void fvi_mesh_advance(const fvi_stepper *s, fvi_variable_step_state *o);

#endif
