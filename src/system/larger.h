/* src/system/larger.h -- Compute the larger and the smaller of two numbers, so that a NaN is not lost.
 *
 * fmax(NaN, 1) is 1. So a largest error that is gathered with fmax ignores NaN, and a run that ended in NaN looks
 * exact. Therefore `make text` refuses fmax and fmin where such a number is gathered. */
#ifndef LARGER_H
#define LARGER_H

#include <math.h>
#include <stddef.h>

static inline double larger(double a, double b)
{
    return a >= b || isnan(a) ? a : b;
}

static inline double smaller(double a, double b)
{
    return a <= b || isnan(a) ? a : b;
}

static inline size_t larger_count(size_t a, size_t b)
{
    return a > b ? a : b;
}

static inline size_t smaller_count(size_t a, size_t b)
{
    return a < b ? a : b;
}

/* largest_abs -- Return the largest |v_i| of n numbers, NaN if one of them is NaN, and 0 if n = 0.
 * largest_difference -- Return the largest |v_i - w_i| in the same way. */
static inline double largest_abs(size_t n, const double *v)
{
    double most = 0;
    for (size_t i = 0; i < n; i++)
        most = larger(most, fabs(v[i]));
    return most;
}

static inline double largest_difference(size_t n, const double *v, const double *w)
{
    double most = 0;
    for (size_t i = 0; i < n; i++)
        most = larger(most, fabs(v[i] - w[i]));
    return most;
}

#endif
