/* src/system/lagrangian_point.h -- Evaluate the Lagrangian of any system, and solve for a velocity.  [H 29]
 *
 * This header is internal. Its functions do not check their arguments. */
#ifndef FVI_LAGRANGIAN_POINT_H
#define FVI_LAGRANGIAN_POINT_H

#include <fvi/lagrangian.h>

/* fvi_lagrangian_of -- Return the Lagrangian of the system's mechanism, or NULL if the system has only
 * masses and a potential. */
const fvi_lagrangian *fvi_lagrangian_of(const fvi_system *system);

/* fvi_lagrangian_point -- Evaluate the Lagrangian and its derivatives at (x, v, t). The outputs are the outputs of `at`
 * in fvi_lagrangian (lagrangian.h). A system without a Lagrangian of its own has L = sum_i m_i v_i^2 / 2 - U(x).
 *
 * Return FVI_SUCCESS, or the code that the Lagrangian or the potential returned. */
int fvi_lagrangian_point(const fvi_system *system, double t, const double *x,
                         const double *v, double *L, double *Lx, double *Lv,
                         double *Lxx, double *Lxv, double *Lvv);

/* fvi_solve_matrix -- Solve A y = r, and write y to r.
 *
 *   A      n * n numbers, row by row; overwritten
 *   order  workspace for n numbers
 *
 * Return FVI_SUCCESS, or FVI_ESING if a pivot is zero or NaN. */
int fvi_solve_matrix(size_t n, double *A, double *r, size_t *order);

/* fvi_velocity_add -- Compute v += change, d numbers each, as one step of Newton's method for a velocity.
 *
 *   last     input: sum_i |change_i| of the step before, INFINITY before the first step; output: this sum of this step
 *   is_done  output: nonzero if another step would change only rounding errors
 *
 * Return FVI_SUCCESS, or FVI_EOVRFLW if the change is not finite. */
enum { FVI_VELOCITY_STEPS = 60 }; /* largest number of Newton steps */
int fvi_velocity_add(size_t d, const double *change, double *v, double *last,
                     int *is_done);

/* fvi_divide_by_mass -- Compute v = M^-1 p for a system of masses or of matrices. v and p may be the same d numbers.
 * Return FVI_SUCCESS, or the code of factorise or solve of the matrices. */
int fvi_divide_by_mass(const fvi_system *system, const double *p, double *v);

/* fvi_inertia_at_rest -- Find the coordinates that have no inertia at any velocity. A coordinate has no inertia if its
 * row and its column of L_vv are zero. The function tests this at v and, because an inertia may vanish at one velocity
 * only, also where all velocities are 1.
 *
 *   room      workspace for d * d + d numbers
 *   is_zero   output, d numbers: 1 for a coordinate without inertia, else 0
 *   vanishes  output: nonzero if the inertia of a coordinate is zero at v but not where all velocities are 1. For
 *             example, this happens for L = v^4 at rest
 *
 * Return FVI_SUCCESS, or the code that the Lagrangian returned. Cost: the second derivatives of L once, and twice if a
 * row is zero at v. */
int fvi_inertia_at_rest(const fvi_system *s, double t, const double *x, const double *v,
                        double *room, size_t *is_zero, int *vanishes);

#endif
