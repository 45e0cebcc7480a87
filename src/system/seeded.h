/* src/system/seeded.h -- Numbers that look random: the same ones from the same seed, on every machine. */
#ifndef FVI_SEEDED_H
#define FVI_SEEDED_H

#include <stdint.h>

/* fvi_seeded_next -- the next 64 bits of Knuth's generator MMIX, of which the high ones are the good ones.
 * fvi_seeded_uniform -- a number that is evenly spread over [low, high). */
static inline uint64_t fvi_seeded_next(uint64_t *state)
{
    return *state = *state * 6364136223846793005u + 1442695040888963407u;
}

static inline double fvi_seeded_uniform(uint64_t *state, double low, double high)
{
    return low + (high - low) * ((double)(fvi_seeded_next(state) >> 11) * 0x1p-53);
}

#endif
