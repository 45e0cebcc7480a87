/* src/fvi/observer.h -- Velocities, accelerations, forces, work and energy along a run.                  [H 13]
 *
 * A stepper (trajectory.h) holds x and p only. An observer goes along with a stepper. Step by step it adds up the
 * impulse of each damper, the work of each damper and the work of the force, and from these sums it computes what the
 * caller asks for.
 *
 *     fvi_observer *o;
 *     if (fvi_observer_start(s, FVI_OBSERVE_FORCE | FVI_OBSERVE_VELOCITY, &o, &error) == FVI_SUCCESS) {
 *         while (s->k < s->run.steps && fvi_observer_step(o, s) == FVI_SUCCESS
 *                && fvi_observer_read(o, s, s->t, &now) == FVI_SUCCESS)
 *             printf("%g %g %g\n", now.t, now.v[0], now.force[0]);
 *         fvi_observer_free(o);
 *     }
 *
 * Dampers. A run with one law, or with alpha, has one damper, d1, with d forces. A damper of a mechanism (dampers.h)
 * has one force, along its elongation. A damper of a structure that is given by a matrix has a force on each unknown.
 *
 * Velocity. v = M^-1 p has the order of p. At t = 0 a coordinate without inertia has the velocity right after the start
 * if dampers of the order 1 hold the coordinate (29.27). Otherwise this velocity may be infinite, and v is the mean
 * over the first row.
 *
 * Impulse of a damper. It is the part of the change of momentum that the force and the potential do not explain,
 *
 *     J(t_k) = p_0 - p_k + the method's own sums of F - grad U,
 *
 * and it has the order of p.
 *
 * Force of a damper. At a node it is the derivative of J. Backward differences of the impulses of the last steps
 * compute it. Their degree is one above the highest order of the method, but at most 9; for a method of order 1, such
 * as fvi_fractional, it is 1. Near t = 0 the observer compares J with the answers of the damper's law to a jump, a line
 * and a parabola (13.20). So force and acceleration have the order of p at a fixed t, and at most the order 3 in the
 * first rows.
 *
 * Acceleration and multipliers. The acceleration comes from the equation of motion, a = M^-1 (F - grad U - force). With
 * a Lagrangian, with forces that depend on velocity and with constraints it is the slope of v instead, and a multiplier
 * is the slope of its impulse. Their first rows and t = 0 then come from the equation of motion (29.23). If a
 * coordinate has no inertia, a and a multiplier at t = 0 are means over the first step, or over the first row of a
 * method that chooses its steps. Differences that reach back over a jump of F have a low order in a few rows after the
 * jump.
 *
 * First rows by shorter steps. The comparison (13.20) fails in three cases: a damper has an order above 1; the past
 * RIEMANN_LIOUVILLE jumps; a coordinate has no inertia. There the observer runs the first rows once more by
 * fvi_variable_step, with shorter steps, and takes from them the forces, accelerations and multipliers, and the
 * velocities if a coordinate has no inertia. These numbers are right to 1e-7 (seen) [H 13]. The observer does not do so
 * for more than 12 coordinates whose potential has no narrow band, for more than 200 unknowns of matrices, or if the
 * shorter steps fail or if more than 1000 are necessary. Then the first rows have the low order 2 minus the order of
 * the damping.
 *
 * Starts with a velocity. For an order of the damping up to 1 the methods of order 2 compute wrong first impulses; for
 * a dashpot they are off by a quarter. Both the impulse that the steps take from the line x_0 + v_0 t and its exact
 * impulse are known, so the observer adds the difference to J and to the work (13.18). Then over all rows J and the
 * work have the order 2, and the force has the order 3 minus twice the order of the damping, or 2 if that is lower. x,
 * p and the balance stay those of the steps. So do, after the first rows, accelerations that are slopes of velocities,
 * and multipliers.
 *
 * Work and balance. The work of a single damper is the method's own sum of force times motion. In two cases it is
 * instead the energy that the motion has lost, E_0 - E + the work of F:
 *
 *   methods with stages   their own sum would lose order in the first steps
 *   a past whose force is singular at t = 0; alpha = 1; methods that choose their steps   their own sum is not known
 *
 * The balance is E + work of the dampers - work of F. It takes the method's own sum wherever that is known, and then
 * differs from E_0 by the errors of the method. Where it is not known, the balance is E_0 by definition.
 *
 * Methods that choose their steps. They know x'' from the polynomial of their step, with one order less than p. From it
 * they know the force of each of several dampers, whose integrals are the impulse and the work of the damper. */
#ifndef FVI_OBSERVER_H
#define FVI_OBSERVER_H

#include "events.h"
#include "trajectory.h"

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(default)

typedef struct fvi_observer fvi_observer;

/* The quantities that an observer can compute. Add the bits of those that you want.
 *
 *   VELOCITY      v
 *   ACCELERATION  a
 *   FORCE         the forces of the dampers
 *   IMPULSE       the impulses of the dampers
 *   WORK          the work of each damper, the work of the force, and the balance
 *   ENERGY        E
 *   APPLIED       F
 *   MULTIPLIER    the multipliers of a mechanism's constraints; they come from their impulses as the forces do
 *   CONTACT       the force with which each contact among the events pushes
 *   OWN_STEPS     no quantity: this bit forbids the shorter steps of the first rows */
enum {
    FVI_OBSERVE_VELOCITY = 1,
    FVI_OBSERVE_ACCELERATION = 2,
    FVI_OBSERVE_FORCE = 4,
    FVI_OBSERVE_IMPULSE = 8,
    FVI_OBSERVE_WORK = 16,
    FVI_OBSERVE_ENERGY = 32,
    FVI_OBSERVE_APPLIED = 64,
    FVI_OBSERVE_MULTIPLIER = 128,
    FVI_OBSERVE_CONTACT = 256,
    FVI_OBSERVE_OWN_STEPS = 512
};

