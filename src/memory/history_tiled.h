/* src/memory/history_tiled.h -- Thirty-two steps of many memories at once.      [H 28]
 *
 * Internal: what history_modes.c makes of its modes where there are many
 * coordinates; nothing is checked. The weights are those of its own push. */
#ifndef FVI_HISTORY_TILED_H
#define FVI_HISTORY_TILED_H

#include "history_kinds.h"

enum {
    FVI_TILE = 16,      /* the coordinates of a tile */
    FVI_EIGHT = 8,      /* the rows of a product */
    FVI_SLABS = 4,      /* eights in a block: 32 steps, the window */
    FVI_TILES_FROM = 16 /* so many coordinates pay */
};

/* fvi_history_tiled_alloc -- an engine of d coordinates, at rest.            [(28.1), (28.2)]
 *
 *   d        how many coordinates, >= 1
 *   Q        how many modes, a multiple of FVI_EIGHT
 *   p, c     what a mode loses in a step, and what it is worth at lag 33; 0 <= p <= 1
 *   w        1, w_1, ..., w_32
 *
 * Memory 8 (Q + 32) bytes a coordinate, d made up to a multiple of FVI_TILE, and two
 * tables of 32 Q numbers. Cost 32 Q exponentials. Every 32nd push does nine tenths of the work.
 * Returns NULL if there is no memory. */
fvi_history_head *fvi_history_tiled_alloc(size_t d, size_t Q, const double *p,
                                          const double *c, const double *w);

/* fvi_history_tiled_bytes -- what that takes from the heap; SIZE_MAX if it cannot be addressed. */
size_t fvi_history_tiled_bytes(size_t d, size_t Q);

/* fvi_history_tiled_width -- use vectors of `lanes` doubles, 2, 4 or 8, from here on; the digits
 * are the same. Returns 0 if this machine has none so wide, which alloc never takes. */
int fvi_history_tiled_width(fvi_history_head *t, size_t lanes);

#endif
