/* src/kernel/symbol_poles.c -- The kind SYMBOL, and a search for poles of a symbol off the cut.        [H 26] */
#include "symbol_poles.h"

#include "kernel_general.h"
#include "system/fail.h"
#include "system/larger.h"

#include <complex.h>
#include <gsl/gsl_math.h>

/* Return the value of the caller's function, or NaN if the function writes no value. */
static double complex value_of(const fvi_kernel_term *t, double complex s)
{
    const fvi_kernel_function *f = (const fvi_kernel_function *)t;
    double re = GSL_NAN, im = GSL_NAN;
    f->value(creal(s), cimag(s), f->params, &re, &im);
    return re + I * im;
}

/* The slope is computed by Cauchy's formula as a mean over a circle around ln s, on which the symbol is
 * analytic. With 24 points the error is 1e-13 if the angle between s and the cut is a right angle. */
double complex fvi_symbol_value(const fvi_kernel_term *t, double modulus, double angle, double complex *slope)
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

double fvi_symbol_growth(const fvi_kernel_term *t)
{
    const double ratio = cabs(fvi_kernel_unit_at(t, 0x1p400, 0) / fvi_kernel_unit_at(t, 0x1p399, 0));
    return ratio < 1 ? 0 : ldexp(round(ldexp(log2(ratio), 30)), -30);
}

int fvi_symbol_check(const fvi_kernel_term *t)
{
    if (!((const fvi_kernel_function *)t)->value)
        FVI_FAIL("a symbol without a function", FVI_EFAULT);
    if (!(fvi_symbol_growth(t) <= 2))
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

/* Return 1 if the function has a pole with |arg s| < 34 degrees and 10^-6 < |s| < 10^6. The mean of an analytic
 * function over a circle is its value at the centre c. The circles have the radius 0.75 c, so they stay right of Re
 * s = 0, and together they cover this region. A pole is found if it contributes more than a thousandth of the function.
 * If the function is analytic in the cut plane, 48 points on a circle have the error 0.75^48 = 10^-6. */
static int has_poles_ahead(const fvi_kernel_function *f)
{
    enum { UPPER = 24 };
    for (int k = -20; k <= 20; k += 2) {
        const double centre = ldexp(1.1, k);
        double sum = 0, most = 0;
        for (int i = 0; i < UPPER; i++) { /* the values in the lower half plane are conjugate */
            const double angle = M_PI * (i + 0.5) / UPPER;
            const double complex C = value_of(&f->term, centre * (1 + 0.75 * cexp(I * angle)));
            sum += creal(C) / UPPER;
            most = larger(most, cabs(C));
        }
        if (!(fabs(sum - creal(value_of(&f->term, centre))) <= 1e-3 * most))
            return 1;
    }
    return 0;
}

/* ---- poles beside the cut ---- */

/* The search uses boxes in the plane of ln s = u + i v. A box reaches from v = 0 to v = WIDEST, and from line l to line
 * l + 2 of constant u. So each line lies inside another box. */
static const double WIDEST = M_PI - 0.15, ALLOWED = 1e-3;
enum { LINES = 29, POINTS = 8 };

static double line_position(size_t l)
{
    return (double)l - (LINES - 1) / 2;
}

/* The integrals along a path, in w = ln s, of C and of (w - u) C with a real u, and the largest |C| on the path. The
 * second integral finds a pole of order 2 without residue. */
typedef struct {
    double complex sum, moment;
    double most;
} path;

static path join_paths(path a, path b, int sign)
{
    return (path){ a.sum + sign * b.sum, a.moment + sign * b.moment, larger(a.most, b.most) };
}

/* Integrate along a straight line by Gauss's rule with 8 points in each of `pieces` parts. */
static path integrate_along_line(const fvi_kernel_function *f, double u, double complex from, double complex to,
                                 size_t pieces)
{
    static const double x[] = { 0.1834346424956498, 0.5255324099163290, 0.7966664774136267, 0.9602898564975363 },
                        weight[] = { 0.3626837833783620, 0.3137066458778873, 0.2223810344533745, 0.1012285362903763 };
    const double complex half = (to - from) / (2 * (double)pieces);
    path it = { 0, 0, 0 };
    for (size_t n = 0; n < pieces; n++)
        for (size_t i = 0; i < POINTS; i++) {
            const double place = i % 2 ? x[i / 2] : -x[i / 2];
            const double complex w = from + ((double)(2 * n + 1) + place) * half, C = value_of(&f->term, cexp(w)),
                                 part = weight[i / 2] * half * C;
            it.sum += part;
            it.moment += part * (w - u);
            it.most = larger(it.most, cabs(C));
        }
    return it;
}

/* Integrate upwards along a line of constant u. Near the cut the pieces are shorter. */
static path integrate_upwards(const fvi_kernel_function *f, double u, double at_u, size_t fine)
{
    static const double at[] = { 0, 1.9, 2.65, M_PI - 0.15 };
    path it = { 0, 0, 0 };
    for (size_t n = 0; n < 3; n++)
        it = join_paths(it, integrate_along_line(f, u, at_u + I * at[n], at_u + I * at[n + 1], fine), 1);
    return it;
}

//> box
/* Integrate around the box that begins at line l. By Cauchy's theorem both integrals are 0 if the function is analytic
 * in the box. They are divided by the largest |C| on the sides, so they are NaN if a value is not finite. */
static path integrate_around_box(const fvi_kernel_function *f, size_t l, size_t fine)
{
    const double from = line_position(l), to = line_position(l + 2), u = line_position(l + 1);
    path it = integrate_along_line(f, u, from, to, fine);
    it = join_paths(it, integrate_upwards(f, u, to, fine), 1);
    it = join_paths(it, integrate_along_line(f, u, from + I * WIDEST, to + I * WIDEST, 5 * fine), -1);
    it = join_paths(it, integrate_upwards(f, u, from, fine), -1);
    it.sum /= it.most;
    it.moment /= it.most;
    return it;
}

/* Return 1 if an integral is larger than ALLOWED and does not change when the pieces are halved. Then it is no error of
 * Gauss's rule. */
static int is_nonzero_integral(double complex before, double complex now)
{
    return cabs(now) > ALLOWED && cabs(now - before) < 0.01 * cabs(now);
}

/* Return 1 if the box contains a pole. If a value on its sides is not finite, return 0. */
static int has_poles_in_box(const fvi_kernel_function *f, size_t l)
{
    enum { FINEST = 16 };
    path before = integrate_around_box(f, l, 1);
    for (size_t fine = 2; fine <= FINEST; fine *= 2) {
        if (!(cabs(before.sum) > ALLOWED || cabs(before.moment) > ALLOWED))
            return 0;
        const path now = integrate_around_box(f, l, fine);
        if (is_nonzero_integral(before.sum, now.sum) || is_nonzero_integral(before.moment, now.moment))
            return 1;
        before = now;
    }
    return 0;
}
//< box

int fvi_symbol_has_poles(const fvi_kernel_function *f)
{
    if (has_poles_ahead(f))
        return 1;
    for (size_t l = 0; l + 2 < LINES; l++)
        if (has_poles_in_box(f, l))
            return 1;
    return 0;
}
