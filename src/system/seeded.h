/* src/system/seeded.h -- Generate pseudo-random numbers that depend on the seed only, not on the machine. */
#ifndef FVI_SEEDED_H
#define FVI_SEEDED_H

#include <stdint.h>

/* fvi_seeded_next -- Return the next 64 bits of Knuth's generator MMIX. Its high bits are better than its low bits.
 * fvi_seeded_uniform -- Return a number that is uniformly distributed in [low, high). It uses the high 53 bits. */
static inline uint64_t fvi_seeded_next(uint64_t *state)
{
    return *state = *state * 6364136223846793005u + 1442695040888963407u;
}

static inline double fvi_seeded_uniform(uint64_t *state, double low, double high)
{
    return low + (high - low) * ((double)(fvi_seeded_next(state) >> 11) * 0x1p-53);
}

#endif
