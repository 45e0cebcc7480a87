/* src/system/dot.h -- Compute the scalar product of two vectors. */
#ifndef FVI_DOT_H
#define FVI_DOT_H

#include <stddef.h>

/* fvi_dot -- Return the scalar product of a and b, n numbers each, summed from the first product to the last. */
static inline double fvi_dot(size_t n, const double *a, const double *b)
{
    double sum = 0;
    for (size_t i = 0; i < n; i++)
        sum += a[i] * b[i];
    return sum;
}

#endif
