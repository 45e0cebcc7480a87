/* src/frequency/exact_pole.c -- Find the complex pole of 1 / Q.                 [H 11] */
#include "exact_pole.h"

#include "memory/double_double.h"
#include "kernel/kernel_terms.h"

#include <gsl/gsl_math.h>
#include <math.h>

double complex fvi_complex_expm1(double complex z)
{
    double x = creal(z), y = cimag(z), half = sin(y / 2);
    return expm1(x) * cos(y) - 2 * half * half + I * (exp(x) * sin(y));
}

/* log(1 + z), also for small z. */
static double complex complex_log1p(double complex z)
{
    double x = creal(z), y = cimag(z);
    if (fabs(x) > 0.5 || fabs(y) > 0.5)
        return clog(1 + z);
    return log1p(x * (2 + x) + y * y) / 2 + I * atan2(y, 1 + x);
}

/* (11.5): return the logarithm of rho c^(beta/2 - 1) m^(-beta/2) for the angle
 *
 *     theta = pi/2 + e (theta_max - pi/2),   e = 1 / (1 + e^-y),  f = 1 - e,
 *
 * its slope in y, the angle, and r, the modulus of the pole divided by sqrt(c/m). With g = min(beta, 2 - beta) the
 * sines need no difference of nearly equal numbers. "near" belongs to g theta, "far" to (2 - g) theta. */
static double log_damping(double beta, double y, double *slope, double *angle,
                          double *r)
{
    const double ratio = exp(-y), e = 1 / (1 + ratio), f = ratio * e;
    const double g = fmin(beta, 2 - beta), range = M_PI * g / (2 * (2 - g)),
                 eta = e * range, at_near = g * (M_PI_2 + eta),
                 at_far = M_PI_2 * g * f, near = sin(at_near),
                 far = sin(at_far), twice = sin(2 * eta);
    *angle = M_PI_2 + eta;
    *r = sqrt(beta <= 1 ? near / far : far / near);
    *slope = range * e * f
             * (2 * cos(2 * eta) / twice - g * g / 2 * cos(at_near) / near
                + (2 - g) * (2 - g) / 2 * cos(at_far) / far);
    return log(twice) - g / 2 * log(near) - (1 - g / 2) * log(far);
}

//> bisection
/* (11.6): the angle grows with the damping. Newton's method in y = ln(e / (1 - e)). If a step would leave the interval
 * that is known to contain the angle, the interval is halved instead. */
static double complex solve_for_angle(double m, double c, double rho, double beta)
{
    double wanted = log(rho) - (1 - beta / 2) * log(c) - beta / 2 * log(m);
    double low = -700, high = 700, y = 0, last, angle, r, slope;
    int tries = 0;
    do {
        double more = wanted - log_damping(beta, y, &slope, &angle, &r);
        *(more > 0 ? &low : &high) = last = y;
        y += more / slope;
        if (!(y > low && y < high))
            y = (low + high) / 2;
    } while (fabs(y - last) > 1e-7 * (1 + fabs(y)) && ++tries < 100);
    (void)log_damping(beta, y, &slope, &angle, &r); /* the next step is right to 1e-14 */
    return sqrt(c / m) * r * cexp(I * angle);
}
//< bisection

/* ---- Newton, with Q in twice the precision where it cancels ---- */

//> residual
/* Q(s) = M s^2 + K + rest, with the large terms to about 106 bits. Near beta = 0 the damping is a spring and belongs to
 * K, near beta = 2 it is a mass and belongs to M. Then `rest` is as small as the decay rate, and so is the error that
 * its rounding makes. */
static double complex residual(const fvi_pole *p, double complex s)
{
    dd M = { p->m, 0 }, K = { p->c, 0 };
    double complex rest, slope;
    if (p->law) {
        rest = p->rho * fvi_kernel_at(p->law, s, &slope);
    } else if (p->beta < 0.5) {
        K = two_sum(p->c, p->rho);
        rest = p->rho * fvi_complex_expm1(p->beta * clog(s));
    } else if (p->beta <= 1.5) {
        rest = p->rho * cexp(p->beta * clog(s));
    } else {
        M = two_sum(p->m, p->rho);
        rest = p->rho * (s * s) * fvi_complex_expm1((p->beta - 2) * clog(s));
    }
    double a = creal(s), b = cimag(s);
    dd aa = two_product(a, a), bb = two_product(b, b);
    dd d = two_sum(aa.hi, -bb.hi);
    d.lo += aa.lo - bb.lo;
    dd Md = times(M, d), sum = two_sum(Md.hi, K.hi);
    return (sum.hi + (sum.lo + Md.lo + K.lo + creal(rest)))
           + I * (2 * M.hi * a * b + cimag(rest));
}
//< residual

