/* src/fvi/archive.h -- What the steps of a run change, piece by piece.     [H 2] */
#ifndef FVI_ARCHIVE_H
#define FVI_ARCHIVE_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/* fvi_archive -- who is shown the pieces. A user of the library fills it in, perhaps as
 * the first field of a struct with more:
 *
 *   serialize  is called for each piece, always in the same order. constant == 0: steps change this piece. The
 *              user may read it, to save a run, or write what was saved. constant != 0: steps do not change it, and
 *              it must be the same in a run that goes on with the other pieces. Returns 0, or a code that ends the
 *              calls */
typedef struct fvi_archive fvi_archive;
struct fvi_archive {
    int (*serialize)(fvi_archive *archive, void *data, size_t bytes, int constant);
};

#ifdef __cplusplus
}
#endif

#endif
