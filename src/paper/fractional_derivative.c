/* src/paper/fractional_derivative.c -- Compute derivatives of fractional order. [H 1] */
#include <fvi/paper/fractional_derivative.h>

#include "system/fail.h"
#include "system/larger.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_integration.h>
#include <gsl/gsl_math.h>

enum { INTERVALS = 1000, PROBES = 32 };

/* ---- functions, by quadrature ---- */

static int check(fvi_side side, double alpha, double end,
                 const fvi_curve *curve, double t, const double *d)
{
    if (!curve || !curve->f || !curve->df || !d)
        FVI_FAIL("null pointer", FVI_EFAULT);
    if (side != FVI_RETARDED && side != FVI_ADVANCED)
        FVI_FAIL("side must be FVI_RETARDED or FVI_ADVANCED", FVI_EINVAL);
    if (!(alpha >= 0 && alpha <= 1))
        FVI_FAIL("alpha must be in [0, 1]", FVI_EDOM);
    if (!gsl_finite(end - t)) /* then both are finite */
        FVI_FAIL("end and t must be finite", FVI_EDOM);
    if (side == FVI_RETARDED ? t < end : t > end)
        FVI_FAIL("t must lie on its side of the end", FVI_EDOM);
    return FVI_SUCCESS;
}

//> history
/* The history of f' as seen from t: x = 0 is the time t, and x = 1 is the end. */
typedef struct {
    const fvi_curve *curve;
    double t, reach; /* reach = end - t, with its sign */
} history;

static double velocity(double x, void *params)
{
    const history *past = params;
    return past->curve->df(past->t + past->reach * x, past->curve->params);
}
//< history

/* Compute (1.5): (1 - alpha) int_0^1 x^(-alpha) f'(t + reach x) dx, a mean of f'. */
static int mean_velocity(history *past, double alpha, double *mean)
{
    double largest = 0; /* largest |f'| at some points; it sets the tolerance */
    for (int i = 0; i <= PROBES; i++) {
        double v = velocity((double)i / PROBES, past);
        if (!gsl_finite(v))
            FVI_FAIL("f' is not finite", FVI_EBADFUNC);
        largest = larger(largest, fabs(v));
    }
    double tolerance = 1e-13 * largest / (1 - alpha) + GSL_DBL_MIN, error;
    gsl_function f = { velocity, past };
    fvi_quiet();
    gsl_integration_workspace *w = gsl_integration_workspace_alloc(INTERVALS);
    gsl_integration_qaws_table *kernel =
        w ? gsl_integration_qaws_table_alloc(-alpha, 0, 0, 0) : NULL;
    int status = FVI_ENOMEM;
    if (kernel)
        status = gsl_integration_qaws(&f, 0, 1, kernel, tolerance, 0, INTERVALS,
                                      w, mean, &error);
    gsl_integration_qaws_table_free(kernel);
    gsl_integration_workspace_free(w);
    fvi_loud();
    if (status == GSL_EFAILED) /* QAWS returns this if an area is not a number */
        FVI_FAIL("f' is not finite", FVI_EBADFUNC);
    if (status)
        FVI_FAIL("the quadrature gave up", status);
    *mean *= 1 - alpha;
    return FVI_SUCCESS;
}

/* Compute Caputo's derivative. The arguments have been checked. */
static int caputo(fvi_side side, double alpha, double end,
                  const fvi_curve *curve, double t, double *d)
{
    //> caputo
    history past = { curve, t, end - t };
    double now = curve->df(t, curve->params), mean = 0, u = fabs(end - t);
    if (alpha == 1) {
        *d = -side * now; /* (1.11) */
    } else if (alpha == 0) {
        *d = curve->f(t, curve->params) - curve->f(end, curve->params);
    } else {
        int status = u > 0 ? mean_velocity(&past, alpha, &mean) : FVI_SUCCESS;
        if (status)
            return status;
        *d = -side * pow(u, 1 - alpha) / tgamma(2 - alpha) * mean; /* (1.5) */
    }
    //< caputo
    return FVI_SUCCESS;
}

