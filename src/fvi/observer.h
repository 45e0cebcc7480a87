/* src/fvi/observer.h -- Velocities, accelerations, forces and work along a run.
 *
 * A stepper knows x and p. An observer goes with it and adds up what else is asked: the impulse of
 * each damper, its work, the work of the force.
 *
 *     fvi_observer *o;
 *     if (fvi_observer_start(s, FVI_OBSERVE_FORCE | FVI_OBSERVE_VELOCITY, &o, &error) == FVI_SUCCESS) {
 *         while (s->k < s->run.steps && fvi_observer_step(o, s) == FVI_SUCCESS
 *                && fvi_observer_read(o, s, s->t, &now) == FVI_SUCCESS)
 *             printf("%g %g %g\n", now.t, now.v[0], now.force[0]);
 *         fvi_observer_free(o);
 *     }
 *
 * Orders. v = M^-1 p, of the order of p. The impulse of a damper is what the momenta leave for it,
 *
 *     J(t_k) = p_0 - p_k + the method's own sums of F - grad U,
 *
 * and of the order of p. Its force at a node is the derivative of J, by backward differences of
 * the impulses of the last steps, of an order that is one above the highest of the method, 9 at
 * most. Near t = 0 its J is compared with what its law answers to a jump, a line and a parabola (13.20). So force and a have
 * the order of p at a fixed t, and 3 at most in the first rows.
 * Where an order is above 1, where the past rl jumps, and where a coordinate has no inertia, no comparison helps. There the
 * first rows of forces, a, multipliers, and of v if a coordinate has no inertia, are those of fvi_variable_step, which takes
 * the run up to there with shorter steps [H 13]: right to 1e-8 (seen). It does not for more than 12
 * coordinates whose potential has no narrow band, for more than 200 unknowns of matrices, or where it fails or needs more than
 * 1000 steps; then these rows are of low order, 2 - that of the damping.
 * The v of a coordinate without inertia at t = 0 is that right behind it, if dampers of the order 1 hold the coordinate (29.27);
 * else it may be infinite, and is the mean over the first row.
 * Of a start with a velocity and an order of the damping up to 1, the methods of order 2 get the first impulses wrong,
 * by a quarter for a dashpot. What the steps take from the line x_0 + v_0 t and what is exact are both known, and J and the
 * work have the difference (13.18): over all rows J and the work then have the order 2, the force 3 - twice that of the
 * damping, or 2 if that is lower. x, p and the balance are those of the steps; so are, behind the first rows, accelerations that are slopes of velocities,
 * and multipliers.
 * The acceleration is the equation of motion, a = M^-1 (F - grad U - force); of a Lagrangian, of forces of velocity and
 * of constraints it is the slope of v, and a multiplier is the slope of its impulses. Their first rows, and t = 0, come from
 * the equation of motion (29.23), unless a coordinate has no inertia: then a and a multiplier at t = 0 are means over the
 * first step, or the first row of a method that chooses its steps. Differences reach back
 * over a jump of F: a few rows behind it are of low order.
 * The work of one damper is what the energy has lost, E_0 - E + the work of F, with stages, where the
 * sum of force times motion would lose order in the first steps; and where that sum is not
 * known: where the initial history has a force that is singular at t = 0, at alpha = 1, and of a method
 * that chooses its steps. Else it is the method's own sum. The balance takes the own sum wherever it is
 * known, and is E_0 but for the errors of the method; else it is E_0 by itself.
 * A method that chooses its steps knows x'' as the polynomial of its step: an order less than p; and so the force of each of
 * several dampers, whose integrals are its impulse and its work.
 *
 * A run with one law, or alpha, has one damper, d1, of d forces. That of a mechanism (dampers.h)
 * has a force along its elongation, and a structure's by a matrix a force on each unknown. */
#ifndef FVI_OBSERVER_H
#define FVI_OBSERVER_H

#include "events.h"
#include "trajectory.h"

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(default)

typedef struct fvi_observer fvi_observer;

