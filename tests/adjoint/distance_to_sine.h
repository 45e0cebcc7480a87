/* tests/adjoint/distance_to_sine.h -- The J of Taylor's tests of H 23. */
#ifndef DISTANCE_TO_SINE_H
#define DISTANCE_TO_SINE_H

#include <math.h>
#include <stddef.h>

/* h/2 sum |x_k - sin t_k|^2, k >= 1, and x_N/2 + x_N p_N^2/4, of d coordinates. */
static inline double distance_to_sine(size_t d, size_t N, double h, const double *x, const double *p)
{
    double J = 0;
    for (size_t i = 0; i < d; i++) {
        for (size_t k = 1; k <= N; k++) {
            const double away = x[k * d + i] - sin((double)k * h);
            J += h / 2 * away * away;
        }
        J += x[N * d + i] / 2 + x[N * d + i] * p[N * d + i] * p[N * d + i] / 4;
    }
    return J;
}

#endif
