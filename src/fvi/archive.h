/* src/fvi/archive.h -- Save a run, and load it again, piece by piece.     [H 2]
 *
 * fvi_stepper_archive (trajectory.h) shows an archive every piece of memory that the steps of a run change. The archive
 * copies the pieces to a place of its own, for example a file, or copies them back into a run that was started anew.
 *
 *     static int to_file(fvi_archive *archive, void *data, size_t bytes, int constant)
 *     {
 *         return fwrite(data, 1, bytes, ((file_archive *)archive)->file) == bytes ? 0 : -1;
 *     }
 *     file_archive archive = { { to_file }, file };              a struct whose first field is an fvi_archive
 *     status = fvi_stepper_archive(s, &archive.archive); */
#ifndef FVI_ARCHIVE_H
#define FVI_ARCHIVE_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/* fvi_archive -- the receiver of the pieces. A user of the library fills it in, and may make it the first field of a
 * larger struct.
 *
 *   serialize  is called once for each piece, always in the same order. `data` points to `bytes` bytes, which belong to
 *              the run. constant == 0: the steps change this piece. To save a run, read it; to load a run, overwrite it
 *              with the bytes that were saved. constant != 0: the steps do not change this piece. To save a run, read
 *              it; to load a run, compare it with the bytes that were saved, because a run that differs here cannot go
 *              on with the other pieces. Returns 0; any other number ends the calls, and the function that made the
 *              calls returns this number */
typedef struct fvi_archive fvi_archive;
struct fvi_archive {
    int (*serialize)(fvi_archive *archive, void *data, size_t bytes, int constant);
};

#ifdef __cplusplus
}
#endif

#endif
