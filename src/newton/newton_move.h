/* src/newton/newton_move.h -- Take one step of Newton's method for one coordinate.    [H 2] */
#ifndef FVI_NEWTON_MOVE_H
#define FVI_NEWTON_MOVE_H

#include <gsl/gsl_machine.h>
#include <math.h>

/* The result of a Newton step: the new d, the size |step|, the Jacobian J, and whether the equation is solved. */
typedef struct {
    double d, size, J;
    int is_enough;
} fvi_newton_move;

/* fvi_newton_move_of -- Take one step of Newton's method for A d + s U'(x + theta d) = r. The stopping rule is that of
 * newton.c: the residual is a rounding error, or the step is no longer half of the step before.
 *
 *   z     x + theta d
 *   g, H  U'(z) and U''(z)
 *   last  the size of the step before; infinite before the first step
 *
 * The function is always inlined. newton_of_one_equation uses it for one coordinate and newton_lanes.c for a vector of
 * coordinates, with the same digits. */
__attribute__((always_inline)) static inline fvi_newton_move
fvi_newton_move_of(double A, double s, double theta, double r, double z, double g, double H,
                   double d, double last)
{
    const double Ad = A * d, sg = s * g, e = r - Ad - sg, J = s * theta * H + A,
                 terms = fabs(r) + fabs(Ad) + fabs(sg),
                 moves = fabs(s) * (fabs(H) * (fabs(z) + fabs(d))),
                 allowed = 2 * GSL_DBL_EPSILON * (terms + moves) + GSL_DBL_MIN,
                 step = e / J, size = fabs(step), to = d + step;
    const int is_noise = (fabs(e) <= allowed) & (allowed < INFINITY),
              is_stuck = (size >= last / 2) & (size <= GSL_SQRT_DBL_EPSILON * fabs(to));
    return (fvi_newton_move){ to, size, J, is_noise | is_stuck };
}

#endif
