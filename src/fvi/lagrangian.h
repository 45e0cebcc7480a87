/* src/fvi/lagrangian.h -- Systems with any Lagrangian, with forces that depend on velocity, and with
 * constraints.                                                                        [H 29]
 *
 *     d/dt L_v - L_x = F(x, v, t) + ...,     c(x, t) = 0
 *
 * Some systems are more than masses and a potential: a cart with a pendulum, a double pendulum, a linkage, van
 * der Pol's oscillator. The caller gives L, F and c with their derivatives; or parse.h makes them of texts, with
 * exact derivatives.
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
 *   at      writes every output that is not NULL:
 *             L           one number
 *             Lx, Lv      d numbers each
 *             Lxx, Lvv    d * d numbers each, row by row
 *             Lxv         d * d numbers: at [i * d + j] the derivative by x_i and v_j
 *           Returns 0, or a code as the functions of a potential do (system.h)
 *   params  handed to `at`, owned by the caller, may be NULL
 *
 * For example, a body of mass 1 on a spring of stiffness 1 has L = (v^2 - x^2) / 2, Lx = -x, Lv = v, Lxx = -1,
 * Lxv = 0 and Lvv = 1. */
typedef struct fvi_lagrangian {
    int (*at)(double t, size_t d, const double *x, const double *v,
              void *params, double *L, double *Lx, double *Lv, double *Lxx,
              double *Lxv, double *Lvv);
    void *params;
} fvi_lagrangian;

/* fvi_state_force -- a force F(x, v, t) of d numbers, such as friction, a drive, or negative damping. It acts in
 * the sense of Lagrange and d'Alembert: as a generalised force beside the derivatives of L.
 *
 *   at      writes F; writes Fx and Fv, d * d numbers each, where they are not NULL: at [i * d + j] the derivative
 *           of F_i by x_j, or by v_j. Returns 0, or a code as the functions of a potential do (system.h)
 *   params  handed to `at`, owned by the caller, may be NULL */
typedef struct fvi_state_force {
    int (*at)(double t, size_t d, const double *x, const double *v,
              void *params, double *F, double *Fx, double *Fv);
    void *params;
} fvi_state_force;

/* fvi_constraints -- `count` equations c(x, t) = 0.
 *
 *   name      count texts for messages, owned by the caller; NULL: the names are 1, 2, ...
 *   imposed   NULL; or count numbers, one for each constraint. The number i > 0 says that the constraint is
 *             c = x_i - u(t), with coordinates counted from 1: it prescribes coordinate i. Then minus its
 *             multiplier is the reaction. The number 0 stands for a constraint of another kind
 *   value     writes c, count numbers
 *   gradient  writes C, the derivatives of c by x: count * d numbers, row by row. Writes ct, the count derivatives
 *             by t, where ct is not NULL
 *   hessian   adds sum_i factor[i] Hess c_i to the d * d numbers H, row by row. May be NULL for runs of
 *             fvi_cq2_midpoint, which does not call it; all other methods, and derivatives (adjoint.h), need it
 *   params    handed to the functions, owned by the caller, may be NULL
 *
 * The functions return 0, or a code as those of a potential do (system.h). */
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

/* fvi_momentum_of_velocity -- Compute p = L_v(x, v, t), for example the initial momentum p0 of a velocity v0.
 *
 *   system   with a Lagrangian or without one: without one, p = m v. It must have no matrices
 *   t        time
 *   x, v     position and velocity, d numbers each
 *   p        output, d numbers
 *
 *     const double x0[] = { 0, 1 }, v0[] = { 0.5, 0 };
 *     double p0[2];
 *     status = fvi_momentum_of_velocity(&system, 0, x0, v0, p0);
 *
 * Nothing is checked. Cost: L_v once. Returns FVI_SUCCESS; FVI_EUNSUP if the system has matrices; what the
 * Lagrangian returned. No handler is called. */
int fvi_momentum_of_velocity(const fvi_system *system, double t,
                             const double *x, const double *v, double *p);

/* fvi_velocity_of_momentum -- Solve L_v(x, v, t) = p for the velocity v, by Newton's method.
 *
 *   system, t  as above
 *   x, p       position and momentum, d numbers each
 *   v          in: a guess, d numbers; out: the velocity. A coordinate without inertia keeps the velocity of the
 *              guess. A coordinate has no inertia if its mass is 0, or if its row and column of L_vv are zero both
 *              at v and at the velocity (1, ..., 1)
 *
 * If a row of L_vv is zero at the guess but not at (1, ..., 1), as that of L = v^4 at v = 0, Newton's method starts
 * from (1, ..., 1).
 * Accuracy: to rounding errors. Cost O(d^3) for each of at most 60 iterations; two suffice if L is quadratic in v.
 * Without a Lagrangian v = p / m, O(d).
 * Returns FVI_SUCCESS; FVI_EUNSUP if the system has matrices; FVI_ESING if L_vv is singular in any other way;
 * FVI_EMAXITER after 60 iterations; FVI_EOVRFLW if a velocity is not finite; FVI_ENOMEM; what the Lagrangian
 * returned. No handler is called. After an error v holds no result. */
int fvi_velocity_of_momentum(const fvi_system *system, double t,
                             const double *x, const double *p, double *v);

/* fvi_check_start_velocity -- Check that each velocity that was given has an effect. The velocity of a coordinate
 * without inertia follows from the forces, so it must be given as 0. Where constraints rule over velocities, and where
 * L_vv v = p cannot be solved, the start of a run checks more, and this function nothing.
 *
 *   system       of d coordinates, without matrices
 *   x0, v0       the start, d numbers each
 *   p0           the momenta of v0, from fvi_momentum_of_velocity
 *
 *     status = fvi_momentum_of_velocity(&system, 0, x0, v0, p0);
 *     if (!status)
 *         status = fvi_check_start_velocity(&system, x0, v0, p0, &error);
 *
 * Cost: fvi_velocity_of_momentum once. fvi_parse_problem calls it.
 * Returns FVI_SUCCESS; FVI_EINVAL with the field "v0"; FVI_ENOMEM. */
int fvi_check_start_velocity(const fvi_system *system, const double *x0, const double *v0, const double *p0,
                             fvi_error *error);

/* fvi_energy_at -- Compute the energy E = v . L_v - L at the time t.                          [(29.9)]
 *
 *   t     time
 *   x, p  position and momentum, d numbers each
 *   E     output, one number
 *
 *     double E;
 *     status = fvi_energy_at(&system, s->t, s->x, s->p, &E);      // of a stepper
 *
 * The velocity comes from fvi_velocity_of_momentum, with the guess 0. Without a Lagrangian the function calls
 * fvi_energy (system.h).
 * Returns as fvi_velocity_of_momentum, or as fvi_energy; FVI_EOVRFLW if E is not finite. On error E is
 * untouched. */
int fvi_energy_at(const fvi_system *system, double t, const double *x,
                  const double *p, double *E);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
