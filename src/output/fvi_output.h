/* src/output/fvi_output.h -- A file that is complete or not there at all. */
#ifndef FVI_OUTPUT_H
#define FVI_OUTPUT_H

#include <stdio.h>

/* fvi_output_open -- where the program writes.
 *
 *   name  a file's name; NULL or "-" for standard output
 *
 * An ordinary file is written without a name in its folder and takes its name in
 * fvi_output_close: nothing is left of it if the program is killed. Where a file cannot be
 * without a name (not on Linux, no /proc, some network file systems) it is .fvi-XXXXXX,
 * a name that no other file has, which a signal that can be caught removes, and SIGKILL
 * leaves. It has the permissions of the file that it replaces and, where that is allowed,
 * its owner. It is on the disk before it has its name. A file of several names (hard links)
 * keeps them: the complete file is copied into it, and while that lasts it is .fvi-XXXXXX,
 * too, so that SIGKILL tears the old one only where the new one is there. What is no
 * ordinary file (a pipe, a device), and a file that is open already (/dev/stdout), is
 * written to as it stands; a link that leads nowhere is refused.
 * Returns the stream, or NULL with errno set. At most four ordinary files at a time. */
FILE *fvi_output_open(const char *name);

/* fvi_output_open_file -- the same for what must be an ordinary file: EEXIST for others. */
FILE *fvi_output_open_file(const char *name);

/* fvi_output_waits -- nonzero if what is written here is in no file of the user's before
 * fvi_output_close. It can then be read, too. */
int fvi_output_waits(FILE *stream);

/* fvi_output_close -- keep != 0: flush, check, put in place; else remove.
 * Returns 0, or -1 with errno set and nothing left behind. */
int fvi_output_close(FILE *stream, int keep);

/* fvi_progress -- at step k of `steps`: after the first second a line on standard
 * error, if that is a terminal, with the seconds that are left if each step costs as much
 * as the steps so far. fvi_progress_clear takes it away again. */
void fvi_progress(size_t k, size_t steps);
void fvi_progress_clear(void);

#endif
