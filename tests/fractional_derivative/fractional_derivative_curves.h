/* tests/fractional_derivative/fractional_derivative_curves.h -- Curves with their derivatives, for the
 * tests of H 1. */
#ifndef FRACTIONAL_DERIVATIVE_CURVES_H
#define FRACTIONAL_DERIVATIVE_CURVES_H

#include <fvi/error.h>
#include <fvi/paper/fractional_derivative.h>
#include "harness/ulp.h"

#include <gsl/gsl_math.h>

static inline double sine(double t, const void *p)
{
    return sin(*(const double *)p * t);
}
static inline double dsine(double t, const void *p)
{
    return *(const double *)p * cos(*(const double *)p * t);
}
static inline double one(double t, const void *p)
{
    (void)t, (void)p;
    return 1;
}
static inline double zero(double t, const void *p)
{
    (void)t, (void)p;
    return 0;
}

static const double ONE = 1;
static const fvi_curve slow_sine = { sine, dsine, &ONE };
static const fvi_curve constant = { one, zero, NULL };

static inline double power(double order, double g, double u)
{
    double d = GSL_NAN;
    ck_assert_int_eq(fvi_power_derivative(order, g, u, &d), FVI_SUCCESS);
    return d;
}

#endif
