/* src/paper/half_derivative.c -- Apply half a derivative twice.             [H 7] */
#include <fvi/paper/half_derivative.h>

#include <fvi/coefficients.h>
#include <fvi/paper/integration_by_parts.h>
#include "system/fail.h"

#include <gsl/gsl_math.h>
#include <stdint.h>
#include <stdlib.h>

int fvi_gl_weights_product(double alpha, double beta, size_t count, double *c)
{
    if (!c)
        FVI_FAIL("c is a null pointer", FVI_EFAULT);
    if (count == 0 || count > SIZE_MAX / sizeof(double) / 2)
        FVI_FAIL("count must be at least 1 and addressable", FVI_EINVAL);
    if (!(alpha >= 0 && alpha <= 2 && beta >= 0 && beta <= 2))
        FVI_FAIL("both orders must be in [0, 2]", FVI_EDOM);
    double *a = malloc(2 * count * sizeof *a), *b = a ? a + count : NULL;
    if (!a)
        FVI_FAIL("no memory for the weights", FVI_ENOMEM);
    fvi_gl_weights(alpha, count, a);
    fvi_gl_weights(beta, count, b);
    //> product
    for (size_t k = 0; k < count; k++) {
        c[k] = 0;
        for (size_t n = 0; n <= k; n++)
            c[k] += a[n] * b[k - n]; /* (7.2) */
    }
    //< product
    free(a);
    return FVI_SUCCESS;
}

int fvi_delta_twice(double alpha, double h, size_t N, size_t d, const double *z,
                    double *out)
{
    if (!z || !out)
        FVI_FAIL("null pointer", FVI_EFAULT);
    if (d == 0 || N >= SIZE_MAX / sizeof(double) / d)
        FVI_FAIL("d must be at least 1 and (N + 1) d addressable", FVI_EINVAL);
    double *once = malloc((N + 1) * d * sizeof *once);
    if (!once)
        FVI_FAIL("no memory for the first derivative", FVI_ENOMEM);
    //> twice
    int status = fvi_delta_minus(alpha, h, N, d, z, once);
    if (!status)
        status = fvi_delta_minus(alpha, h, N, d, once, out); /* (7.1) */
    //< twice
    free(once);
    return status;
}

int fvi_backward_difference(double h, size_t N, size_t d, const double *z,
                            double *out)
{
    if (!z || !out)
        FVI_FAIL("null pointer", FVI_EFAULT);
    if (d == 0 || N >= SIZE_MAX / sizeof(double) / d)
        FVI_FAIL("d must be at least 1 and (N + 1) d addressable", FVI_EINVAL);
    if (!(gsl_finite(h) && h > 0))
        FVI_FAIL("h must be finite and positive", FVI_EDOM);
    //> difference
    for (size_t j = 0; j < (N + 1) * d; j++)
        out[j] = (z[j] - (j < d ? 0 : z[j - d])) / h; /* (7.3) */
    //< difference
    return FVI_SUCCESS;
}
