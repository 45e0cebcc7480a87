/* tests/damping_laws/random_laws.h -- Laws by chance, for the tests of H 26. */
#ifndef RANDOM_LAWS_H
#define RANDOM_LAWS_H

#include <fvi/damping_laws.h>

#include <math.h>
#include <stdlib.h>

static inline double random_in(double low, double high)
{
    return low + (high - low) * rand() / RAND_MAX;
}

/* One to three terms of all kinds, orders and times over decades. */
static inline size_t random_terms(fvi_kernel_term *term)
{
    const size_t count = 1 + (size_t)rand() % 3;
    for (size_t i = 0; i < count; i++)
        term[i] = (fvi_kernel_term){ .kind = (fvi_kernel_kind)(rand() % 4),
                                  .rho = pow(10, random_in(-2, 2)),
                                  .time = pow(10, random_in(-1, 2)),
                                  .end = random_in(0.8, 1) };
    for (size_t i = 0; i < count; i++) /* a fraction's has modes up to 0.45 */
        term[i].alpha = term[i].kind == FVI_KERNEL_ZENER ? random_in(0, 0.45)
                                                      : random_in(0, 0.8);
    return count;
}

#endif
