/* src/fvi/convergence.h -- A proved bound of the error of a run by fvi_fractional.    [H 20]
 *
 * The theorem of H 20 bounds |x_k - x(t_k)| by a constant times h. The functions here compute this constant from
 * numbers that describe the motion: bounds of its velocity and acceleration, of the spring and of the force. */
#ifndef FVI_CONVERGENCE_H
#define FVI_CONVERGENCE_H

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(default)

/* fvi_smoothness -- what the theorem has to know of a motion x on [0, T]. Let f = F/m and g = grad U/m, and let Omega
 * be the set of all points whose distance from the convex hull of the path is at most `room`.
 *
 *   alpha         0 <= alpha < 1
 *   kappa         in [0, 1]
 *   T             finite, > 0
 *   damping       r, the largest rho_i/m_i
 *   lipschitz     ell, a Lipschitz constant of g in Omega
 *   gradient      G, a bound of |g| in Omega
 *   variation     the total variation of f on [0, T], jumps included
 *   start         |v0|; fvi_error_bound_compute uses it if 2 alpha < 1, fvi_position_bound_compute always
 *   speed         V, a bound of |x'|
 *   acceleration  A, a bound of |x''|
 *   velocity_variation  W, the total variation of x' on [0, T]; only fvi_position_bound_compute uses it
 *   room          > 0; INFINITY if ell and G hold everywhere
 *
 * damping to velocity_variation are finite and >= 0, also where a function does not use them. The norm is Euclid's. */
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

/* fvi_error_bound -- the constants of the theorem. It holds for all steps below h. */
typedef struct {
    double C;      /* (20.5), or (20.14) */
    double lambda; /* (20.6) */
    double h;      /* the bounds hold for all steps below h; INFINITY: for every step */
} fvi_error_bound;

/* fvi_error_bound_compute -- compute the constants of the bounds                [(20.8)]
 *
 *     |x_k - x(t_k)|      <= 2 C h (e^(lambda t_k) - 1) / lambda,
 *     |p_k / m - v(t_k)|  <= 2 C h e^(lambda t_k).
 *
 * They hold for a run of fvi_fractional with h < bound->h whose past is CAPUTO, or HELD with 2 alpha <= 1 or v0 = 0. If
 * lambda = 0, (e^(lambda t) - 1) / lambda stands for t.
 *
 *   motion  see above
 *   bound   output: C, lambda, and h, below which the bounds hold, INFINITY if for every h
 *
 *     const fvi_smoothness spring = { .T = 1, .kappa = 0.5, .lipschitz = 1, .gradient = 2, .speed = 1,
 *         .acceleration = 1, .room = 1 };
 *     status = fvi_error_bound_compute(&spring, &bound);   // bound.C = 2, bound.lambda = 2
 *
 * Accuracy with u = 2^-53: C 16 u; lambda 2 u (2 + |log 4r| / (2 - 2 alpha)); h the error of C and T times the error of
 * lambda. Cost O(1). Returns FVI_SUCCESS; FVI_EFAULT if a pointer is NULL; FVI_EDOM if a number of motion is out of its
 * range; FVI_EOVRFLW if C or lambda is not finite, which happens near alpha = 1 if 4 r > 1. On error *bound is
 * untouched. If e^(lambda T) overflows and room is finite, bound->h is 0. */
int fvi_error_bound_compute(const fvi_smoothness *motion, fvi_error_bound *bound);

/* fvi_position_bound_compute -- compute the constants of a bound that allows an infinite acceleration
 *
 *     |x_k - x(t_k)|      <= 2 C h e^(lambda t_k)                      [(20.14)]
 *
 * for a run of fvi_fractional with h < bound->h whose past is CAPUTO or HELD. A held body with 2 alpha > 1 and v0 != 0
 * has no bound A of |x''|, but its W is finite. So this bound uses `velocity_variation` in the place of `acceleration`,
 * which may be 0. `start` is |v0| for every alpha, but 0 with CAPUTO and 2 alpha > 1. (20.15) bounds the momenta.
 *
 *     fvi_smoothness known = { .alpha = 0.75, .T = 1, .damping = 0.5, .lipschitz = 1,
 *         .gradient = 2, .start = 1, .speed = 1.5, .velocity_variation = 2, .room = 1 };
 *     status = fvi_position_bound_compute(&known, &bound);
 *
 * Arguments, accuracy, cost and errors are those of fvi_error_bound_compute. */
int fvi_position_bound_compute(const fvi_smoothness *motion, fvi_error_bound *bound);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
