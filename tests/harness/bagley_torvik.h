/* tests/harness/bagley_torvik.h -- The problem of Bagley and Torvik, a plate in a fluid that a force pushes until
 * t = 1. */
#ifndef BAGLEY_TORVIK_H
#define BAGLEY_TORVIK_H

#include <fvi/fvi.h>

static inline fvi_linear_oscillator bagley_torvik(void)
{
    return (fvi_linear_oscillator){ .m = 1,
                                    .c = 1,
                                    .rho = 1,
                                    .alpha = 0.75,
                                    .forcing = FVI_FORCING_STEP,
                                    .A = 8,
                                    .T = 1 };
}

#endif
