/* src/observer/observer_state.h -- The state of an observer.
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

/* The highest degree of differences. The increments of the impulses are kept for as many steps. */
enum { FVI_MOST_DIFFERENCES = 9 };

/* The indices of `scalars`. */
enum { FVI_BY_FORCE, FVI_BEGIN_TIME, FVI_HITS, FVI_SCALARS };

struct fvi_observer {
    size_t d, dampers, forces; /* forces: of all dampers together */
    size_t slopes;             /* d velocities, if a is their slope; else 0 */
    size_t ties;               /* number of the constraints whose multipliers are wanted */
    size_t tracked;            /* forces, slopes and ties together, in this order */
    size_t contacts;           /* number of the events whose contact forces are wanted */
    size_t on_structure;       /* how many dampers of matrices there are, if the method chooses its steps; else 0 */
    int has_mechanism;         /* the dampers have forces along elongations, one each */
    int by_velocity;           /* a is the slope of v: with a Lagrangian, constraints, forces of velocity or a mass of
                                  0 */
    unsigned wanted; /* what the user observes: FVI_OBSERVE_... (fvi/observer.h) */
    int is_summed;   /* the steps are summed */
    int is_damped;   /* otherwise all forces are 0 */
    int is_mass;     /* alpha = 1: the damping acts as a mass */
    int work_known;  /* the sums over the steps are the work; otherwise the balance is E_0 by definition */
    int by_energy;   /* the work of the damper is computed as the loss of energy */
    int is_infinite; /* a force, a or a multiplier is infinite, or not known, at t = 0 */
    int has_infinite_force; /* the force of a damper is infinite at t = 0 */
    int has_massless; /* a coordinate of a mechanism has no inertia, and its velocity at the start is not known */
    int begin_v_known; /* each such coordinate has a finite velocity just after t = 0 */
    size_t degree;   /* of the differences */
    const fvi_mechanism *mechanism;
    void *factors;   /* of M, for a system with matrices; or NULL */
    const fvi_matrices *matrices;
    double *numbers; /* all arrays, in one block */
    size_t bends; /* size of `bend`: dampers times first rows, or 0 */
    size_t count, saved; /* how many numbers there are; how many of them the steps change */
    /* the arrays that steps change */
    double *impulse; /* J of each force, then the velocities and the impulses of constraints */
    double *latest;  /* the increments of these in the last `degree` steps, the latest first */
    double *work;    /* of each damper */
    double *begun_work, *stage_power; /* for dampers of matrices with chosen steps: the work of each up to the beginning
                                         of the last step, and FVI_LANES numbers each: force times velocity at the
                                         stages */
    double *lead;    /* of each damper: the lead in its impulse for a rate of 1 (observer_ramp.h) */
    double *bend;    /* of each damper in rows 1, 2, ...: delta_k of (29.24), the error of its elongation */
    double *bend_rate; /* of each damper: the error of the velocity of its elongation now */
    double *known;   /* the impulses of F - grad U, d numbers; for chosen steps up to the beginning of the last one */
    double *scalars; /* the work of the force; the time up to which `known` counts; how many impulses have acted */
    /* the arrays that stay the same */
    double *p0, *start; /* d numbers; the forces at t = 0, then accelerations and multipliers */
    double *begin_v;    /* d: the velocities at t = 0, of the coordinates without inertia */
    double *exponent;   /* q of each force: J = t^q g(t) at first; NaN for a velocity or a constraint */
    double *jump, *line; /* of each force: z = jump + line t + ... for its law; jump is z_0 for the past rl, and else
                            0 */
    double *is_jumping, *is_moving; /* of each force: nonzero if its jump, or its line, is not 0 */
    double *growth;     /* of each damper: its law grows like |s|^growth */
    double *rate;       /* of each force: rate times lead is added to its impulse */
    double *power;      /* of each damper: power times lead is added to its work */
    fvi_ramp **ramp;    /* of each damper, NULL if it has none; or NULL */
    fvi_law_rows law_rows;
    fvi_short_rows short_rows;
    double E0; /* the energy at t = 0 */
    /* room */
    fvi_step_begin begin; /* the state before the step */
    double *hit, *change; /* impulses of the force at a node, d numbers; increments of the tracked sums in one step */
    double *x, *p, *v, *a, *F, *g, *force, *impulse_now, *work_now, *contact;
};