/* What is asked for, added. VELOCITY: v; ACCELERATION: a; FORCE, IMPULSE: of the dampers; WORK: of the
 * dampers and of the force, and the balance; ENERGY: E; APPLIED: F; MULTIPLIER: of a mechanism's constraints, from
 * their impulses as the forces; CONTACT: how strongly each contact among the events pushes. OWN_STEPS: not a quantity, but
 * that no shorter steps take the first rows. */
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

/* fvi_observation -- what is known at a time. What was not asked for is of no use. The arrays
 * belong to the observer, until it is read again.
 *
 *   x, p, v, a, F   d numbers each
 *   force, impulse  of the dampers, one after another, each as many numbers as its width
 *   work            of each damper
 *   multiplier      of each constraint
 *   contact         of each event, 0 if it is no contact (fvi_stepper_contact_force)
 *   work_of_force   by F, and by impulses of the force
 *   energy          E
 *   balance         E + work of the dampers - work_of_force: E at t = 0, see above
 *   event, events   what has happened up to then, in its order (events.h)
 *   is_mean         nonzero if force and a are infinite, or not known, at this time, t = 0: held with v_0 != 0 and an
 *                   order above 1. Then a force is its mean over the first row, and a is what it makes of the
 *                   equation of motion, or a mean itself */
typedef struct {
    double t;
    const double *x, *p, *v, *a, *F, *force, *impulse, *work,
        *multiplier, *contact;
    double work_of_force, energy, balance;
    int is_mean;
    const fvi_event_time *event;
    size_t events;
} fvi_observation;

/* fvi_observer_start -- of a stepper at k = 0.
 *
 *   wanted  what will be read: nothing else is computed
 *   o       output; free it with fvi_observer_free
 *
 * Cost: if forces, a or multipliers are asked for, as much as a start of the run and up to 30 steps for each different law,
 * which is 0.2 ms to 4 ms (seen); where shorter steps take the first rows some 50 steps of fvi_variable_step more. Returns FVI_SUCCESS; FVI_EFAULT; FVI_EINVAL if s is not at its start; FVI_EUNSUP for a
 * sum that a method does not know; FVI_ENOMEM; what a function of the system returned. */
int fvi_observer_start(const fvi_stepper *s, unsigned wanted, fvi_observer **o,
                       fvi_error *error);

/* fvi_observer_step -- fvi_stepper_step, and what it did is added. Errors as there. */
int fvi_observer_step(fvi_observer *o, fvi_stepper *s);

/* fvi_observer_read -- what is known at a time: s->t, or one within the last step of a method that
 * chooses its steps. Every step of s was made by fvi_observer_step.
 *
 * Returns FVI_SUCCESS; FVI_EOVRFLW if a number is not finite; FVI_EDOM if there is no state at t; what
 * a function of the system returned. Cost: of what was asked, of a and the energy a gradient
 * and a value of U. */
int fvi_observer_read(fvi_observer *o, const fvi_stepper *s, double t,
                      fvi_observation *now);

/* fvi_observer_dampers -- how many there are; 1 without a mechanism, damped or not.
 * fvi_observer_width -- how many forces damper j, from 0, has.
 * The name of a mechanism's damper is its own (dampers.h). */
size_t fvi_observer_dampers(const fvi_observer *o);
size_t fvi_observer_width(const fvi_observer *o, size_t j);

/* fvi_observer_short_rows -- rows 1 to how many are those of shorter steps; 0: none. fvi_adjoint_forces does not know their
 * derivatives, nor those of row 0 if a coordinate has no inertia. */
size_t fvi_observer_short_rows(const fvi_observer *o);

/* fvi_observer_copy -- the same again, for a copy of the stepper. FVI_ENOMEM. Of a method of order 2 that starts with
 * a velocity it may take as long as a run of one body to this step, for each damper.
 * fvi_observer_archive -- its sums, as fvi_stepper_archive shows those of the stepper.
 * fvi_observer_free -- give everything back. NULL is allowed. */
int fvi_observer_copy(const fvi_observer *from, fvi_observer **to);
int fvi_observer_archive(fvi_observer *o, fvi_archive *archive);
void fvi_observer_free(fvi_observer *o);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
