/* src/frequency/exact_pole.h -- Find the complex pole of 1 / Q.                 [H 11]
 *
 *     Q(s) = m s^2 + c + rho s^beta,    s^beta by the principal logarithm.
 *
 * With a law the last term is rho C(s); see exact_law.h. exact_solution.c needs these functions. */
#ifndef FVI_EXACT_POLE_H
#define FVI_EXACT_POLE_H

#include <fvi/damping_laws.h>

#include <complex.h>

/* fvi_pole -- A zero of Q in the upper half plane, s + low. low is the rounding error of s. A phase Im(s) t needs it
 * for large t. */
typedef struct {
    double m, c, rho, beta;
    const fvi_kernel *law; /* NULL: s^beta */
    double complex s, low;
} fvi_pole;

/* fvi_pole_find -- Find the zero of Q with 0 < arg s < pi.      [(11.4), (11.5)]
 *
 *   m, c, rho, beta  finite, m > 0, c >= 0, rho >= 0, 0 <= beta <= 2
 *   pole             output
 *
 * The angle is found by Newton's method on (11.5), then s by Newton's method. Relative accuracy of s + low: a few u
 * (|Re s| / |s| + u), u = 2^-53, so exp((s + low) t) is right to a few u for every t. The accuracy is less for beta
 * near 1 and nearly critical damping, where two zeros meet on the negative axis.
 * Return 1, or 0 if there is no zero (beta = 1 and rho >= 2 sqrt(m c); c = 0 and beta >= 1; c = rho = 0). In the second
 * case only m, c, rho and beta of *pole are set. */
int fvi_pole_find(double m, double c, double rho, double beta, fvi_pole *pole);

/* fvi_pole_polish -- Improve s, which is right to some digits, to s + low by Newton's method. */
void fvi_pole_polish(fvi_pole *pole);

/* fvi_pole_derivative -- Return Q'(s) at the pole. */
double complex fvi_pole_derivative(const fvi_pole *pole);

/* fvi_pole_from -- Return z - (s + low) without cancellation. */
double complex fvi_pole_from(const fvi_pole *pole, double complex z);

/* fvi_pole_phase_error -- Return the error of e^{st} at the time t > 0 that the rounding of s + low, u^2 |s|, can
 * cause. */
double fvi_pole_phase_error(const fvi_pole *pole, double t);

/* fvi_pole_quotient -- Return (Q(z) - Q(s)) / (z - s), also for z near s. */
double complex fvi_pole_quotient(const fvi_pole *pole, double complex z);

/* fvi_pole_exp -- Return exp(s t) for s = at + low and the time t + t_low, with exact products. */
double complex fvi_pole_exp(double complex at, double complex low, double t,
                            double t_low);

/* fvi_complex_expm1 -- Return exp(z) - 1, also for small z. */
double complex fvi_complex_expm1(double complex z);

#endif
