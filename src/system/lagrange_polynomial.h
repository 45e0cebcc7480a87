/* src/system/lagrange_polynomial.h -- The polynomials that interpolate values at nodes. */
#ifndef FVI_LAGRANGE_POLYNOMIAL_H
#define FVI_LAGRANGE_POLYNOMIAL_H

#include <stddef.h>

/* fvi_lagrange_polynomial -- Return l_i(t), the polynomial of degree n - 1 that is 1 at node c[i] and 0 at all other
 * nodes. */
static inline double fvi_lagrange_polynomial(size_t n, const double *c, size_t i, double t)
{
    double l = 1;
    for (size_t m = 0; m < n; m++)
        if (m != i)
            l *= (t - c[m]) / (c[i] - c[m]);
    return l;
}

#endif
