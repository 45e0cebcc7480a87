/* src/fvi/paper/restricted_principle.h -- The action of two curves in continuous time, and its first
 * variation.                                                                                      [H 3] */
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
 * where s is the time from one end of the interval [a, b], and T = b - a. For x and its variation s = t - a;
 * for y and its variation s = b - t. If y has the same powers as x, it is x in reversed time,
 * y(t) = x(a + b - t).
 * Each exponent is 0 or at least 1, so that velocities are finite, and at most 150. The arrays belong to the
 * caller. */
typedef struct {
    size_t terms;
    const double *exponent, *coefficient;
} fvi_powers;

/* fvi_powers_derivative -- Return the derivative of order beta in s, term by term by (1.6).       [(3.2)]
 *
 *     sum_j coefficient[j] Gamma(e + 1) / Gamma(e + 1 - beta) s^(e - beta),     e = exponent[j].
 *
 * For beta = 0 this is f itself, for 0 < beta < 1 it is D_-^beta x or D_+^beta y (Riemann-Liouville), and for
 * beta = 1 it is f'(s), which is x' but -y'.
 *
 *   beta  0 <= beta <= 1
 *   s     s >= 0; at s = 0 a constant term gives infinity if 0 < beta < 1
 *
 *     const double one = 1;
 *     const fvi_powers line = { 1, &one, &one };                     // f(s) = s
 *     double d = fvi_powers_derivative(&line, 0.5, 4);              // 4/sqrt(pi)
 *
 * Nothing is checked. Cost: two gamma functions and a power for each term. The relative error of each term is
 * below (64 + e |ln s|) u, u = 2^-53. */
double fvi_powers_derivative(const fvi_powers *f, double beta, double s);

/* fvi_powers_reflect -- Rewrite a polynomial in s as a polynomial in T - s.                       [(3.4)]
 *
 *     sum_n c_n s^n = sum_n out_n (T - s)^n
 *
 * Restricted variations need this, because the same curve is then a variation of x and of y, and is read from
 * both ends.
 *
 *   count  number of coefficients, count >= 1
 *   T      finite
 *   c      count numbers
 *   out    output, count numbers, may be c
 *
 *     const double c[] = { 0, 1 };
 *     double out[2];
 *     status = fvi_powers_reflect(2, 3, c, out);       // s = 3 - (3 - s): out = 3, -1
 *
 * Cost O(count^2). Returns FVI_SUCCESS; FVI_EFAULT if c or out is NULL; FVI_EINVAL if count == 0; FVI_EDOM if
 * T is not finite. On error out is untouched. */
int fvi_powers_reflect(size_t count, double T, const double *c, double *out);

/* fvi_damped_powers -- Compute a curve that solves the equation of motion, as a sum of powers.    [(3.9)]
 *
 *     x'' + C x + R D_-^{2 alpha} x = 0,   x(0) = 0,  x'(0) = 1:
 *     sum_{j,k < order} (-1)^{j+k} binom(j+k, k) C^j R^k s^e / Gamma(e + 1),
 *     e = 1 + 2 j + (2 - 2 alpha) k
 *
 *   alpha     0 <= alpha < 1
 *   C, R      finite
 *   order     1 <= order <= 32; the terms fall like 1 / Gamma(e + 1)
 *   exponent, coefficient  outputs, order^2 numbers each, owned by the caller
 *
 *     double e[64], c[64];
 *     status = fvi_damped_powers(0.3, 1, 0.5, 8, e, c);
 *     const fvi_powers x = { 64, e, c };
 *
 * Cost O(order^2). Returns FVI_SUCCESS; FVI_EFAULT if an output is NULL; FVI_EINVAL if order is out of range;
 * FVI_EDOM if alpha, C or R is out of range. On error the outputs are untouched. */
int fvi_damped_powers(double alpha, double C, double R, size_t order,
                      double *exponent, double *coefficient);

/* fvi_action -- Compute the action of the doubled system in one dimension.                        [(3.3)]
 *
 *     S = int_a^b m x'^2/2 - U(x) + m y'^2/2 - U(y)
 *                 - D_-^alpha x rho D_+^alpha y  dt
 *
 * fvi_action_variation -- Compute its derivative at (x, y) along (xi, eta).                       [(3.5)]
 *
 *     delta S = int_a^b m x' xi' - U'(x) xi + m y' eta' - U'(y) eta
 *               - rho (D_-^alpha xi D_+^alpha y + D_-^alpha x D_+^alpha eta) dt
 *
 *   system   d == 1; its force is not read, because an action has no place for it
 *   alpha    0 <= alpha < 1
 *   T        b - a, finite, > 0
 *   x, xi    powers of t - a
 *   y, eta   powers of b - t
 *   S, dS    output, one number
 *
 *     double S;
 *     status = fvi_action(&system, 0.3, 1, &x, &x, &S);       // y is x in reversed time
 *
 * A body with a past has x - zeta and y - zeta' in the last term. To compute its action, add two values of
 * this function: the one for x and y without damping, and the contribution of the damping to the one for
 * x - zeta and y - zeta' without a potential. The variation is computed in the same way.    [(3.20), (3.21)]
 *
 * The integrand is taken as printed: no derivative is moved from one factor to the other, so the integration
 * by parts of the theory can be checked with these numbers. The integral is computed by the double exponential
 * rule on 193 nodes. The rule keeps the relative distance to both ends, so powers that are singular at an end
 * do not disturb it. With n the largest number of terms and e the largest exponent that matters, the error is
 * below (n + 300 + 2 e ln(e + 3)) u times the integral of the absolute values of all terms, u = 2^-53. If both
 * x and y have a constant term, it is 10^(-275 (1 - alpha)) of that integral more, which shows for
 * alpha > 0.94. Cost: 193 n powers for each curve.
 * Returns FVI_SUCCESS; what fvi_system_check returns; FVI_EFAULT if a pointer is NULL; FVI_EINVAL if d != 1;
 * FVI_EDOM if alpha, T, an exponent or a coefficient is out of range; FVI_ENOMEM; what the potential
 * returned. On error the output is untouched. */
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
