/* src/fvi/paper/restricted_principle.h -- The action of two curves and its first
 * variation, in continuous time.                                 [H 3] */
#ifndef FVI_RESTRICTED_PRINCIPLE_H
#define FVI_RESTRICTED_PRINCIPLE_H

#include <fvi/system.h>

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(default)

/* fvi_powers -- a curve as a sum of powers,
 *
 *     f(s) = sum_{j=0}^{terms-1} coefficient[j] s^exponent[j],     0 <= s <= T,
 *
 * s being the time from one end of the interval [a, b], b - a = T: s = t - a
 * for x and its variation, s = b - t for y and its variation. The same powers
 * read from the other end are the curve in reversed time, y(t) = x(a + b - t).
 * Exponents are 0 or in [1, 150]: then velocities are finite. The arrays
 * belong to the caller. */
typedef struct {
    size_t terms;
    const double *exponent, *coefficient;
} fvi_powers;

/* fvi_powers_derivative -- the derivative of order beta in s, term by term
 * with (1.6).                                                       [(3.2)]
 *
 *     sum_j coefficient[j] Gamma(e + 1) / Gamma(e + 1 - beta) s^(e - beta),
 *
 * e = exponent[j]: f itself for beta = 0, D_-^beta x or D_+^beta y
 * (Riemann-Liouville) for 0 < beta < 1, f'(s) for beta = 1: x', but -y'.
 *
 *   beta  0 <= beta <= 1
 *   s     s >= 0; at s = 0 a constant term gives infinity if 0 < beta < 1
 *
 * Nothing is checked. Cost: two gammas and a power a term. The relative error
 * of each term is below (64 + e |ln s|) u, u = 2^-53. */
double fvi_powers_derivative(const fvi_powers *f, double beta, double s);

/* fvi_powers_reflect -- a polynomial read from the other end.       [(3.4)]
 *
 *     sum_n c_n s^n = sum_n out_n (T - s)^n
 *
 * for restricted variations, which need one curve from both ends.
 *
 *   count  number of coefficients, count >= 1
 *   T      finite
 *   c      count numbers;  out  output, count numbers, may be c
 *
 * Cost O(count^2). Returns FVI_SUCCESS; FVI_EFAULT if c or out is NULL;
 * FVI_EINVAL if count == 0; FVI_EDOM if T is not finite. On error out is
 * untouched. */
int fvi_powers_reflect(size_t count, double T, const double *c, double *out);

/* fvi_damped_powers -- a curve that solves the equation.            [(3.9)]
 *
 *     x'' + C x + R D_-^{2 alpha} x = 0,   x(0) = 0,  x'(0) = 1:
 *     sum_{j,k < order} (-1)^{j+k} binom(j+k, k) C^j R^k s^e / Gamma(e + 1),
 *     e = 1 + 2 j + (2 - 2 alpha) k
 *
 *   alpha     0 <= alpha < 1
 *   C, R      finite
 *   order     1 <= order <= 32; terms fall like 1 / Gamma(e + 1)
 *   exponent, coefficient  outputs, order^2 numbers each
 *
 * Cost O(order^2). Returns FVI_SUCCESS; FVI_EFAULT if an output is NULL;
 * FVI_EINVAL if order is out of range; FVI_EDOM if alpha, C or R is. On error
 * the outputs are untouched. */
int fvi_damped_powers(double alpha, double C, double R, size_t order,
                      double *exponent, double *coefficient);

/* fvi_action -- the action of the doubled system, d = 1.            [(3.3)]
 *
 *     S = int_a^b m x'^2/2 - U(x) + m y'^2/2 - U(y)
 *                 - D_-^alpha x rho D_+^alpha y  dt
 *
 * fvi_action_variation -- its derivative at (x, y) along (xi, eta).  [(3.5)]
 *
 *     delta S = int_a^b m x' xi' - U'(x) xi + m y' eta' - U'(y) eta
 *               - rho (D_-^alpha xi D_+^alpha y + D_-^alpha x D_+^alpha eta) dt
 *
 *   system   d == 1; its force takes no part in an action
 *   alpha    0 <= alpha < 1
 *   T        b - a, finite, > 0
 *   x, xi    powers of t - a;    y, eta    powers of b - t
 *   S, dS    output, one number
 *
 * A body with a past has x - zeta and y - zeta' in the last term. Its action is
 * S of x, y without damping, and what the damping adds to that of x - zeta,
 * y - zeta' without potential; its variation likewise.        [(3.20), (3.21)]
 *
 * No derivative is moved from one factor to another, so that the integration by
 * parts of the theory can be seen to hold. The integral is taken by the double
 * exponential rule on 193 nodes, which keeps the relative distance to both ends
 * and so does not mind their powers. With n the largest number of terms and e
 * the largest exponent that matters, the error is below
 * (n + 300 + 2 e ln(e + 3)) u times the integral of the sizes of all terms,
 * u = 2^-53; where x and y both have constant terms, 10^(-275 (1 - alpha)) of
 * it more, which is felt for alpha > 0.94. Cost: 193 n powers for each curve.
 * Returns FVI_SUCCESS; what fvi_system_check returns; FVI_EFAULT if a pointer
 * is NULL; FVI_EINVAL if d != 1; FVI_EDOM if alpha, T, an exponent or a
 * coefficient is out of range; FVI_ENOMEM; what the potential returned. On error the
 * output is untouched. */
int fvi_action(const fvi_system *system, double alpha, double T,
               const fvi_powers *x, const fvi_powers *y, double *S);
int fvi_action_variation(const fvi_system *system, double alpha, double T,
                         const fvi_powers *x, const fvi_powers *y,
                         const fvi_powers *xi, const fvi_powers *eta,
                         double *dS);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
