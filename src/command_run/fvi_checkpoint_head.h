/* src/command_run/fvi_checkpoint_head.h -- Of which run is a checkpoint? */
#ifndef FVI_CHECKPOINT_HEAD_H
#define FVI_CHECKPOINT_HEAD_H

#include "options/fvi_option_list.h"

#include <stdint.h>
#include <stdio.h>

/* fvi_add_to_sum -- the checksum of what was before and of these bytes; FVI_FIRST_SUM is that of
 * nothing. */
#define FVI_FIRST_SUM 0xcbf29ce484222325u
uint64_t fvi_add_to_sum(uint64_t sum, const void *data, size_t bytes);

/* fvi_checkpoint_head -- the version, what was asked for and what stood in the files that were
 * read for it, a line each, then an empty line; a text of its own. NULL if there is no
 * memory. */
char *fvi_checkpoint_head(const fvi_options *o);

/* fvi_checkpoint_compare -- read the head of a file, line by line, and say where it first
 * differs from this one. Returns 0 if it does not; 1, said, if there is no memory to read it; or 2. */
int fvi_checkpoint_compare(const fvi_options *o, FILE *file, const char *head);

/* fvi_checkpoint_refuse -- why --continue cannot; returns 2.
 * fvi_checkpoint_unreadable -- the same of a file that cannot be read, as errno says; 1 if there is
 * no memory to read it. */
int fvi_checkpoint_refuse(const fvi_options *o, const char *why);
int fvi_checkpoint_unreadable(const fvi_options *o);

#endif
