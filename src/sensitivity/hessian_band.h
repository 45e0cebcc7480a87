/* src/sensitivity/hessian_band.h -- A Hessian, entry by entry.             [H 23]
 *
 * Internal: for those who put Hessians of all stages into one matrix. */
#ifndef FVI_HESSIAN_BAND_H
#define FVI_HESSIAN_BAND_H

#include <fvi/system.h>

/* Entry (i, j) of a Hessian as the potential of the system writes it. */
static inline double fvi_hessian_entry(const fvi_system *system,
                                       const double *G, size_t i, size_t j)
{
    const size_t w = system->potential.diagonals;
    if (!w)
        return G[i * system->d + j];
    const size_t low = i < j ? i : j, high = i < j ? j : i;
    return high - low < w ? G[low * w + high - low] : 0;
}

/* The neighbours of coordinate j in it: from low to below high. */
static inline void fvi_hessian_reach(const fvi_system *system, size_t j,
                                     size_t *low, size_t *high)
{
    const size_t w = system->potential.diagonals;
    *low = w && j + 1 > w ? j + 1 - w : 0;
    *high = w && j + w < system->d ? j + w : system->d;
}

#endif