int fvi_caputo(fvi_side side, double alpha, double end, const fvi_curve *curve,
               double t, double *d)
{
    double value = 0;
    int status = check(side, alpha, end, curve, t, d);
    if (!status)
        status = caputo(side, alpha, end, curve, t, &value);
    if (status)
        return status;
    if (!gsl_finite(value))
        FVI_FAIL("f or f' is not finite", FVI_EBADFUNC);
    *d = value;
    return FVI_SUCCESS;
}

int fvi_riemann_liouville(fvi_side side, double alpha, double end,
                          const fvi_curve *curve, double t, double *d)
{
    double value = 0;
    int status = check(side, alpha, end, curve, t, d);
    if (!status)
        status = caputo(side, alpha, end, curve, t, &value);
    if (status)
        return status;
    //> relation
    double u = fabs(end - t), at_end = curve->f(end, curve->params);
    if (u == 0 && alpha > 0 && alpha < 1 && at_end != 0 && gsl_finite(at_end))
        FVI_FAIL("the derivative is infinite at the end", FVI_ESING);
    if (alpha == 0)
        value = curve->f(t, curve->params);
    else if (alpha < 1 && at_end != 0)
        value += at_end * pow(u, -alpha) / tgamma(1 - alpha); /* (1.4) */
    //< relation
    if (!gsl_finite(value))
        FVI_FAIL("f or f' is not finite", FVI_EBADFUNC);
    *d = value;
    return FVI_SUCCESS;
}

/* ---- powers, in closed form ---- */

/* Return a + b + c. *lo becomes the part of the sum that the result lacks. */
static double sum3(double a, double b, double c, double *lo)
{
    double ab = a + b, bb = ab - a, e = (a - (ab - bb)) + (b - bb);
    double s = ab + c, cc = s - ab, f = (ab - (s - cc)) + (c - cc);
    double hi = s + (e + f);
    *lo = (e + f) - (hi - s);
    return hi;
}

/* Return ln Gamma(x) - (x - 1/2) ln x + x - ln(2 pi)/2 for x >= 10, with an error of 1e-17. */
static double stirling(double x)
{
    const double c[] = { 1.0 / 12,   -1.0 / 360,      1.0 / 1260, -1.0 / 1680,
                         1.0 / 1188, -691.0 / 360360, 1.0 / 156 };
    double sum = 0, xx = x * x;
    for (int i = 6; i >= 0; i--)
        sum = sum / xx + c[i];
    return sum / x;
}

/* Return Gamma(g + 1) / Gamma(g + 1 - order). */
static double ratio(double order, double g)
{
    double lo;
    //> ratio
    double z = sum3(g, -order, 1, &lo); /* each sum is rounded once */
    if (z >= 10 && g >= 9)
        return pow(g + 1, order)
               * exp((z - 0.5) * log1p(order / z) - order + stirling(g + 1)
                     - stirling(z));
    if (z >= 1)
        return tgamma(g + 1) / tgamma(z);
    /* 1/Gamma(z) = z (z + 1) / Gamma(z + 2), where the zeros are factors. */
    return tgamma(g + 1) * z * sum3(g, -order, 2, &lo)
           / tgamma(sum3(g, -order, 3, &lo));
    //< ratio
}

int fvi_power_derivative(double order, double g, double u, double *d)
{
    if (!d)
        FVI_FAIL("d is a null pointer", FVI_EFAULT);
    if (!(order >= -2 && order <= 2))
        FVI_FAIL("order must be in [-2, 2]", FVI_EDOM);
    if (!(g > -1 && gsl_finite(g)))
        FVI_FAIL("the exponent must be finite and > -1", FVI_EDOM);
    if (!(u >= 0 && gsl_finite(u)))
        FVI_FAIL("u must be finite and not negative", FVI_EDOM);
    double lo, e = sum3(g, -order, 0, &lo), c = ratio(order, g), value = 0;
    if (c != 0)
        value = c * pow(u, e); /* (1.6) */
    if (c != 0 && lo != 0 && value != 0)
        value *= exp(lo * log(u)); /* the part that the exponent lacks */
    if (!gsl_finite(value) && u == 0)
        FVI_FAIL("a power with a negative exponent at 0", FVI_ESING);
    if (!gsl_finite(value))
        FVI_FAIL("the result is too large for a double", FVI_EOVRFLW);
    *d = value;
    return FVI_SUCCESS;
}
