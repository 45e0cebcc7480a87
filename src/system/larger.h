/* src/system/larger.h -- The larger and the smaller of two numbers, and NaN if one is NaN.
 *
 * fmax(NaN, 1) is 1: a largest error that is gathered with fmax passes over a run of NaN and
 * calls it exact. So `make text` refuses fmax and fmin wherever such a number is gathered. */
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

/* largest_abs -- the largest |v_i| of n numbers, NaN if one is NaN; 0 of none.
 * largest_difference -- the largest |v_i - w_i|, likewise. */
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
