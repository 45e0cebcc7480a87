/* src/memory/history_tiled.h -- Compute the histories of many coordinates in blocks of 32 steps.      [H 28]
 *
 * This header is internal, and its functions check nothing. history_modes.c uses this engine if there are many
 * coordinates. The weights are those of history_modes.c. */
#ifndef FVI_HISTORY_TILED_H
#define FVI_HISTORY_TILED_H

#include "history_kinds.h"

enum {
    FVI_TILE = 16,      /* coordinates in a tile */
    FVI_EIGHT = 8,      /* rows of a product */
    FVI_SLABS = 4,      /* eights in a block of 32 steps, the length of the window */
    FVI_TILES_FROM = 16 /* number of coordinates from which this engine is faster */
};

/* fvi_history_tiled_alloc -- Allocate an engine of d coordinates at rest. [(28.1), (28.2)]
 *
 *   d  number of coordinates, >= 1
 *   Q  number of modes, a multiple of FVI_EIGHT
 *   p  the part of each mode that is lost in a step, 0 <= p <= 1
 *   c  the factor of each mode in the sum at lag 33
 *   w  1, w_1, ..., w_32
 *
 * Memory: 8 (Q + 32) bytes for each coordinate, with d rounded up to a multiple of FVI_TILE, and two tables of
 * 32 Q numbers. Cost: 32 Q exponentials. Every 32nd push does nine tenths of the work of 32 pushes. Return
 * NULL if memory is short. */
fvi_history_head *fvi_history_tiled_alloc(size_t d, size_t Q, const double *p,
                                          const double *c, const double *w);

/* fvi_history_tiled_bytes -- Return the size of the engine in bytes, or SIZE_MAX if it cannot be addressed. */
size_t fvi_history_tiled_bytes(size_t d, size_t Q);

/* fvi_history_tiled_width -- Use vectors of `lanes` doubles, 2, 4 or 8, from now on. The digits do not change.
 * Return nonzero, or 0 if this machine has no vectors of this width. fvi_history_tiled_alloc selects the widest
 * vectors of the machine. */
int fvi_history_tiled_width(fvi_history_head *t, size_t lanes);

#endif
