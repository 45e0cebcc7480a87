/* tests/harness/bagley_torvik.h -- Bagley and Torvik's plate in a fluid, which is pushed until t = 1. */
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
