/* src/frequency/exact_pole.h -- The complex pole of 1 / Q.                 [H 11]
 *
 *     Q(s) = m s^2 + c + rho s^beta,    s^beta by the principal logarithm,
 *
 * or rho C(s) of a law in place of its last term, exact_law.h.
 *
 * What exact_solution.c needs to know about it. */
#ifndef FVI_EXACT_POLE_H
#define FVI_EXACT_POLE_H

#include <fvi/damping_laws.h>

#include <complex.h>

/* fvi_pole -- a zero of Q in the upper half plane, as s + low: low is what
 * rounding s to double left over. A phase Im(s) t needs it when t is large. */
typedef struct {
    double m, c, rho, beta;
    const fvi_kernel *law; /* NULL: s^beta */
    double complex s, low;
} fvi_pole;

/* fvi_pole_find -- the zero of Q with 0 < arg s < pi.      [(11.4), (11.5)]
 *
 *   m, c, rho, beta  finite, m > 0, c >= 0, rho >= 0, 0 <= beta <= 2
 *   pole             output
 *
 * The angle by Newton on (11.5), then s by Newton. Relative accuracy of s + low:
 * a few u (|Re s| / |s| + u), u = 2^-53, so that exp((s + low) t) is good to a
 * few u whatever t; less where beta is near 1 and the damping nearly critical,
 * where two zeros meet on the negative axis.
 * Returns 1, or 0 if there is none (beta = 1 and rho >= 2 sqrt(m c); c = 0 and
 * beta >= 1; c = rho = 0); *pole then has m, c, rho, beta only. */
int fvi_pole_find(double m, double c, double rho, double beta, fvi_pole *pole);

/* fvi_pole_polish -- Newton's method from s, which has some digits, to s + low. */
void fvi_pole_polish(fvi_pole *pole);

/* fvi_pole_derivative -- Q'(s) at the pole. */
double complex fvi_pole_derivative(const fvi_pole *pole);

/* fvi_pole_from -- z - (s + low) without a cancellation. */
double complex fvi_pole_from(const fvi_pole *pole, double complex z);

/* fvi_pole_phase_error -- what the rounding of s + low, u^2 |s|, may have done to
 * e^{st} at a time t > 0. */
double fvi_pole_phase_error(const fvi_pole *pole, double t);

/* fvi_pole_quotient -- (Q(z) - Q(s)) / (z - s), also where z is close to s. */
double complex fvi_pole_quotient(const fvi_pole *pole, double complex z);

/* fvi_pole_exp -- exp(s t) for s = at + low and a time t + t_low, with the
 * products taken exactly. */
double complex fvi_pole_exp(double complex at, double complex low, double t,
                            double t_low);

/* fvi_complex_expm1 -- exp(z) - 1, also where z is small. */
double complex fvi_complex_expm1(double complex z);

#endif
