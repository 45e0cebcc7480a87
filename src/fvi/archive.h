/* src/fvi/archive.h -- Save a run, and load it again, piece by piece.     [H 2]
 *
 * fvi_stepper_archive (trajectory.h) shows an archive every piece of memory that the steps of a run change. The archive
 * copies the pieces to a place of its own, for example a file, or copies them back into a run that was started anew.
 *
 *     typedef struct { fvi_archive archive; FILE *file; } file_archive;   // the fvi_archive is the first field
 *     static int to_file(fvi_archive *archive, void *data, size_t bytes, int constant)
 *     {
 *         (void)constant;   // to save, write all pieces alike
 *         return fwrite(data, 1, bytes, ((file_archive *)archive)->file) == bytes ? 0 : -1;
 *     }
 *     file_archive saving = { { to_file }, file };
 *     status = fvi_stepper_archive(s, &saving.archive);
 *
 * To go on later, start the same run and load the pieces. A function that loads compares the pieces that are constant,
 * and overwrites the other pieces. Here `file` stands again at the first piece.
 *
 *     static int from_file(fvi_archive *archive, void *data, size_t bytes, int constant)
 *     {
 *         for (unsigned char *byte = data, *end = byte + bytes; byte < end; byte++) {
 *             const int saved = getc(((file_archive *)archive)->file);
 *             if (saved == EOF || (constant && saved != *byte))
 *                 return -1;   // the file is too short, or was saved by another run
 *             if (!constant)
 *                 *byte = (unsigned char)saved;
 *         }
 *         return 0;
 *     }
 *     file_archive loading = { { from_file }, file };
 *     status = fvi_stepper_start(method, &run, &s, &error);
 *     if (!status)
 *         status = fvi_stepper_archive(s, &loading.archive); */
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
