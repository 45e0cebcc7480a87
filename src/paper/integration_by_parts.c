/* src/paper/integration_by_parts.c -- Compute Delta_-^alpha and Delta_+^alpha. [H 5] */
#include <fvi/paper/integration_by_parts.h>

#include <fvi/coefficients.h>
#include "system/fail.h"

#include <gsl/gsl_math.h>
#include <stdint.h>
#include <stdlib.h>

/* Check the arguments and compute the weights before `out` is touched. */
static int prepare(double alpha, double h, size_t N, size_t d, const double *z,
                   const double *out, double **w)
{
    if (!z || !out)
        FVI_FAIL("null pointer", FVI_EFAULT);
    if (d == 0 || N >= SIZE_MAX / sizeof(double) / d)
        FVI_FAIL("d must be at least 1 and (N + 1) d addressable", FVI_EINVAL);
    if (!(alpha >= 0 && alpha <= 2))
        FVI_FAIL("alpha must be in [0, 2]", FVI_EDOM);
    if (!(gsl_finite(h) && h > 0))
        FVI_FAIL("h must be finite and positive", FVI_EDOM);
    *w = malloc((N + 1) * sizeof **w);
    if (!*w)
        FVI_FAIL("no memory for the weights", FVI_ENOMEM);
    return fvi_gl_weights(alpha, N + 1, *w);
}

int fvi_delta_minus(double alpha, double h, size_t N, size_t d, const double *z,
                    double *out)
{
    double *w;
    int status = prepare(alpha, h, N, d, z, out, &w);
    if (status)
        return status;
    const double scale = pow(h, -alpha);
    //> minus
    for (size_t k = 0; k <= N; k++)
        for (size_t i = 0; i < d; i++) {
            double sum = 0;
            for (size_t n = 0; n <= k; n++)
                sum += w[n] * z[(k - n) * d + i];
            out[k * d + i] = scale * sum; /* (5.1) */
        }
    //< minus
    free(w);
    return FVI_SUCCESS;
}

int fvi_delta_plus(double alpha, double h, size_t N, size_t d, const double *z,
                   double *out)
{
    double *w;
    int status = prepare(alpha, h, N, d, z, out, &w);
    if (status)
        return status;
    const double scale = pow(h, -alpha);
    //> plus
    for (size_t k = 0; k <= N; k++)
        for (size_t i = 0; i < d; i++) {
            double sum = 0;
            for (size_t n = 0; n <= N - k; n++)
                sum += w[n] * z[(k + n) * d + i];
            out[k * d + i] = scale * sum; /* (5.2) */
        }
    //< plus
    free(w);
    return FVI_SUCCESS;
}

double fvi_sum_of_products(size_t first, size_t last, size_t d, const double *a,
                           const double *b)
{
    double sum = 0;
    for (size_t k = first; k <= last; k++)
        for (size_t i = 0; i < d; i++)
            sum += a[k * d + i] * b[k * d + i]; /* (5.3) */
    return sum;
}
