/* tests/adjoint/sine_and_momenta.h -- The J of adjoint_matrices.py and adjoint_dampers.py, with their step. */
#ifndef SINE_AND_MOMENTA_H
#define SINE_AND_MOMENTA_H

#include <math.h>
#include <stddef.h>

static const double h = 1. / 16;

/* (h/2) sum |x_k - sin t_k|^2, k >= 1, and the sum of p_N. */
static inline int to_sine(size_t k, size_t d, const double *x, const double *p, void *params,
                          double *Jx, double *Jp)
{
    (void)params;
    for (size_t i = 0; i < d; i++) {
        Jx[i] += k > 0 ? h * (x[i] - sin((double)k * h)) : 0;
        if (p)
            Jp[i] += p[i];
    }
    return 0;
}

#endif
