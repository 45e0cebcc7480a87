/* src/system/archive_pieces.h -- Serialise several pieces of memory of a run, one after another. */
#ifndef FVI_ARCHIVE_PIECES_H
#define FVI_ARCHIVE_PIECES_H

#include <fvi/archive.h>

typedef struct {
    void *data;
    size_t bytes;
    int constant;
} fvi_piece;

/* fvi_serialize_pieces -- Call v->serialize for each piece in turn, until a call returns a code that is not 0. Return
 * this code, or 0 if every call returned 0.
 * FVI_SERIALIZE -- Do the same for a list of pieces. FVI_STATE is a variable that steps change, and FVI_CONSTANT is a
 * variable that steps do not change. FVI_STATES and FVI_CONSTANTS are the n elements of an array. For example
 *
 *     status = FVI_SERIALIZE(v, FVI_CONSTANT(Q), FVI_STATE(k), FVI_STATES(z, n)); */
static inline int fvi_serialize_pieces(fvi_archive *v, size_t pieces, const fvi_piece *piece)
{
    int status = 0;
    for (size_t i = 0; !status && i < pieces; i++)
        status = v->serialize(v, piece[i].data, piece[i].bytes, piece[i].constant);
    return status;
}

#define FVI_SERIALIZE(v, ...)                                                                                        \
    fvi_serialize_pieces(v, sizeof((const fvi_piece[]){ __VA_ARGS__ }) / sizeof(fvi_piece),                          \
                         (const fvi_piece[]){ __VA_ARGS__ })
#define FVI_CONSTANT(x) { (void *)&(x), sizeof(x), 1 }
#define FVI_CONSTANTS(x, n) { (void *)(x), (n) * sizeof *(x), 1 }
#define FVI_STATE(x) { &(x), sizeof(x), 0 }
#define FVI_STATES(x, n) { x, (n) * sizeof *(x), 0 }

#endif
