/* src/kernel/kernel_classes.c -- Kinds of kernels: ranges, symbols, growth.   [H 26] */
#include <fvi/damping_laws.h>

#include "kernel_general.h"
#include "system/fail.h"
#include "system/larger.h"

#include <complex.h>
#include <gsl/gsl_math.h>
#include <math.h>

/* All that the library knows of a kind of kernel. The symbols are those of rho = 1; slope is
 * s times the derivative, and may be NULL of a SYMBOL. */
typedef struct {
    int (*check)(const fvi_kernel_term *t);
    double complex (*symbol)(const fvi_kernel_term *t, double modulus,
                             double angle, double complex *slope);
    double (*growth)(const fvi_kernel_term *t);
} kernel_class;

/* ---- ranges of the numbers ---- */

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

/* e^{2 a ln s}, whose angle is 2 a times that of s: exact where that is none. */
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
/* s^{2 a} / (1 + time s^{2 b}), and s times its derivative */
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

/* The integral of e^{2 a L}, L = ln s, over a range of orders, and its derivative by L. */
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

/* The value that the caller's function gives, NaN where it gives none. */
static double complex value_of(const fvi_kernel_term *t, double complex s)
{
    const fvi_kernel_function *f = (const fvi_kernel_function *)t;
    double re = GSL_NAN, im = GSL_NAN;
    f->value(creal(s), cimag(s), f->params, &re, &im);
    return re + I * im;
}

/* The derivative by ln s is a mean over a circle around ln s, on which the symbol is
 * analytic; 24 points leave 1e-13 where the cut is a right angle away. */
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

/* From one power of 2 to the next, far up; a law that falls there does not grow. */
static double function_growth(const fvi_kernel_term *t)
{
    const double ratio = cabs(value_of(t, 0x1p400) / value_of(t, 0x1p399));
    return ratio < 1 ? 0 : ldexp(round(ldexp(log2(ratio), 30)), -30);
}

/* The mean of an analytic function over a circle is its value at the centre c. These circles leave a quarter of c
 * to Re s = 0, and cover all s with |arg s| < 34 degrees and 10^-6 < |s| < 10^6: a pole there is seen, if it is
 * not a thousandth of the function. In the cut plane 48 points on a circle are right to 0.75^48 = 10^-6. */
static int has_poles_ahead(const fvi_kernel_term *t)
{
    enum { UPPER = 24 };
    for (int k = -20; k <= 20; k += 2) {
        const double centre = ldexp(1.1, k);
        double sum = 0, most = 0;
        for (int i = 0; i < UPPER; i++) { /* those of the lower half are their mirror images */
            const double angle = M_PI * (i + 0.5) / UPPER;
            const double complex C = value_of(t, centre * (1 + 0.75 * cexp(I * angle)));
            sum += creal(C) / UPPER;
            most = larger(most, cabs(C));
        }
        if (!(fabs(sum - creal(value_of(t, centre))) <= 1e-3 * most))
            return 1;
    }
    return 0;
}

/* Some frequencies say whether it is a function, and real for real s. */
static int check_function(const fvi_kernel_term *t)
{
    if (!((const fvi_kernel_function *)t)->value)
        FVI_FAIL("a symbol without a function", FVI_EFAULT);
    if (!(function_growth(t) <= 2))
        FVI_FAIL("the symbol of a law must not grow faster than s^2", FVI_EDOM);
    for (int k = -20; k <= 20; k += 4) {
        const double omega = ldexp(1.1, k); /* at 1 ln s would be 0 */
        const double complex C = value_of(t, I * omega),
                             mirrored = value_of(t, -I * omega),
                             real = value_of(t, omega);
        if (!isfinite(cabs(C)) || !isfinite(cabs(real)))
            FVI_FAIL("the symbol of a law must be finite at i omega", FVI_EDOM);
        if (!(cabs(mirrored - conj(C)) <= 1e-12 * cabs(C))
            || !(fabs(cimag(real)) <= 1e-12 * cabs(real)))
            FVI_FAIL("the symbol of a law must be real at s > 0", FVI_EDOM);
    }
    return FVI_SUCCESS;
}

/* ---- the table ---- */

static const kernel_class classes[] = {
    [FVI_KERNEL_POWER] = { check_order, power_symbol, power_growth },
    [FVI_KERNEL_ZENER] = { check_order_and_time, zener_symbol, zener_growth },
    [FVI_KERNEL_MAXWELL] = { check_time, maxwell_symbol, maxwell_growth },
    [FVI_KERNEL_DISTRIBUTED] = { check_range, range_symbol, range_growth },
    [FVI_KERNEL_MAXWELL2] = { check_pair, maxwell2_symbol, maxwell2_growth },
    [FVI_KERNEL_DAVIDSON] = { check_order_and_time, davidson_symbol,
                              zener_growth },
    [FVI_KERNEL_SYMBOL] = { check_function, function_symbol, function_growth },
};

/* ---- a sum of terms ---- */

