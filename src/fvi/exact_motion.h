/* src/fvi/exact_motion.h -- The exact motion of a linear system with several masses and dampers.          [H 11]
 *
 *     M x'' + K x + sum_j B_j C_j(D) (x - x_0) = F(t),   x(0) = x_0,  M x'(0) = p_0
 *
 * The solution is the sum over the poles of the system and an integral around the branch cut of the laws. For one
 * oscillator exact_solution.h can do more: all pasts, rows at equal steps, and twice the digits of its phase.
 *
 *     fvi_exact_motion *motion;
 *     const fvi_exact_problem problem = { .motion = { .system = &system }, .x0 = x0, .p0 = p0 };
 *     if (fvi_exact_motion_alloc(&problem, &motion, &error) == FVI_SUCCESS)
 *         fvi_exact_motion_at(motion, 1, &t, x, v, &error); */
#ifndef FVI_EXACT_MOTION_H
#define FVI_EXACT_MOTION_H

#include "exact_solution.h"
#include "response.h"

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(default)

/* fvi_exact_problem -- what moves, and how it starts.
 *
 *   motion   masses, a quadratic potential, and dampings with alpha or a law; or matrices (structures.h); and dampers
 *            along linear elongations or by matrices (dampers.h). All were held before t = 0 (see response.h)
 *   x0, p0   the start, d finite numbers each; copied
 *   forcing, A, T, w  the same force on every unknown, as in fvi_linear_oscillator */
typedef struct {
    fvi_linear_motion motion;
    const double *x0, *p0;
    fvi_forcing forcing;
    double A, T, w;
} fvi_exact_problem;

typedef struct fvi_exact_motion fvi_exact_motion;

/* fvi_exact_motion_alloc -- prepare a motion: find its poles.                               [(11.20)]
 *
 *   problem  read here; what its system, laws and matrices point to must outlive the motion
 *   motion   output; free it with fvi_exact_motion_free
 *   error    output or NULL: what is wrong
 *
 * Cost: that of fvi_poles_find for all poles.
 * Returns FVI_SUCCESS; what fvi_response_alloc, fvi_poles_find and a callback return; or
 *   FVI_EFAULT    problem, motion, x0 or p0 is NULL
 *   FVI_EINVAL    unknown forcing
 *   FVI_EDOM      a number is not finite, T is negative, or K is not positive semidefinite
 *   FVI_EUNSUP    a potential that is not quadratic; an elongation that is not linear; a damper with the past
 *                 RIEMANN_LIOUVILLE, or with CAPUTO and an order above 1; a system for which the number of poles is
 *                 unknown
 *   FVI_ESING     w is the frequency of a mode without damping
 *   FVI_EMAXITER  not all poles were found
 *   FVI_ENOMEM
 * On error *motion is untouched. */
int fvi_exact_motion_alloc(const fvi_exact_problem *problem, fvi_exact_motion **motion,
                           fvi_error *error);

/* fvi_exact_motion_at -- compute the solution at n times.                         [(11.20)]
 *
 *   t     n times, finite, >= 0. Increasing times cost least
 *   x, v  outputs, n d numbers each, owned by the caller: coordinate i at t[k] at [k * d + i]. One of them may be NULL
 *   error output or NULL
 *
 * Accuracy: 1e-12 of max |x| over [0, t], and of max |v|, while w t < 1e4 for every frequency w of the system (no
 * proof; seen 1e-13). Beyond that the rounding errors of the poles, u w t, are added. A cosine in or near resonance
 * costs digits, because two large residues cancel: with delta = |s_k - i w| for the nearest pole s_k the error is up to
 * u (w/delta)^2 of max |x| (seen 0.1 of that). That is 1e-10 for a damping ratio of 1/1000, and no digit is left at
 * delta = 1e-8 w. For one oscillator fvi_exact_at loses none.
 * Cost: for all times from t to 4 t together 63 factorisations of Z, twice as many with a force; then 130 d products of
 * complex numbers for each time.
 * Returns FVI_SUCCESS; FVI_EFAULT if motion or t is NULL, or x and v both are; FVI_EDOM for a time; FVI_EOVRFLW if x or
 * v is not finite; FVI_ESING or FVI_ENOMEM from a factorisation. On error x and v are of no use. */
int fvi_exact_motion_at(fvi_exact_motion *motion, size_t n, const double *t, double *x,
                        double *v, fvi_error *error);

/* fvi_exact_outputs -- what fvi_exact_motion_forces_at writes, owned by the caller. x and v must not be NULL. What is
 * NULL among the others is not computed.
 *
 *   x, v, a         d numbers each
 *   force, impulse  of all dampers, one damper after another, as an observer gives them (observer.h): one number for
 *                   each elongation, d numbers for each matrix, and d numbers for the damping of a system without a
 *                   mechanism. The impulse is the integral of the force from 0 to t */
typedef struct {
    double *x, *v, *a, *force, *impulse;
} fvi_exact_outputs;

/* fvi_exact_motion_forces -- return how many numbers `force` has.
 *
 * fvi_exact_motion_forces_at -- compute positions, velocities, accelerations and the forces of the dampers at one
 * time.   [(11.21)]
 *
 *   t      finite, >= 0. At t = 0 the forces are their limits from above
 *   first  finite, > 0. Some forces have no limit at t = 0: of an order above 1 after a start with a velocity the force
 *          is infinite, and of the order 2 beside other dampers it is not known. The mean over (0, first] is written in
 *          its place, and a is what the equation of motion makes of it
 *   out    outputs
 *   error  output or NULL
 *
 *     double x[2], v[2], force[1];
 *     const fvi_exact_outputs out = { .x = x, .v = v, .force = force };
 *     status = fvi_exact_motion_forces_at(motion, 0.5, 0.01, &out, &error);
 *
 * At the end T of a step of the force a is its limit from below. Accuracy: that of x of fvi_exact_motion_at, times the
 * largest stiffness or |C(1/t)| that acts on x (no proof; seen 1e-13 of max |a|). Cost: three times that of one time of
 * fvi_exact_motion_at. Returns as fvi_exact_motion_at; FVI_EFAULT also if out, out->x or out->v is NULL, FVI_EDOM also
 * for first. On error the outputs are of no use. */
size_t fvi_exact_motion_forces(const fvi_exact_motion *motion);
int fvi_exact_motion_forces_at(fvi_exact_motion *motion, double t, double first,
                               const fvi_exact_outputs *out, fvi_error *error);

/* fvi_exact_motion_free -- free a motion. NULL is allowed. */
void fvi_exact_motion_free(fvi_exact_motion *motion);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
