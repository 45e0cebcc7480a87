/* src/kernel/kernel_classes.c -- The kinds of kernels: range checks, symbols, growth.   [H 26] */
#include "kernel_classes.h"

#include "kernel_general.h"
#include "system/fail.h"

#include <complex.h>
#include <gsl/gsl_math.h>
#include <math.h>

/* ---- range checks ---- */

static int check_order(const fvi_kernel_term *t)
{
    if (!(t->alpha >= 0 && t->alpha <= 1))
        FVI_FAIL("alpha of a law must be in [0, 1]", FVI_EDOM);
    return FVI_SUCCESS;
}

static int check_time(const fvi_kernel_term *t)
{
    if (!(isfinite(t->time) && t->time >= 0))
        FVI_FAIL("the time of a law must be finite and not negative", FVI_EDOM);
    return FVI_SUCCESS;
}

static int check_order_and_time(const fvi_kernel_term *t)
{
    const int status = check_order(t);
    return status ? status : check_time(t);
}

static int check_range(const fvi_kernel_term *t)
{
    const int status = check_order(t);
    if (!status && !(t->end > t->alpha && t->end <= 1))
        FVI_FAIL("the end of a range of orders must be in (alpha, 1]", FVI_EDOM);
    return status;
}

static int check_pair(const fvi_kernel_term *t)
{
    const int status = check_order_and_time(t);
    if (!status && !(t->end >= 0 && t->end <= t->alpha))
        FVI_FAIL("the end of two springpots must be in [0, alpha]", FVI_EDOM);
    return status;
}

/* ---- symbols ---- */

/* Return s^{2 a} = e^{2 a ln s}. Its angle is 2 a times the angle of s, so the result is exactly
 * real if the angle is 0. */
static double complex power_at(double a, double modulus, double angle)
{
    const double size = pow(modulus, 2 * a);
    return size * cos(2 * a * angle) + I * size * sin(2 * a * angle);
}

static double complex power_symbol(const fvi_kernel_term *t, double modulus,
                                   double angle, double complex *slope)
{
    const double complex q = power_at(t->alpha, modulus, angle);
    *slope = 2 * t->alpha * q;
    return q;
}

//> symbol
/* Return s^{2 a} / (1 + time s^{2 b}), and write s times its derivative to *slope. */
static double complex fraction_at(double a, double b, double time,
                                  double modulus, double angle,
                                  double complex *slope)
{
    const double complex q = power_at(a, modulus, angle),
                         below = b == a ? q : power_at(b, modulus, angle),
                         part = 1 + time * below;
    *slope = (2 * a + 2 * (a - b) * time * below) * q / (part * part);
    return q / part;
}
//< symbol

double complex fvi_kernel_simple_at(const fvi_kernel_simple *t, double modulus,
                                    double angle)
{
    double complex slope;
    return t->rho
           * fraction_at(t->alpha, t->below, t->time, modulus, angle, &slope);
}

static double complex zener_symbol(const fvi_kernel_term *t, double modulus,
                                   double angle, double complex *slope)
{
    return fraction_at(t->alpha, t->alpha, t->time, modulus, angle, slope);
}

static double complex maxwell_symbol(const fvi_kernel_term *t, double modulus,
                                     double angle, double complex *slope)
{
    return fraction_at(0.5, 0.5, t->time, modulus, angle, slope);
}

static double complex maxwell2_symbol(const fvi_kernel_term *t, double modulus,
                                      double angle, double complex *slope)
{
    return fraction_at(t->alpha, t->alpha - t->end, t->time, modulus, angle,
                       slope);
}

/* Integrate e^{2 a L}, L = ln s, over the range of orders, and write the derivative by L to *slope. */
static double complex range_symbol(const fvi_kernel_term *t, double modulus,
                                   double angle, double complex *slope)
{
    const double middle = (t->alpha + t->end) / 2, width = t->end - t->alpha;
    const double complex L = log(modulus) + I * angle,
                         q = power_at(middle, modulus, angle);
    if (L == 0) {
        *slope = 2 * middle * width;
        return width;
    }
    const double complex ratio = csinh(width * L) / L;
    *slope = q * (2 * middle * ratio + (width * ccosh(width * L) - ratio) / L);
    return q * ratio;
}

static double complex davidson_symbol(const fvi_kernel_term *t, double modulus,
                                      double angle, double complex *slope)
{
    const double complex part =
        1 + t->time * modulus * (cos(angle) + I * sin(angle));
    const double complex C =
        power_at(t->alpha, modulus, angle)
        * power_at(-t->alpha, cabs(part), carg(part));
    *slope = 2 * t->alpha * C / part;
    return C;
}

