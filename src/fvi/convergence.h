/* src/fvi/convergence.h -- How far from the motion a run can be.    [H 20] */
#ifndef FVI_CONVERGENCE_H
#define FVI_CONVERGENCE_H

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(default)

/* fvi_smoothness -- what the theorem of H 20 has to know of a motion x on [0, T].
 * With f = F/m, g = grad U/m, and Omega the points that are at most `room` away from the
 * convex hull of the path:
 *
 *   alpha         0 <= alpha < 1
 *   kappa         in [0, 1]
 *   T             finite, > 0
 *   damping       r, the largest rho_i/m_i
 *   lipschitz     ell, a Lipschitz constant of g in Omega
 *   gradient      G, a bound of |g| in Omega
 *   variation     the total variation of f on [0, T], jumps included
 *   start         |v0|, used if 2 alpha < 1, and by fvi_position_bound_compute
 *   speed         V, a bound of |x'|
 *   acceleration  A, a bound of |x''|
 *   velocity_variation  W, the total variation of x' on [0, T]; only
 *                 fvi_position_bound_compute uses it
 *   room          > 0; GSL_POSINF if ell and G hold everywhere
 *
 * All others are finite and >= 0. The norm is Euclid's. */
//> motion
typedef struct {
    double alpha, kappa, T;
    double damping;
    double lipschitz, gradient;
    double variation;
    double start, speed, acceleration, velocity_variation;
    double room;
} fvi_smoothness;
//< motion

/* fvi_error_bound -- the constants of the theorem. */
typedef struct {
    double C;      /* (20.5), or (20.14) */
    double lambda; /* (20.6) */
    double h;      /* it speaks of all steps below this, GSL_POSINF if of all */
} fvi_error_bound;

/* fvi_error_bound_compute -- the constants of the bound                [(20.8)]
 *
 *     |x_k - x(t_k)|      <= 2 C h (e^(lambda t_k) - 1) / lambda,
 *     |p_k / m - v(t_k)|  <= 2 C h e^(lambda t_k),
 *
 * for a run of fvi_fractional with h < bound->h and Caputo's past, or held with
 * 2 alpha <= 1 or v0 = 0. If lambda = 0, (e^(lambda t) - 1) / lambda is t.
 *
 * Accuracy: C 16 u; lambda 2 u (2 + |log 4r| / (2 - 2 alpha)), and T lambda times as
 * much for h, which has 16 u from C. Cost O(1). Returns FVI_SUCCESS; FVI_EFAULT if a
 * pointer is NULL; FVI_EDOM if a number of motion is out of its range;
 * FVI_EOVRFLW if C or lambda is not finite, as it happens near alpha = 1 if 4 r > 1.
 * On error *bound is untouched. bound->h is 0 if e^(lambda T) overflows and room is
 * finite. */
int fvi_error_bound_compute(const fvi_smoothness *motion, fvi_error_bound *bound);

/* fvi_position_bound_compute -- the bound for a velocity that may have an infinite slope
 *
 *     |x_k - x(t_k)|      <= 2 C h e^(lambda t_k)                      [(20.14)]
 *
 * for a run of fvi_fractional with h < bound->h and Caputo's past, or held. A held body with
 * 2 alpha > 1 and v0 != 0 has no bound A of |x''|, but a finite W: the bound has
 * `velocity_variation` in the place of `acceleration`, which may be 0. `start` is |v0|,
 * for every alpha; with Caputo's past and 2 alpha > 1 it is 0. (20.15) bounds the momenta.
 *
 *     fvi_smoothness known = { .alpha = 0.75, .T = 1, .damping = 0.5, .lipschitz = 1,
 *         .gradient = 2, .start = 1, .speed = 1.5, .velocity_variation = 2, .room = 1 };
 *     status = fvi_position_bound_compute(&known, &bound);
 *
 * Accuracy, cost and errors are those of fvi_error_bound_compute. */
int fvi_position_bound_compute(const fvi_smoothness *motion, fvi_error_bound *bound);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
