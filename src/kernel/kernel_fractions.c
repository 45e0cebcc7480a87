/* src/kernel/kernel_fractions.c -- The kinds that are fractions of powers: POWER, ZENER, MAXWELL, MAXWELL2.   [H 26] */
#include "kernel_classes.h"

#include "system/fail.h"

#include <complex.h>
#include <gsl/gsl_math.h>
#include <math.h>

/* ---- range checks ---- */

int fvi_check_order(const fvi_kernel_term *t)
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

int fvi_check_order_and_time(const fvi_kernel_term *t)
{
    const int status = fvi_check_order(t);
    return status ? status : check_time(t);
}

static int check_pair(const fvi_kernel_term *t)
{
    const int status = fvi_check_order_and_time(t);
    if (!status && !(t->end >= 0 && t->end <= t->alpha))
        FVI_FAIL("the end of two springpots must be in [0, alpha]", FVI_EDOM);
    return status;
}

/* ---- symbols ---- */

double complex fvi_power_at(double a, double modulus, double angle)
{
    const double size = pow(modulus, 2 * a);
    return size * cos(2 * a * angle) + I * size * sin(2 * a * angle);
}

static double complex power_symbol(const fvi_kernel_term *t, double modulus,
                                   double angle, double complex *slope)
{
    const double complex q = fvi_power_at(t->alpha, modulus, angle);
    *slope = 2 * t->alpha * q;
    return q;
}

//> symbol
/* Return s^{2 a} / (1 + time s^{2 b}), and write s times its derivative to *slope. */
static double complex fraction_at(double a, double b, double time,
                                  double modulus, double angle,
                                  double complex *slope)
{
    const double complex q = fvi_power_at(a, modulus, angle),
                         below = b == a ? q : fvi_power_at(b, modulus, angle),
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

static double complex fraction_symbol(const fvi_kernel_term *t, double modulus, double angle, double complex *slope)
{
    fvi_kernel_simple f;
    fvi_kernel_is_fraction(t, &f);
    return fraction_at(f.alpha, f.below, f.time, modulus, angle, slope);
}

static double complex maxwell2_symbol(const fvi_kernel_term *t, double modulus,
                                      double angle, double complex *slope)
{
    return fraction_at(t->alpha, t->alpha - t->end, t->time, modulus, angle,
                       slope);
}

/* ---- one fraction of powers ---- */

int fvi_power_fraction(const fvi_kernel_term *t, fvi_kernel_simple *f)
{
    *f = (fvi_kernel_simple){ t->rho, t->alpha, 0, t->alpha };
    return 1;
}

int fvi_zener_fraction(const fvi_kernel_term *t, fvi_kernel_simple *f)
{
    *f = (fvi_kernel_simple){ t->rho, t->alpha, t->time, t->alpha };
    return 1;
}

static int maxwell_fraction(const fvi_kernel_term *t, fvi_kernel_simple *f)
{
    *f = (fvi_kernel_simple){ t->rho, 0.5, t->time, 0.5 };
    return 1;
}

/* If both springpots have the same order, the denominator is a number. */
static int maxwell2_fraction(const fvi_kernel_term *t, fvi_kernel_simple *f)
{
    const double alpha = t->alpha, below = alpha - t->end;
    *f = below == 0 ? (fvi_kernel_simple){ t->rho / (1 + t->time), alpha, 0, alpha }
                    : (fvi_kernel_simple){ t->rho, alpha, t->time, below };
    return 1;
}

/* ---- growth, and the side of the cut ---- */

double fvi_fraction_growth(const fvi_kernel_simple *f)
{
    return f->time == 0 ? 2 * f->alpha : 2 * (f->alpha - f->below);
}

/* 2 (alpha - below) would be rounded. */
static double maxwell2_growth(const fvi_kernel_term *t)
{
    return t->time == 0 ? 2 * t->alpha : 2 * t->end;
}

//> sides
/* A fraction q / (1 + T q) of orders up to 1 is above the line if q is. */
fvi_kernel_side fvi_fraction_side(const fvi_kernel_simple *f)
{
    const double order = 2 * f->alpha;
    return f->time > 0 && order > 1   ? FVI_SIDE_ANYWHERE
           : order == 0 || order == 2 ? FVI_SIDE_ON_THE_LINE
           : order < 1                ? FVI_SIDE_ABOVE
           : order > 1                ? FVI_SIDE_BELOW
                                      : FVI_SIDE_NEGATIVE;
}
//< sides

/* ---- derivatives of the symbol by alpha, time and end ---- */

/* dC/d alpha and dC/d time of a power, a fraction or a Maxwell element. (23.21) */
static double complex derivative_of_fraction(const fvi_kernel_term *t, double complex s, size_t field)
{
    const double complex C = fvi_kernel_at(&(fvi_kernel){ 1, t }, s, NULL);
    return field == 1 ? 2 * clog(s) * C * (1 - t->time * C) : -C * C;
}

//> pair
/* The derivatives of two springpots in series by alpha, time and end. (23.28) */
static double complex derivative_of_pair(const fvi_kernel_term *t, double complex s, size_t field)
{
    const double complex q = cexp(2 * (t->alpha - t->end) * clog(s)), u = t->time * q,
                         C = cexp(2 * t->alpha * clog(s)) / (1 + u);
    if (field == 1)
        return 2 * clog(s) * C / (1 + u);
    if (field == 2)
        return -C * q / (1 + u);
    return 2 * clog(s) * C * u / (1 + u);
}
//< pair

/* ---- the kinds ---- */

const fvi_kernel_class fvi_kernel_of_power = { { FVI_RHO, FVI_HALF_ORDER(1) }, fvi_check_order, power_symbol,
                                               .fraction = fvi_power_fraction, .by = derivative_of_fraction };

const fvi_kernel_class fvi_kernel_of_zener = { { FVI_RHO, FVI_HALF_ORDER(1), FVI_TIME }, fvi_check_order_and_time,
                                               fraction_symbol, .fraction = fvi_zener_fraction,
                                               .by = derivative_of_fraction };

const fvi_kernel_class fvi_kernel_of_maxwell = { { FVI_RHO, FVI_TIME }, check_time, fraction_symbol,
                                                 .fraction = maxwell_fraction, .by = derivative_of_fraction,
                                                 .has_time = 1 };

const fvi_kernel_class fvi_kernel_of_maxwell2 = {
    { { "rho1", 0, FVI_RANGE_SIZE, INFINITY }, { "alpha1", 1, FVI_RANGE_ORDER, 1 },
      { "rho2", 2, FVI_RANGE_SIZE, INFINITY }, { "alpha2", 3, FVI_RANGE_ORDER, 1 } },
    check_pair, maxwell2_symbol, maxwell2_growth, maxwell2_fraction, .by = derivative_of_pair
};