/* fvi_observer_row -- the row of damper j of a structure, d numbers: its force is one number times the row. NULL: the
 * damper has a matrix, or the forces of the system stand along elongations. A structure with one unknown may have both
 * kinds of dampers, and the forces of both are one number. */
const double *fvi_observer_row(const fvi_observer *o, size_t j);

/* fvi_observer_velocity -- write v = M^-1 p, or the velocity of the mechanism of s. */
int fvi_observer_velocity(const fvi_observer *o, const fvi_stepper *s,
                          const double *p, double *v);

/* fvi_observer_hits -- for a method that chooses its steps: add the impulses of the force that act at s->t to known,
 * and their work to *by_force. */
int fvi_observer_hits(fvi_observer *o, const fvi_stepper *s, double *known,
                      double *by_force);

/* fvi_observer_begin_forces -- compute the forces at t = 0, the exponents of their impulses, and the rows of the laws.
 * fvi_observer_begin_motion -- for a mechanism, compute the accelerations and multipliers at t = 0 from the forces of
 * its dampers. If a force is infinite, or if the equation of motion cannot be solved, o->start stays as it is. Returns
 * FVI_SUCCESS or FVI_ENOMEM. */
int fvi_observer_begin_forces(fvi_observer *o, const fvi_stepper *s);
int fvi_observer_begin_motion(fvi_observer *o, const fvi_stepper *s);

/* fvi_observer_begin_ramps -- write rate and power, and start the ramps of all dampers, for a start with a velocity.
 * fvi_observer_step_ramps -- compute the leads of all dampers at the end of a step. changed: their increments, a number
 * for each damper.
 * fvi_observer_copy_ramps -- copy the ramps of another observer; `to` has none.
 * fvi_observer_free_ramps -- free them. The first three return FVI_SUCCESS or the code of what failed. */
int fvi_observer_begin_ramps(fvi_observer *o, const fvi_stepper *s);
int fvi_observer_step_ramps(fvi_observer *o, double *changed);
int fvi_observer_copy_ramps(const fvi_observer *from, fvi_observer *to);
void fvi_observer_free_ramps(fvi_observer *o);

/* fvi_observer_elongation -- write z = g(x) and zdot of a damper of a mechanism at the start, with the velocity o->v;
 * changes o->F. */
int fvi_observer_elongation(fvi_observer *o, const fvi_stepper *s,
                            const fvi_elongation *of, double *z, double *rate);

/* fvi_observer_differences -- write the slopes of all tracked sums at node k of steps h. */
void fvi_observer_differences(const fvi_observer *o, size_t k, double h,
                              double *slope);

/* fvi_observer_slope -- return the slope of sum j alone, at k > 0.
 * fvi_observer_is_compared -- return nonzero if force j is computed by (13.20) in the first rows. Otherwise it is
 * computed from J/t^q.
 * fvi_observer_begin_force -- return the force at t = 0+ of damper `damper`, whose elongation jumps by `jump` and goes
 * on with the velocity `line`; INFINITY if it is infinite. o->start has such numbers. */
double fvi_observer_slope(const fvi_observer *o, size_t j, size_t k, double h);
int fvi_observer_is_compared(const fvi_observer *o, size_t j);
double fvi_observer_begin_force(const fvi_run *run, size_t damper, double jump, double line);

/* fvi_observer_first_rows -- how many rows are so near to the start that differences have too few rows before them.
 * fvi_observer_motion_rows -- how many of the first rows take a and the multipliers from the equation of motion: all
 * first rows; or, if a damper has an order above 1 and starts with a velocity, those for which the differences are too
 * short.
 * fvi_observer_compare_forces -- compute the forces of a mechanism's dampers at row k by (13.20), also for one power.
 * If the first steps have errors, the elongations are corrected (29.24).
 * fvi_observer_bend -- at the end of a step near the start: update bend and bend_rate.
 * fvi_observer_motion -- for a mechanism, compute the accelerations and multipliers from the equation of motion
 * (29.23), at the time t, the position x and the momenta of s, with F in o->F. At t = 0 it takes the forces of the
 * dampers from o->force, and in later rows from fvi_observer_compare_forces. The results go to o->force, behind the
 * forces of the dampers. fvi_observer_motion and _bend return FVI_SUCCESS; FVI_ENOMEM; FVI_EUNSUP if a coordinate has
 * no inertia or a contact is closed; or why the equation has no solution. On error o->force is untouched. */
