/* src/input/fvi_files.h -- Which file does a name stand for? */
#ifndef FVI_FILES_H
#define FVI_FILES_H

#include "fvi_refuse.h"

/* fvi_same_file -- nonzero if the names a and b, which may differ, stand for one ordinary file
 * that is there, or for one that both would make; NULL and "-" stand for standard output. Names of
 * terminals, pipes and devices are the same only if they are equal. */
int fvi_same_file(const char *a, const char *b);

/* fvi_may_be_ordinary -- nonzero if nothing of this name is there, or an ordinary file: no folder, no device, no pipe. */
int fvi_may_be_ordinary(const char *name);

/* fvi_mark_read -- note, for fvi_check_output, that the ordinary file of this name is read
 * for `option`, a constant without dashes, DATA for that of a fit. The last thousand marks are
 * kept. */
void fvi_mark_read(const char *option, const char *name);

/* fvi_marked_files -- how many marks are kept.
 * fvi_marked_file -- the name of the i-th, from 0; NULL if there was no memory for it.
 * fvi_marked_option -- for which option it is read. */
size_t fvi_marked_files(void);
const char *fvi_marked_file(size_t i);
const char *fvi_marked_option(size_t i);

/* fvi_check_output -- refuse an output that would take the place of what was read, by
 * whatever name. `option` is with its dashes; name NULL is standard output, which a shell
 * has opened. Returns 0, or 2 with a complaint. */
int fvi_check_output(const char *option, const char *name, fvi_error *c);

/* fvi_check_second_file -- refuse, for an option without dashes, a name that is empty, or that of the table's file.
 * Without a name nothing is refused. */
int fvi_check_second_file(const char *option, const char *name, const char *table, fvi_error *c);

#endif
