/* src/memory/history_tiled.h -- Thirty-two steps of many memories at once.      [H 28]
 *
 * Internal: what history_modes.c makes of its modes where there are many
 * coordinates; nothing is checked. The weights are those of its own push. */
#ifndef FVI_HISTORY_TILED_H
#define FVI_HISTORY_TILED_H

#include <fvi/archive.h>
#include <stddef.h>

enum {
    FVI_TILE = 16,      /* the coordinates of a tile */
    FVI_EIGHT = 8,      /* the rows of a product */
    FVI_SLABS = 4,      /* eights in a block: 32 steps, the window */
    FVI_TILES_FROM = 16 /* so many coordinates pay */
};

typedef struct fvi_history_tiled fvi_history_tiled;

/* fvi_history_tiled_alloc -- a memory of d coordinates, at rest.             [(28.1), (28.2)]
 *
 *   d        how many coordinates, >= 1
 *   Q        how many modes, a multiple of FVI_EIGHT
 *   p, c     what a mode loses in a step, and what it is worth at lag 33; 0 <= p <= 1
 *   w        1, w_1, ..., w_32
 *
 * Memory 8 (Q + 32) bytes a coordinate, d made up to a multiple of FVI_TILE, and two
 * tables of 32 Q numbers. Cost 32 Q exponentials. Returns NULL if there is no memory. */
fvi_history_tiled *fvi_history_tiled_alloc(size_t d, size_t Q, const double *p, const double *c,
                           const double *w);

/* fvi_history_tiled_bytes -- what that takes from the heap; SIZE_MAX if it cannot be addressed. */
size_t fvi_history_tiled_bytes(size_t d, size_t Q);

/* fvi_history_tiled_copy -- the same again, or NULL. */
fvi_history_tiled *fvi_history_tiled_copy(const fvi_history_tiled *from);

/* fvi_history_tiled_width -- use vectors of `lanes` doubles, 2, 4 or 8, from here on; the digits
 * are the same. Returns 0 if this machine has none so wide, which alloc never takes. */
int fvi_history_tiled_width(fvi_history_tiled *t, size_t lanes);

/* fvi_history_tiled_push_part -- the push of `count` coordinates from `first` on, as
 * fvi_history_push_part (history_parts.h); term and H are of these alone. */
void fvi_history_tiled_push_part(fvi_history_tiled *t, size_t first, size_t count,
                         const double *term, double *H);

/* fvi_history_tiled_push, fvi_history_tiled_ahead, fvi_history_tiled_archive, fvi_history_tiled_free -- as the kinds of
 * history_kinds.h. H may be term. Every 32nd push does nine tenths of the work. */
void fvi_history_tiled_push(fvi_history_tiled *t, const double *term, double *H);
void fvi_history_tiled_ahead(const fvi_history_tiled *t, double *sum);
int fvi_history_tiled_archive(fvi_history_tiled *t, size_t k, fvi_archive *v);
void fvi_history_tiled_free(fvi_history_tiled *t);

#endif
