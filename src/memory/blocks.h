/* src/memory/blocks.h -- Thirty-two steps of many memories at once.      [Chapter 28]
 *
 * Internal: what memory_exponentials.c makes of its modes where there are many
 * coordinates; nothing is checked. The weights are those of its own push. */
#ifndef FVI_BLOCKS_H
#define FVI_BLOCKS_H

#include <fvi/visit.h>
#include <stddef.h>

enum {
    FVI_TILE = 16,      /* the coordinates of a tile */
    FVI_EIGHT = 8,      /* the rows of a product */
    FVI_SLABS = 4,      /* eights in a block: 32 steps, the window */
    FVI_TILES_FROM = 16 /* so many coordinates pay */
};

typedef struct fvi_tiles fvi_tiles;

/* fvi_tiles_alloc -- a memory of d coordinates, at rest.             [(28.1), (28.2)]
 *
 *   d        how many coordinates, >= 1
 *   Q        how many modes, a multiple of FVI_EIGHT
 *   p, c     what a mode loses in a step, and what it is worth at lag 33; 0 <= p <= 1
 *   w        1, w_1, ..., w_32
 *
 * Memory 8 (Q + 32) bytes a coordinate, d made up to a multiple of FVI_TILE, and two
 * tables of 32 Q numbers. Cost 32 Q exponentials. Returns NULL if there is no memory. */
fvi_tiles *fvi_tiles_alloc(size_t d, size_t Q, const double *p, const double *c,
                           const double *w);

/* fvi_tiles_bytes -- what that takes from the heap; SIZE_MAX if it cannot be addressed. */
size_t fvi_tiles_bytes(size_t d, size_t Q);

/* fvi_tiles_copy -- the same again, or NULL. */
fvi_tiles *fvi_tiles_copy(const fvi_tiles *from);

/* fvi_tiles_width -- use vectors of `lanes` doubles, 2, 4 or 8, from here on; the digits
 * are the same. Returns 0 if this machine has none so wide, which alloc never takes. */
int fvi_tiles_width(fvi_tiles *t, size_t lanes);

/* fvi_tiles_push_part -- the push of `count` coordinates from `first` on, as
 * fvi_memory_push_part (memory_parts.h); term and H are of these alone. */
void fvi_tiles_push_part(fvi_tiles *t, size_t first, size_t count,
                         const double *term, double *H);

/* fvi_tiles_push, fvi_tiles_ahead, fvi_tiles_visit, fvi_tiles_free -- as the kinds of
 * memory_kinds.h. H may be term. Every 32nd push does nine tenths of the work. */
void fvi_tiles_push(fvi_tiles *t, const double *term, double *H);
void fvi_tiles_ahead(const fvi_tiles *t, double *sum);
int fvi_tiles_visit(fvi_tiles *t, size_t k, fvi_visitor *v);
void fvi_tiles_free(fvi_tiles *t);

#endif
