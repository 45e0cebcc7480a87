/* src/system/digamma.h -- psi, the derivative of ln Gamma.
 *
 * Where psi has a pole, at 0, -1, -2, ..., GSL calls its error handler, which ends the process
 * unless the program has switched it off. The library ends no process: here psi is NaN there. */
#ifndef FVI_DIGAMMA_H
#define FVI_DIGAMMA_H

#include <gsl/gsl_sf_psi.h>
#include <math.h>

static inline double fvi_digamma(double x)
{
    return x <= 0 && x == floor(x) ? NAN : gsl_sf_psi(x);
}

#endif