static int check_term(const fvi_kernel_term *t)
{
    if ((size_t)t->kind >= sizeof classes / sizeof *classes)
        FVI_FAIL("unknown law of damping", FVI_EINVAL);
    if (!(isfinite(t->rho) && t->rho >= 0))
        FVI_FAIL("rho of a law must be finite and not negative", FVI_EDOM);
    return classes[t->kind].check(t);
}

int fvi_kernel_check_terms(const fvi_kernel *law)
{
    if (!law || (law->count && !law->term))
        FVI_FAIL("null pointer", FVI_EFAULT);
    if (law->count == 0)
        FVI_FAIL("a law has at least one term", FVI_EINVAL);
    for (size_t i = 0; i < law->count; i++) {
        if (law->term[i].kind == FVI_KERNEL_SYMBOL && law->count > 1)
            FVI_FAIL("a SYMBOL stands alone in its law", FVI_EINVAL);
        int status = check_term(&law->term[i]);
        if (status)
            return status;
    }
    return FVI_SUCCESS;
}

int fvi_kernel_check(const fvi_kernel *law)
{
    const int status = fvi_kernel_check_terms(law);
    if (!status && law->term->kind == FVI_KERNEL_SYMBOL && has_poles_ahead(law->term))
        FVI_FAIL("the symbol of a law must be analytic at Re s > 0", FVI_EDOM);
    return status;
}

double fvi_kernel_growth(const fvi_kernel *law)
{
    double most = 0;
    for (size_t i = 0; i < law->count; i++) {
        const fvi_kernel_term *t = &law->term[i];
        most = larger(most, classes[t->kind].growth(t));
    }
    return most;
}

double fvi_kernel_dashpot(const fvi_kernel *law)
{
    const double far = 1e100, farther = 1e200, a = fvi_kernel_symbol(law, far) / far,
                 b = fvi_kernel_symbol(law, farther) / farther;
    return fabs(a - b) <= 1e-9 * fabs(a) ? b : 0;
}

int fvi_kernel_takes_caputo(const fvi_kernel *law)
{
    if (fvi_kernel_growth(law) > 1)
        return 0;
    for (size_t i = 0; i < law->count; i++) {
        const fvi_kernel_term *t = &law->term[i];
        const int has_order =
            t->kind != FVI_KERNEL_MAXWELL && t->kind != FVI_KERNEL_SYMBOL;
        if (has_order && t->alpha > 0.5)
            return 0;
    }
    return 1;
}

double complex fvi_kernel_term_at(const fvi_kernel_term *t, double modulus,
                                  double angle)
{
    double complex slope;
    return t->rho
           * classes[t->kind].symbol(
               t, modulus, angle, t->kind == FVI_KERNEL_SYMBOL ? NULL : &slope);
}

/* Of a symbol that the caller gives the slope costs many values. */
static double complex sum_at(const fvi_kernel *law, double modulus, double angle,
                             double complex *slope)
{
    double complex C = 0;
    if (!slope) {
        for (size_t i = 0; i < law->count; i++)
            C += fvi_kernel_term_at(&law->term[i], modulus, angle);
        return C;
    }
    *slope = 0;
    for (size_t i = 0; i < law->count; i++) {
        const fvi_kernel_term *t = &law->term[i];
        double complex one;
        C += t->rho * classes[t->kind].symbol(t, modulus, angle, &one);
        *slope += t->rho * one;
    }
    return C;
}

fvi_kernel fvi_kernel_of_function(const fvi_kernel_function *function)
{
    return (fvi_kernel){ 1, &function->term };
}

static void expression_value(double re, double im, void *params, double *C_re,
                             double *C_im)
{
    fvi_expression_complex_value(params, re, im, C_re, C_im);
}

fvi_kernel_function fvi_kernel_of_expression(const fvi_expression *e,
                                             double rho)
{
    return (fvi_kernel_function){ { FVI_KERNEL_SYMBOL, rho, 0, 0, 0 },
                                  expression_value,
                                  (void *)e };
}

double complex fvi_kernel_at(const fvi_kernel *law, double complex s,
                          double complex *slope)
{
    return sum_at(law, cabs(s), carg(s), slope);
}

double fvi_kernel_symbol(const fvi_kernel *law, double s)
{
    return creal(sum_at(law, s, 0, NULL));
}

int fvi_kernel_moduli(const fvi_kernel *law, double omega, double *storage,
                   double *loss)
{
    int status = fvi_kernel_check(law);
    if (status)
        return status;
    if (!storage || !loss)
        FVI_FAIL("null pointer", FVI_EFAULT);
    if (!(isfinite(omega) && omega > 0))
        FVI_FAIL("omega must be finite and positive", FVI_EDOM);
    const double complex C = sum_at(law, omega, M_PI_2, NULL);
    if (!isfinite(creal(C)) || !isfinite(cimag(C)))
        FVI_FAIL("a modulus is not finite", FVI_EOVRFLW);
    *storage = creal(C);
    *loss = cimag(C);
    return FVI_SUCCESS;
}
