/* src/output/fvi_output.h -- Write files that are complete or do not appear at all. */
#ifndef FVI_OUTPUT_H
#define FVI_OUTPUT_H

#include <stdio.h>

/* fvi_output_open -- Open the output of the program for writing.
 *
 *   name  name of a file; NULL or "-" for standard output
 *
 * An ordinary file is written without a name in its folder, and fvi_output_close gives it its name. So nothing is left
 * of it if the program is killed. On some systems a file cannot be without a name: outside Linux, without /proc, and on
 * some network file systems. There its name is .fvi-XXXXXX until it is complete, with letters that no other file has. A
 * signal that can be caught removes this file, and SIGKILL leaves it.
 * The file has the permissions of the file that it replaces and, where that is allowed, its owner. It is on the disk
 * before it has its name. If the old file has several names (hard links), they stay: the complete file is copied into
 * the old one. During the copy it also exists as .fvi-XXXXXX. So if SIGKILL leaves a torn file, the complete file is
 * there, too.
 * A name that is no ordinary file (a pipe, a device), and a file that is open already (/dev/stdout), is written to
 * directly. A link to a name that does not exist is refused.
 * Return the stream, or NULL with errno set. At most four ordinary files can be open at a time. */
FILE *fvi_output_open(const char *name);

/* fvi_output_open_file -- Do the same for an output that must be an ordinary file. For others return NULL with errno
 * EEXIST. */
FILE *fvi_output_open_file(const char *name);

/* fvi_output_waits -- Return nonzero if the stream is an ordinary file that has its final name only after
 * fvi_output_close. Until then it can also be read. */
int fvi_output_waits(FILE *stream);

/* fvi_output_close -- If keep is nonzero, flush the file, check for errors, and give it its name. Else remove it.
 * Return 0, or -1 with errno set. After an error no file is left behind. */
int fvi_output_close(FILE *stream, int keep);

/* fvi_progress -- Show the progress: step k of `steps`. After the first second this is a line on standard error, if
 * that is a terminal. It contains the seconds that are left if each step takes as long as the steps so far.
 * fvi_progress_clear -- Remove that line. */
void fvi_progress(size_t k, size_t steps);
void fvi_progress_clear(void);

#endif
