/* src/command_run/fvi_checkpoint_head.h -- Write and compare the heads of checkpoints, which say to which run a
 * checkpoint belongs. */
#ifndef FVI_CHECKPOINT_HEAD_H
#define FVI_CHECKPOINT_HEAD_H

#include "options/fvi_option_list.h"

#include <stdint.h>
#include <stdio.h>

/* fvi_add_to_sum -- Return the checksum of the data before, whose checksum is `sum`, followed by these bytes. The
 * checksum of no data is FVI_FIRST_SUM. */
#define FVI_FIRST_SUM 0xcbf29ce484222325u
uint64_t fvi_add_to_sum(uint64_t sum, const void *data, size_t bytes);

/* fvi_checkpoint_head -- Return the head of this run: a line with the version, a line for each option, a line for each
 * file that was read, and an empty line. The caller frees the text. NULL if there is no memory. */
char *fvi_checkpoint_head(const fvi_options *o);

/* fvi_checkpoint_compare -- Read the head of a file line by line, and print where it first differs from `head`. Return
 * 0 if it does not differ, 1 after a message if there is no memory, and 2 after a message if it differs or cannot be
 * read. */
int fvi_checkpoint_compare(const fvi_options *o, FILE *file, const char *head);

/* fvi_checkpoint_refuse -- Print why --continue is not possible. Return 2.
 * fvi_checkpoint_unreadable -- Print that the file cannot be read, with the reason in errno. Return 2, or 1 if the
 * reason is that there is no memory. */
int fvi_checkpoint_refuse(const fvi_options *o, const char *why);
int fvi_checkpoint_unreadable(const fvi_options *o);

#endif