double complex fvi_pole_derivative(const fvi_pole *p)
{
    double complex s = p->s, slope = 0;
    if (p->law) {
        (void)fvi_kernel_at(p->law, s, &slope);
        return 2 * p->m * s + p->rho * slope / s;
    }
    const double complex power =
        p->beta == 1 ? 1 : cexp((p->beta - 1) * clog(s));
    return 2 * p->m * s + p->beta * p->rho * power;
}

/* The first guess is right to some digits, so a large step means that two zeros meet. There only the angle is needed,
 * and the guess has it. */
void fvi_pole_polish(fvi_pole *p)
{
    for (int i = 0; i < 8; i++) {
        double complex step = -residual(p, p->s) / fvi_pole_derivative(p);
        if (!(cabs(step) < 0.1 * cabs(p->s)))
            return;
        p->low = step;
        if (cabs(step) < 4 * GSL_DBL_EPSILON * cabs(p->s))
            return;
        p->s += step;
        p->low = 0;
    }
}

int fvi_pole_find(double m, double c, double rho, double beta, fvi_pole *pole)
{
    *pole = (fvi_pole){ .m = m, .c = c, .rho = rho, .beta = beta };
    if (rho == 0 || beta < 1e-100) { /* the angle may be below the smallest double */
        pole->s = I * (sqrt(c + rho) / sqrt(m));
    } else if (beta == 2) {
        pole->s = I * (sqrt(c) / sqrt(m + rho));
    } else if (c == 0) {
        if (beta >= 1)
            return 0;
        pole->s = cexp((log(rho / m) + I * M_PI) / (2 - beta));
    } else {
        if (beta == 1 && rho >= 2 * sqrt(m) * sqrt(c))
            return 0;
        pole->s = solve_for_angle(m, c, rho, beta);
    }
    if (pole->s == 0)
        return 0;
    fvi_pole_polish(pole);
    if (rho == 0 || beta == 2) /* nothing decays, so the real part must be exactly 0 */
        pole->low = I * cimag(pole->low);
    return 1;
}

/* ---- what is done with it ---- */

double complex fvi_pole_from(const fvi_pole *p, double complex z)
{
    return (z - p->s) - p->low;
}

double fvi_pole_phase_error(const fvi_pole *p, double t)
{
    const double u = GSL_DBL_EPSILON / 2;
    return u * u * cabs(p->s) * t * exp(creal(p->s + p->low) * t);
}

/* For a law: return the mean of Q' between s and z by Gauss-Legendre quadrature; far from s use Q itself. */
static double complex quotient_of_law(const fvi_pole *p, double complex z)
{
    static const double node[] = { 0.1834346424956498, 0.525532409916329,
                                   0.7966664774136267, 0.9602898564975363 },
                        weight[] = { 0.362683783378362, 0.3137066458778873,
                                     0.2223810344533745, 0.1012285362903763 };
    const double complex dz = fvi_pole_from(p, z);
    double complex sum = 0, slope;
    if (cabs(dz) > 0.05 * cabs(p->s))
        return (p->m * z * z + p->c + p->rho * fvi_kernel_at(p->law, z, &slope))
               / dz;
    for (int i = 0; i < 8; i++) {
        fvi_pole at = *p;
        at.s += (1 + (i % 2 ? node[i / 2] : -node[i / 2])) / 2 * dz;
        sum += weight[i / 2] / 2 * fvi_pole_derivative(&at);
    }
    return sum;
}

double complex fvi_pole_quotient(const fvi_pole *p, double complex z)
{
    if (p->law)
        return quotient_of_law(p, z);
    double complex dz = fvi_pole_from(p, z), s = p->s;
    double complex chord = p->beta / s; /* ((z/s)^beta - 1) / (z - s) */
    if (dz != 0)
        chord = fvi_complex_expm1(p->beta * complex_log1p(dz / s)) / dz;
    return p->m * (z + s) + p->rho * cexp(p->beta * clog(s)) * chord;
}

double complex fvi_pole_exp(double complex at, double complex low, double t,
                            double t_low)
{
    double decay = creal(at) * t + (creal(low) * t + creal(at) * t_low);
    dd angle = two_product(cimag(at), t);
    double rest = angle.lo + (cimag(low) * t + cimag(at) * t_low);
    const double complex turn = exp(decay) * cexp(I * angle.hi);
    return turn * (fabs(rest) < 1e-8 ? 1 + I * rest : cexp(I * rest));
}
