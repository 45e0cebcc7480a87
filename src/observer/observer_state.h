/* src/observer/observer_state.h -- What an observer keeps.
 *
 * Internal to the room. */
#ifndef FVI_OBSERVER_STATE_H
#define FVI_OBSERVER_STATE_H

#include "methods/step_sums.h"
#include "observer_law.h"
#include "observer_ramp.h"
#include "observer_short_steps.h"

#include <fvi/dampers.h>
#include <fvi/observer.h>

/* Differences have this degree at most; columns of impulses are kept for so many steps. */
enum { FVI_MOST_DIFFERENCES = 9 };

/* Where the numbers of `scalars` stand. */
enum { FVI_BY_FORCE, FVI_BEGIN_TIME, FVI_HITS, FVI_SCALARS };

struct fvi_observer {
    size_t d, dampers, forces; /* forces of all dampers together */
    size_t slopes;             /* d velocities where a is their slope, or 0 */
    size_t ties;               /* the constraints whose multipliers are asked for */
    size_t tracked;            /* all three, in this order */
    size_t contacts;           /* the events whose contact forces are asked for */
    size_t on_structure;       /* the dampers, if they are of matrices and steps are chosen; or 0 */
    int has_mechanism;         /* whose forces are along elongations, one each */
    int by_velocity;           /* a is the slope of v: L, constraints, forces of velocity */
    unsigned wanted;
    int is_summed;   /* are the steps summed? */
    int is_damped;   /* without it all forces are 0 */
    int is_mass;     /* alpha = 1: the damping is a mass */
    int work_known;  /* by the sums over the steps: else the balance holds by itself */
    int by_energy;   /* is the work that is told what the energy has lost? */
    int is_infinite; /* is a force, a or a multiplier infinite, or not known, at t = 0? */
    int has_infinite_force; /* of a damper at t = 0 */
    int has_massless; /* a coordinate of a mechanism without inertia, whose start is not known */
    int begin_v_known; /* has each of these a finite velocity right behind t = 0? */
    size_t degree;   /* of the differences */
    const fvi_mechanism *mechanism;
    void *factors;   /* of M, of a system with matrices; or NULL */
    const fvi_matrices *matrices;
    double *numbers; /* all arrays, in one piece */
    size_t bends; /* dampers times first rows, or 0 */
    size_t count, saved; /* of the numbers; those that steps change */
    /* what steps change */
    double *impulse; /* J of each force, and the velocities */
    double *latest;  /* degree times what the last steps have added to them, the latest first */
    double *work;    /* of each damper */
    double *begun_work, *stage_power; /* of each damper of matrices, where steps are chosen: the work to the begin of the last
                                       * step, and FVI_LANES numbers: force times velocity at its stages */
    double *lead;    /* of each damper, what the start with a velocity leaves in its impulse, of a unit */
    double *bend;    /* of each damper in rows 1, 2, ...: delta_k of (29.24), which its elongation lacks */
    double *bend_rate; /* of each damper: the velocity that its elongation lacks now */
    double *known;   /* the impulses of F - grad U, d numbers: of chosen steps, at their begin */
    double *scalars; /* the work of the force; the time at which `known` stands; impulses so far */
    /* what does not change */
    double *p0, *start; /* d; the forces at t = 0 */
    double *begin_v;    /* d: at t = 0, of the coordinates without inertia */
    double *exponent;   /* q of each force: J = t^q g(t) at first; NaN of a velocity */
    double *jump, *line; /* of each force: z = jump + line t + ... for its law, with jump = z_0 of the past rl or 0 */
    double *is_jumping, *is_moving; /* of each force: nonzero if its jump, or its line, is not 0 */
    double *growth;     /* of each damper: its law is like |s|^growth */
    double *rate;       /* of each force: its impulse has rate times lead more */
    double *power;      /* of each damper: its work has power times lead more */
    fvi_ramp **ramp;    /* of each damper, NULL if it has none; or NULL */
    fvi_law_rows law_rows;
    fvi_short_rows short_rows;
    double E0;
    /* what is made anew */
    fvi_step_begin begin;
    double *hit, *change;
    double *x, *p, *v, *a, *F, *g, *force, *impulse_now, *work_now, *contact;
};

/* fvi_observer_velocity -- v = M^-1 p, or that of the mechanism of s. */
int fvi_observer_velocity(const fvi_observer *o, const fvi_stepper *s,
                          const double *p, double *v);

/* fvi_observer_hits -- of a method that chooses its steps: add the impulses of the force that act at s->t
 * to known, and their work. */
int fvi_observer_hits(fvi_observer *o, const fvi_stepper *s, double *known,
                      double *by_force);

/* fvi_observer_begin_forces -- the forces at t = 0, the exponents of their impulses, and the rows of the laws.
 * fvi_observer_begin_motion -- of a mechanism the accelerations and multipliers at t = 0 from the forces of its
 * dampers. If a force is infinite, or if the equation of motion cannot be solved, o->start stays as it is. Returns
 * FVI_SUCCESS or FVI_ENOMEM. */
int fvi_observer_begin_forces(fvi_observer *o, const fvi_stepper *s);
int fvi_observer_begin_motion(fvi_observer *o, const fvi_stepper *s);

/* fvi_observer_begin_ramps -- rate, power and ramp of all dampers, of a start with a velocity.
 * fvi_observer_step_ramps -- lead of all dampers at the end of the step; changed, room for as many numbers, is what it
 * has grown by.
 * fvi_observer_copy_ramps -- those of another observer; `to` has none.
 * fvi_observer_free_ramps -- give them back.
 * The first three return FVI_SUCCESS or what failed. */
