/* src/system/lagrangian_point.h -- The Lagrangian of a system, whatever it is made of. [H 29]
 *
 * Internal; nothing is checked. */
#ifndef FVI_LAGRANGIAN_POINT_H
#define FVI_LAGRANGIAN_POINT_H

#include <fvi/lagrangian.h>

/* fvi_lagrangian_of -- that of the system's mechanism; NULL: it has none of its own. */
const fvi_lagrangian *fvi_lagrangian_of(const fvi_system *system);

/* fvi_lagrangian_point -- as fvi_lagrangian's at; of masses and a potential where there is none.
 * Returns what the Lagrangian or the potential returned. */
int fvi_lagrangian_point(const fvi_system *system, double t, const double *x,
                         const double *v, double *L, double *Lx, double *Lv,
                         double *Lxx, double *Lxv, double *Lvv);

/* fvi_solve_matrix -- A y = r, A n by n, row by row; both are overwritten, r by y. `order` has room
 * for n. Returns FVI_SUCCESS, or FVI_ESING for a pivot that is zero or not a number. */
int fvi_solve_matrix(size_t n, double *A, double *r, size_t *order);

/* fvi_velocity_add -- v += change, d numbers, a step of Newton's method for a velocity.
 *
 *   last     in: the size of the change before, INFINITY at first; out: of this one
 *   is_done  output: nonzero if another step would change roundings alone
 *
 * Returns FVI_SUCCESS; FVI_EOVRFLW if the change is not finite. */
enum { FVI_VELOCITY_STEPS = 60 }; /* the most that are taken */
int fvi_velocity_add(size_t d, const double *change, double *v, double *last,
                     int *is_done);

/* fvi_inertia_at_rest -- which coordinates have no inertia whatever the velocity: their rows of L_vv are zeros at
 * v, and where all velocities are 1.
 *
 *   room      d * d + d numbers     is_zero  d numbers: nonzero for those
 *   vanishes  output: nonzero if a row is zero at v alone, as that of L = v^4 at rest
 *
 * Returns what the Lagrangian does. Cost: its second derivatives, twice where a row is zero. */
int fvi_inertia_at_rest(const fvi_system *s, double t, const double *x, const double *v,
                        double *room, size_t *is_zero, int *vanishes);

#endif
