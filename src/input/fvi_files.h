/* src/input/fvi_files.h -- Find out which file a name stands for, and which files were read. */
#ifndef FVI_FILES_H
#define FVI_FILES_H

#include "fvi_refuse.h"

/* fvi_same_file -- Return nonzero if the names a and b stand for the same ordinary file, or for a file that does not
 * exist yet and that both would make. NULL and "-" stand for standard output. The names of terminals, pipes and devices
 * are the same only if the texts are equal. */
int fvi_same_file(const char *a, const char *b);

/* fvi_may_be_ordinary -- Return nonzero if nothing of this name exists, or an ordinary file. Return 0 for a folder, a
 * device or a pipe. */
int fvi_may_be_ordinary(const char *name);

/* fvi_mark_read -- Record that the ordinary file of this name is read for `option`, so that fvi_check_output protects
 * it. `option` is a constant text without dashes, "DATA" for the data of a fit. The last thousand marks are kept. */
void fvi_mark_read(const char *option, const char *name);

/* fvi_read_numbers -- Read d numbers as fvi_parse_numbers does.
 * fvi_read_list -- Read any number of them as fvi_parse_list does.
 * If the text is "@file", record that the file is read for the option `field`, or for DATA if field is "DATA: x0" or
 * the like. */
int fvi_read_numbers(const char *field, const char *text, double low, double high, const char *brackets, size_t d,
                     double *values, fvi_error *c);
int fvi_read_list(const char *field, const char *text, double low, double high, const char *brackets, size_t *count,
                  double **values, fvi_error *c);

/* fvi_marked_files -- Return the number of marks that are kept.
 * fvi_marked_file -- Return the name of the i-th file, from 0; NULL if there was no memory for it.
 * fvi_marked_option -- Return the option for which that file is read. */
size_t fvi_marked_files(void);
const char *fvi_marked_file(size_t i);
const char *fvi_marked_option(size_t i);

/* fvi_check_output -- Refuse an output that would replace a file that was read, under whatever name. `option` has its
 * dashes. A name NULL is standard output, which is not checked because the shell has opened it. Return 0, or a code of
 * fvi/error.h with the error filled in. */
int fvi_check_output(const char *option, const char *name, fvi_error *c);

/* fvi_check_second_file -- Refuse a file name that is empty or stands for the file of the table. `option` is without
 * dashes. A name NULL is accepted. Return as fvi_check_output. */
int fvi_check_second_file(const char *option, const char *name, const char *table, fvi_error *c);

#endif