int fvi_observer_begin_ramps(fvi_observer *o, const fvi_stepper *s);
int fvi_observer_step_ramps(fvi_observer *o, double *changed);
int fvi_observer_copy_ramps(const fvi_observer *from, fvi_observer *to);
void fvi_observer_free_ramps(fvi_observer *o);

/* fvi_observer_elongation -- z = g(x) and zdot of a damper of a mechanism at the start, from o->v; o->F is used. */
int fvi_observer_elongation(fvi_observer *o, const fvi_stepper *s,
                            const fvi_elongation *of, double *z, double *rate);

/* fvi_observer_differences -- at node k of steps h, the slopes of what is tracked. */
void fvi_observer_differences(const fvi_observer *o, size_t k, double h,
                              double *slope);

/* fvi_observer_slope -- the same of force j alone, at k > 0.
 * fvi_observer_is_compared -- is force j by (13.20) in the first rows? Else it is by J/t^q.
 * fvi_observer_begin_force -- the force at t = 0+ of an elongation that jumps by jump and goes on with the velocity line,
 * as o->start has it of force j, of damper `damper`; INFINITY where there is none. */
double fvi_observer_slope(const fvi_observer *o, size_t j, size_t k, double h);
int fvi_observer_is_compared(const fvi_observer *o, size_t j);
double fvi_observer_begin_force(const fvi_run *run, size_t damper, double jump, double line);

/* fvi_observer_first_rows -- how many rows are near the start, where differences have too few rows before them.
 * fvi_observer_motion_rows -- how many of the first rows take a and the multipliers from the equation of motion: all of
 * them, or, if a damper has an order above 1 and starts with a velocity, those for which the differences are too short.
 * fvi_observer_compare_forces -- the forces of a mechanism's dampers at row k by (13.20), of one power, too. If the first
 * steps err, the elongations are corrected (29.24).
 * fvi_observer_bend -- at the end of a step near the start: bend and bend_rate.
 * fvi_observer_motion -- of a mechanism at the time t, the place x and the momenta of s: accelerations and multipliers
 * from the equation of motion (29.23), with F in o->F. At t = 0 it takes the forces of the dampers from o->force, and in
 * later rows from fvi_observer_compare_forces. The results go to o->force, behind the forces of the dampers.
 * fvi_observer_motion and _bend return FVI_SUCCESS; FVI_ENOMEM; FVI_EUNSUP if a coordinate has no inertia or a contact is
 * closed; or why the equation has no solution. On error o->force is untouched. */
size_t fvi_observer_first_rows(const fvi_observer *o);
size_t fvi_observer_motion_rows(const fvi_observer *o);
void fvi_observer_compare_forces(const fvi_observer *o, size_t k, double h, double *force);
int fvi_observer_bend(fvi_observer *o, const fvi_stepper *s);
int fvi_observer_motion(fvi_observer *o, const fvi_stepper *s, double t, const double *x);

/* fvi_observer_damping -- what all dampers take from d/dt p, d numbers: the sum of their forces. */
int fvi_observer_damping(const fvi_observer *o, const fvi_stepper *s,
                         double *sum);

/* fvi_observer_mechanism_work -- what the forces on a mechanism gave in its last step, added to *work: F and
 * those of velocity, summed at the points of its step. */
int fvi_observer_mechanism_work(const fvi_stepper *s, double *work);

/* ---- observer_structure.c: dampers of matrices, by a method that chooses its steps ----
 *
 * fvi_observer_is_on_structure -- are these the dampers?
 * fvi_observer_close_structure -- before the next step: the impulses and the work go on over the last one.
 * fvi_observer_keep_structure -- behind a step: the powers at its stages.
 * fvi_observer_structure_sums, _forces -- at the time t in the last step: o->impulse_now and o->work; o->force.
 * They return what the matrices return. */
int fvi_observer_is_on_structure(const fvi_observer *o, const fvi_stepper *s);
int fvi_observer_close_structure(fvi_observer *o, const fvi_stepper *s);
int fvi_observer_keep_structure(fvi_observer *o, const fvi_stepper *s);
int fvi_observer_structure_sums(fvi_observer *o, const fvi_stepper *s, double t);
int fvi_observer_structure_forces(fvi_observer *o, const fvi_stepper *s, double t);

/* ---- observer_massless.c: the velocities of coordinates without inertia at t = 0 ----
 *
 * fvi_observer_begin_massless -- o->begin_v by (29.27), if it has a solution: o->begin_v_known says so.
 * fvi_observer_mean_massless -- else: the mean over the first row; the short rows are known, if there are any.
 * fvi_observer_begin_accelerations -- if o->begin_v_known: the accelerations of the others at t = 0, from o->start.
 * fvi_observer_put_massless -- into v, whose other numbers stay.
 * The first three return FVI_SUCCESS; FVI_ENOMEM; what a step, or a function of the system, returns. */
int fvi_observer_begin_massless(fvi_observer *o, const fvi_stepper *s);
int fvi_observer_mean_massless(fvi_observer *o, const fvi_stepper *s);
int fvi_observer_begin_accelerations(fvi_observer *o, const fvi_stepper *s);
void fvi_observer_put_massless(const fvi_observer *o, const fvi_stepper *s, double *v);

/* fvi_observer_read_all -- as fvi_observer_read, but of a structure's damper along a row all d forces. */
int fvi_observer_read_all(fvi_observer *o, const fvi_stepper *s, double t, fvi_observation *now);

/* fvi_observer_quadrature -- of a method that chooses its steps: add to known, and to *by_force, what F
 * - grad U and F do from the time `from` to `to`, both in the last step. */
int fvi_observer_quadrature(fvi_observer *o, const fvi_stepper *s, double from,
                            double to, double *known, double *by_force);

#endif
