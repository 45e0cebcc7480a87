/* chapters/live/gsl_modes.c -- What the exponentials of a memory call of GSL, beside chapters/play/gsl.c. */
#include <gsl/gsl_sf_gamma.h>
#include <gsl/gsl_sf_lambert.h>
#include <math.h>

double gsl_sf_lngamma(const double x)
{
    return lgamma(x);
}

/* The x with x e^x = A, A > 0, by Newton's method for x + ln x = ln A. */
double gsl_sf_lambert_W0(double A)
{
    double x = A < 1 ? A / (1 + A) : fmax(log(A), 0.5);
    for (int i = 0; i < 20; i++)
        x *= (1 + log(A) - log(x)) / (1 + x);
    return x;
}