/* fvi_observation -- all quantities at one time. A quantity that was not asked for has no defined value. The arrays
 * belong to the observer and hold until its next call.
 *
 *   t               the time
 *   x, p, v, a, F   d numbers each
 *   force, impulse  of the dampers, one damper after another; each has as many numbers as its width
 *   work            one number for each damper
 *   multiplier      one number for each constraint
 *   contact         one number for each event, 0 if the event is no contact (fvi_stepper_contact_force)
 *   work_of_force   the work of F and of the impulses of the force
 *   energy          E
 *   balance         E + work of the dampers - work_of_force: E at t = 0, see above
 *   event, events   the events up to t, in the order of time (events.h), and their number
 *   is_mean         nonzero if t = 0 and the forces and a are infinite or not known there, for example for a held body
 *                   with v_0 != 0 and an order above 1. Then a force is its mean over the first row, and a comes from
 *                   this mean by the equation of motion, or is a mean itself */
typedef struct {
    double t;
    const double *x, *p, *v, *a, *F, *force, *impulse, *work,
        *multiplier, *contact;
    double work_of_force, energy, balance;
    int is_mean;
    const fvi_event_time *event;
    size_t events;
} fvi_observation;

/* fvi_observer_start -- Start an observer of a stepper at k = 0.
 *
 *   s       the stepper; it is not changed
 *   wanted  the bits of the quantities that will be read; nothing else is computed
 *   o       output; free it with fvi_observer_free
 *   error   output, or NULL
 *
 * Cost if forces, a or multipliers are wanted: that of a start of the run and of up to 30 steps for each different law,
 * 0.2 ms to 4 ms (seen); and some 50 steps of fvi_variable_step where the first rows need shorter steps.
 * Returns FVI_SUCCESS; FVI_EFAULT if s or o is NULL; FVI_EINVAL if s is not at its start; FVI_EUNSUP for forces,
 * impulses and work of a run with events but without a mechanism, and for sums that the method does not compute;
 * FVI_ENOMEM; what a function of the system returned. On error *o is untouched. */
int fvi_observer_start(const fvi_stepper *s, unsigned wanted, fvi_observer **o,
                       fvi_error *error);

/* fvi_observer_step -- Make one step of s by fvi_stepper_step, and add it to the sums.
 *
 * Returns as fvi_stepper_step; FVI_EFAULT if a pointer is NULL; FVI_ENOMEM. After an error the observer is of no
 * use. */
int fvi_observer_step(fvi_observer *o, fvi_stepper *s);

/* fvi_observer_read -- Compute the wanted quantities at a time.
 *
 *   o, s  an observer and its stepper; every step of s was made by fvi_observer_step
 *   t     s->t; with a method that chooses its steps also any time within the last step
 *   now   output; its arrays belong to o
 *
 * Cost O(d) for each quantity; one gradient of U for a, and one value of U for the energy.
 * Returns FVI_SUCCESS; FVI_EFAULT if a pointer is NULL; FVI_EOVRFLW if a wanted number is not finite; FVI_EDOM if there
 * is no state at t; FVI_ENOMEM; what a function of the system returned. On error *now holds no result. */
int fvi_observer_read(fvi_observer *o, const fvi_stepper *s, double t,
                      fvi_observation *now);

/* fvi_observer_dampers -- Return the number of dampers; 1 without a mechanism, even if nothing is damped.
 * fvi_observer_width -- Return the number of forces of damper j, counted from 0; 0 if there is no such damper.
 *
 * A mechanism has the names of its dampers (dampers.h). */
size_t fvi_observer_dampers(const fvi_observer *o);
size_t fvi_observer_width(const fvi_observer *o, size_t j);

/* fvi_observer_short_rows -- Return n if the rows 1 to n come from shorter steps; 0 if no row does. fvi_adjoint_forces
 * cannot differentiate these rows, nor row 0 if a coordinate has no inertia. */
size_t fvi_observer_short_rows(const fvi_observer *o);

/* fvi_observer_short_rows_beside -- write to *rows how many first rows come from shorter steps in a run that begins
 * beside x0 along coordinate i; 0 if no run begins there. With the past RIEMANN_LIOUVILLE a damper may jump at t = 0, unless
 * its elongation is 0. So if that is 0 at x0 alone, the forces of these rows have no derivative by x0_i.
 *
 * Returns FVI_SUCCESS or FVI_ENOMEM. */
int fvi_observer_short_rows_beside(const fvi_method *method, const fvi_run *run, size_t i, size_t *rows);

/* fvi_observer_copy -- Copy an observer, for use with a copy of its stepper (fvi_stepper_copy).
 *
 *   to  output; free it with fvi_observer_free
 *
 * Cost O(d) for each kept number. For a method of order 2 and a start with a velocity the copy also has the history of
 * one body, for each damper.
 * Returns FVI_SUCCESS; FVI_ENOMEM; what factorise of the matrices returned. On error *to is untouched.
 *
 * fvi_observer_archive -- Save or load the sums of an observer: hand them to the archive, as fvi_stepper_archive
 * (trajectory.h) hands over the state of a stepper. Returns FVI_SUCCESS, or the code that the archive returned.
 *
 * fvi_observer_free -- Free an observer. NULL is allowed. */
int fvi_observer_copy(const fvi_observer *from, fvi_observer **to);
int fvi_observer_archive(fvi_observer *o, fvi_archive *archive);
void fvi_observer_free(fvi_observer *o);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
