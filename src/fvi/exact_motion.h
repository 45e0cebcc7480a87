/* src/fvi/exact_motion.h -- The exact motion of a linear system.          [H 11]
 *
 *     M x'' + K x + sum_j B_j C_j(D) (x - x_0) = F(t),   x(0) = x_0,  M x'(0) = p_0
 *
 * of several masses with any dampers, by its poles and an integral around the cut. One oscillator has
 * more: all pasts, rows at equal steps, and twice the digits of its phase (exact_solution.h).
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
 *   motion   masses, a quadratic potential, dampings with alpha or a law; or matrices (structures.h);
 *            and dampers along linear elongations or by matrices (dampers.h), all held before t = 0
 *   x0, p0   d numbers each, finite; copied
 *   forcing, A, T, w  the same force on every unknown, as in fvi_linear_oscillator */
typedef struct {
    fvi_linear_motion motion;
    const double *x0, *p0;
    fvi_forcing forcing;
    double A, T, w;
} fvi_exact_problem;

typedef struct fvi_exact_motion fvi_exact_motion;

/* fvi_exact_motion_alloc -- find the poles.                               [(11.20)]
 *
 *   problem  is read here; what its system, laws and matrices point to must outlive the motion
 *   motion   output; free it with fvi_exact_motion_free
 *   error    output or NULL
 *
 * Cost: as fvi_poles_find, all poles. Returns FVI_SUCCESS; what fvi_response_alloc and fvi_poles_find
 * return; FVI_EFAULT if a pointer is NULL; FVI_EDOM if a number is not finite, or T negative, or K
 * is not positive semidefinite; FVI_EUNSUP for a potential that is not quadratic, a past other than
 * HELD where orders are above 1, or with an order below 1 Riemann and Liouville's, and where it is not
 * known how many poles there are; FVI_ESING if w is the frequency of a mode without damping;
 * FVI_EMAXITER if not all poles were found. On error *motion is untouched. */
int fvi_exact_motion_alloc(const fvi_exact_problem *problem, fvi_exact_motion **motion,
                           fvi_error *error);

/* fvi_exact_motion_at -- the solution at n times.                         [(11.20)]
 *
 *   t     n times, finite, >= 0. In increasing order they cost least
 *   x, v  outputs: n d numbers, those of a time after one another; one of them may be NULL
 *
 * Accuracy: 1e-12 of max |x| over [0, t], and of max |v|, while w t < 1e4 for every frequency
 * w (no proof; seen 1e-13); beyond that the poles' roundings, u w t, are added. A cosine in or near
 * resonance costs digits, because two large residues cancel: with delta = |s_k - i w| for the nearest
 * pole s_k the error is up to u (w/delta)^2 of max |x| (seen 0.1 of that). That is 1e-10 for a damping
 * ratio of 1/1000. At delta = 1e-8 w no digit is left. One oscillator loses none in fvi_exact_at.
 * Cost: for times from t to 4 t 63 factorisations of Z, at most twice with a force; then 130 d products
 * of complex numbers a time.
 * Returns FVI_SUCCESS; FVI_EFAULT; FVI_EDOM for a time; FVI_EOVRFLW if x or v is not finite;
 * FVI_ESING or FVI_ENOMEM of the factors. On error x and v are of no use. */
int fvi_exact_motion_at(fvi_exact_motion *motion, size_t n, const double *t, double *x,
                        double *v, fvi_error *error);

/* fvi_exact_outputs -- what is told at a time; x and v must be there, another is not computed if NULL.
 *
 *   x, v, a         d numbers each
 *   force, impulse  of all dampers one after another, as an observer has them (observer.h): of a mechanism
 *                   one along each elongation, and d of a matrix; else those of the damping, d numbers. The
 *                   impulse is the integral of the force from 0 on */
typedef struct {
    double *x, *v, *a, *force, *impulse;
} fvi_exact_outputs;

/* fvi_exact_motion_forces -- how many numbers a force has.
 *
 * fvi_exact_motion_forces_at -- places, velocities, accelerations and dampers at one time.   [(11.21)]
 *
 *   t      finite, >= 0. At t = 0 forces are their limits from above
 *   first  finite, > 0: where a force is infinite at t = 0, of an order above 1 and a velocity, or not known, of the
 *          order 2 beside other dampers, its mean over
 *          (0, first] stands in its place, and a is what it makes of the equation of motion
 *   out    outputs
 *
 * At the end T of a step of the force a is the limit from below. Accuracy: that of x of fvi_exact_motion_at times
 * the largest stiffness or |C(1/t)| that acts on it (no proof; seen 1e-13 of max |a|). Cost: three times a row of
 * fvi_exact_motion_at. Returns as fvi_exact_motion_at. */
size_t fvi_exact_motion_forces(const fvi_exact_motion *motion);
int fvi_exact_motion_forces_at(fvi_exact_motion *motion, double t, double first,
                               const fvi_exact_outputs *out, fvi_error *error);

/* fvi_exact_motion_free -- give everything back. NULL is allowed. */
void fvi_exact_motion_free(fvi_exact_motion *motion);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