size_t fvi_observer_first_rows(const fvi_observer *o);
size_t fvi_observer_motion_rows(const fvi_observer *o);
void fvi_observer_compare_forces(const fvi_observer *o, size_t k, double h, double *force);
int fvi_observer_bend(fvi_observer *o, const fvi_stepper *s);
int fvi_observer_motion(fvi_observer *o, const fvi_stepper *s, double t, const double *x);

/* fvi_observer_damping -- write the sum of the forces of all dampers, as they act on d/dt p, d numbers. */
int fvi_observer_damping(const fvi_observer *o, const fvi_stepper *s,
                         double *sum);

/* fvi_observer_mechanism_work -- add the work of the forces on a mechanism in its last step to *work: F and the forces
 * of velocity, summed at the points of the step. Changes o->g. */
int fvi_observer_mechanism_work(fvi_observer *o, const fvi_stepper *s, double *work);

/* ---- observer_structure.c: dampers of matrices, by a method that chooses its steps ----
 *
 * fvi_observer_is_on_structure -- return nonzero if the run has such dampers.
 * fvi_observer_close_structure -- before the next step: add the last step to the impulses and the work.
 * fvi_observer_keep_structure -- after a step: store the powers at its stages.
 * fvi_observer_structure_sums -- at the time t in the last step: write o->impulse_now and o->work.
 * fvi_observer_structure_forces -- the same for o->force. The functions with a code return FVI_SUCCESS or the code of
 * the matrices. */
int fvi_observer_is_on_structure(const fvi_observer *o, const fvi_stepper *s);
int fvi_observer_close_structure(fvi_observer *o, const fvi_stepper *s);
int fvi_observer_keep_structure(fvi_observer *o, const fvi_stepper *s);
int fvi_observer_structure_sums(fvi_observer *o, const fvi_stepper *s, double t);
int fvi_observer_structure_forces(fvi_observer *o, const fvi_stepper *s, double t);

/* ---- observer_massless.c: the velocities of coordinates without inertia at t = 0 ----
 *
 * fvi_observer_begin_massless -- compute o->begin_v by (29.27). o->begin_v_known: nonzero if (29.27) has a solution.
 * fvi_observer_mean_massless -- if it has none: take the mean over the first row. The short rows are known, if there
 * are any.
 * fvi_observer_begin_accelerations -- if o->begin_v_known: compute the accelerations of the other coordinates at t = 0,
 * from o->start.
 * fvi_observer_put_massless -- copy these velocities to v, whose other numbers stay. The first three return
 * FVI_SUCCESS; FVI_ENOMEM; the code of a step, or of a function of the system. */
int fvi_observer_begin_massless(fvi_observer *o, const fvi_stepper *s);
int fvi_observer_mean_massless(fvi_observer *o, const fvi_stepper *s);
int fvi_observer_begin_accelerations(fvi_observer *o, const fvi_stepper *s);
void fvi_observer_put_massless(const fvi_observer *o, const fvi_stepper *s, double *v);

/* fvi_observer_take_first_row -- take the steps of the first row, or up to the event that ends the run before.
 *
 *   fork  a stepper at t = 0
 *   sums  the observer of the steps; or NULL
 *   end   output: the time that is reached, h or that of the event
 *
 * Returns FVI_SUCCESS; FVI_EINVAL if an event at t = 0 ends the run; the code of a step. */
int fvi_observer_take_first_row(fvi_stepper *fork, fvi_observer *sums, double *end);

/* fvi_observer_read_all -- as fvi_observer_read, but for a structure's damper along a row it gives all d forces. */
int fvi_observer_read_all(fvi_observer *o, const fvi_stepper *s, double t, fvi_observation *now);

/* fvi_observer_quadrature -- for a method that chooses its steps: add the impulse of F - grad U from the time `from` to
 * `to`, both in the last step, to known, and the work of F to *by_force. Returns what the force, the potential or the
 * matrices return. */
int fvi_observer_quadrature(fvi_observer *o, const fvi_stepper *s, double from,
                            double to, double *known, double *by_force);

#endif
