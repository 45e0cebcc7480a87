/* src/system/digamma.h -- Compute the digamma function psi, the derivative of ln Gamma.
 *
 * The function psi has poles at 0, -1, -2, ... There GSL calls its error handler, which ends the process unless the
 * program has switched it off. The library must end no process, so fvi_digamma returns NaN at the poles. */
#ifndef FVI_DIGAMMA_H
#define FVI_DIGAMMA_H

#include <gsl/gsl_sf_psi.h>
#include <math.h>

static inline double fvi_digamma(double x)
{
    return x <= 0 && x == floor(x) ? NAN : gsl_sf_psi(x);
}

#endif