/* Return the value of the caller's function, or NaN if the function writes no value. */
static double complex value_of(const fvi_kernel_term *t, double complex s)
{
    const fvi_kernel_function *f = (const fvi_kernel_function *)t;
    double re = GSL_NAN, im = GSL_NAN;
    f->value(creal(s), cimag(s), f->params, &re, &im);
    return re + I * im;
}

/* The derivative by ln s is computed by Cauchy's formula as a mean over a circle around ln s, on which the symbol is
 * analytic. With 24 points the error is 1e-13 if the angle between s and the cut is a right angle. */
static double complex function_symbol(const fvi_kernel_term *t, double modulus,
                                      double angle, double complex *slope)
{
    enum { POINTS = 24 };
    const double radius = 0.4;
    const double complex s = modulus * (cos(angle) + I * sin(angle));
    double complex sum = 0;
    for (int j = 0; slope && j < POINTS; j++) {
        const double complex turn = cexp(2 * M_PI * I * j / POINTS);
        sum += value_of(t, s * cexp(radius * turn)) / turn;
    }
    if (slope)
        *slope = sum / (radius * POINTS);
    return value_of(t, s);
}

/* ---- growth ---- */

static double power_growth(const fvi_kernel_term *t)
{
    return 2 * t->alpha;
}

static double range_growth(const fvi_kernel_term *t)
{
    return 2 * t->end;
}

static double zener_growth(const fvi_kernel_term *t)
{
    return t->time == 0 ? 2 * t->alpha : 0;
}

static double maxwell_growth(const fvi_kernel_term *t)
{
    return t->time == 0 ? 1 : 0;
}

static double maxwell2_growth(const fvi_kernel_term *t)
{
    return t->time == 0 ? 2 * t->alpha : 2 * t->end;
}

/* Estimate the growth from the values at 2^399 and 2^400. A symbol that decreases there has growth 0. */
static double function_growth(const fvi_kernel_term *t)
{
    const double ratio = cabs(value_of(t, 0x1p400) / value_of(t, 0x1p399));
    return ratio < 1 ? 0 : ldexp(round(ldexp(log2(ratio), 30)), -30);
}

/* Test at some frequencies that the function gives finite values, and that it is real for real s. */
static int check_function(const fvi_kernel_term *t)
{
    if (!((const fvi_kernel_function *)t)->value)
        FVI_FAIL("a symbol without a function", FVI_EFAULT);
    if (!(function_growth(t) <= 2))
        FVI_FAIL("the symbol of a law must not grow faster than s^2", FVI_EDOM);
    for (int k = -20; k <= 20; k += 4) {
        const double omega = ldexp(1.1, k); /* the factor 1.1 avoids s = 1, where ln s = 0 */
        const double complex C = value_of(t, I * omega),
                             at_conjugate = value_of(t, -I * omega),
                             real = value_of(t, omega);
        if (!isfinite(cabs(C)) || !isfinite(cabs(real)))
            FVI_FAIL("the symbol of a law must be finite at i omega", FVI_EDOM);
        if (!(cabs(at_conjugate - conj(C)) <= 1e-12 * cabs(C))
            || !(fabs(cimag(real)) <= 1e-12 * cabs(real)))
            FVI_FAIL("the symbol of a law must be real at s > 0", FVI_EDOM);
    }
    return FVI_SUCCESS;
}

/* ---- table of classes ---- */

const fvi_kernel_class fvi_kernel_classes[FVI_KERNEL_CLASSES] = {
    [FVI_KERNEL_POWER] = { check_order, power_symbol, power_growth },
    [FVI_KERNEL_ZENER] = { check_order_and_time, zener_symbol, zener_growth },
    [FVI_KERNEL_MAXWELL] = { check_time, maxwell_symbol, maxwell_growth },
    [FVI_KERNEL_DISTRIBUTED] = { check_range, range_symbol, range_growth },
    [FVI_KERNEL_MAXWELL2] = { check_pair, maxwell2_symbol, maxwell2_growth },
    [FVI_KERNEL_DAVIDSON] = { check_order_and_time, davidson_symbol,
                              zener_growth },
    [FVI_KERNEL_SYMBOL] = { check_function, function_symbol, function_growth },
};

double complex fvi_kernel_term_at(const fvi_kernel_term *t, double modulus,
                                  double angle)
{
    double complex slope;
    return t->rho
           * fvi_kernel_classes[t->kind].symbol(
               t, modulus, angle, t->kind == FVI_KERNEL_SYMBOL ? NULL : &slope);
}
