/* src/fvi/lagrangian.h -- Any Lagrangian, forces of velocity, constraints.      [H 29]
 *
 *     d/dt L_v - L_x = F(x, v, t) + ...,     c(x, t) = 0
 *
 * A cart with a pendulum, a double pendulum, a linkage, van der Pol's oscillator: what a mass and a
 * potential cannot say. All derivatives are the caller's, or those of texts (parse.h), which
 * are exact.
 *
 *     const fvi_lagrangian L = { pendulum_on_a_cart, NULL };
 *     const fvi_mechanism mechanism = { .lagrangian = &L };
 *     system.mechanism = &mechanism; */
#ifndef FVI_LAGRANGIAN_H
#define FVI_LAGRANGIAN_H

#include "system.h"

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(default)

/* fvi_lagrangian -- L(x, v, t) and all its derivatives at one point.
 *
 *   at      writes what is not NULL:
 *             L           one number
 *             Lx, Lv      d numbers each
 *             Lxx, Lvv    d * d numbers each, row by row
 *             Lxv         d * d numbers: at [i * d + j] the derivative by x_i and v_j
 *   params  handed to it, owned by the caller, may be NULL
 *
 * Returns 0, or a code as the functions of a potential do (system.h). */
typedef struct fvi_lagrangian {
    int (*at)(double t, size_t d, const double *x, const double *v,
              void *params, double *L, double *Lx, double *Lv, double *Lxx,
              double *Lxv, double *Lvv);
    void *params;
} fvi_lagrangian;

/* fvi_state_force -- F(x, v, t), d numbers: friction, drive, negative damping, in the sense of
 * Lagrange and d'Alembert.
 *
 *   at  writes F, and where they are not NULL Fx and Fv: at [i * d + j] the derivative of F_i
 *       by x_j, by v_j */
typedef struct fvi_state_force {
    int (*at)(double t, size_t d, const double *x, const double *v,
              void *params, double *F, double *Fx, double *Fv);
    void *params;
} fvi_state_force;

/* fvi_constraints -- c(x, t) = 0, `count` equations.
 *
 *   name      for messages, count texts; or NULL: 1, 2, ...
 *   imposed   NULL; or for each the coordinate, from 1, that it prescribes, c = x_i - u(t), or 0: then
 *             minus its multiplier is the reaction
 *   value     writes c, count numbers
 *   gradient  writes C, count * d numbers, row by row; and where it is not NULL ct, the count
 *             derivatives by t
 *   hessian   adds sum_i factor[i] Hess c_i to H, d * d numbers; NULL where no method with stages
 *             asks for it
 *   params    as above */
typedef struct fvi_constraints {
    size_t count;
    const char *const *name;
    const size_t *imposed;
    int (*value)(double t, size_t d, const double *x, void *params, double *c);
    int (*gradient)(double t, size_t d, const double *x, void *params,
                    double *C, double *ct);
    int (*hessian)(double t, size_t d, const double *x, const double *factor,
                   void *params, double *H);
    void *params;
} fvi_constraints;

/* fvi_momentum_of_velocity -- p = L_v(x, v, t): the start p0 of a velocity v0.
 *
 *   system   whatever it is: without a Lagrangian p = m v. Not with matrices (FVI_EUNSUP)
 *   t, x, v  d numbers each
 *   p        output, d numbers
 *
 * Returns FVI_SUCCESS; FVI_EUNSUP; FVI_ENOMEM; what the Lagrangian returned. */
int fvi_momentum_of_velocity(const fvi_system *system, double t,
                             const double *x, const double *v, double *p);

/* fvi_velocity_of_momentum -- v with L_v(x, v, t) = p, by Newton's method.
 *
 *   v  in: a guess; out: the velocity. That of a coordinate without inertia stays the guess: one
 *      whose row and column of L_vv are zeros there and where all velocities are 1
 *
 * Returns as above; FVI_ESING if L_vv is singular in another way; FVI_EMAXITER. */
int fvi_velocity_of_momentum(const fvi_system *system, double t,
                             const double *x, const double *p, double *v);

/* fvi_energy_at -- E = v . L_v - L at the time t; without a Lagrangian fvi_energy.   [(29.9)]
 *
 *   x, p  d numbers each     E  output, one number
 *
 * Returns as fvi_energy and fvi_velocity_of_momentum; FVI_EOVRFLW if E is not finite. */
int fvi_energy_at(const fvi_system *system, double t, const double *x,
                  const double *p, double *E);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
