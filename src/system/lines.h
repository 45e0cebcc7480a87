/* src/system/lines.h -- Text files line by line, and decimal numbers in them. */
#ifndef FVI_LINES_H
#define FVI_LINES_H

#include <stddef.h>
#include <stdio.h>

enum {
    FVI_LINE_BYTES = 1 << 26, /* of a line at most */
    FVI_STREAM_BYTES =
        1 << 28 /* of a pipe or a device at most: it may never end */
};

/* A file that is read line by line. Start with a zeroed one. */
typedef struct {
    FILE *file;
    char *text;         /* the line, without its end */
    size_t room, bytes; /* of text; read so far of a stream */
    size_t number;      /* of the line, from 1 */
    size_t column;      /* of what is refused, from 1, in bytes */
    const char *reason; /* why it is refused, a static text */
    int is_stream;      /* no ordinary file */
} fvi_lines;

/* fvi_lines_open -- returns 0 with errno if the file cannot be opened, else nonzero. */
int fvi_lines_open(fvi_lines *lines, const char *name);

/* fvi_lines_next -- the next line.
 *
 *   found   output: 0 at the end of the file, or where it cannot be read (ferror)
 *
 * Returns FVI_SUCCESS; FVI_EDOM, with column and reason, for a NUL byte, a carriage return
 * within the line, a line or a stream that is too long; FVI_ENOMEM. */
int fvi_lines_next(fvi_lines *lines, int *found);

/* fvi_lines_close -- once more is allowed. */
void fvi_lines_close(fvi_lines *lines);

/* fvi_lines_decimal -- a finite decimal number that begins at `at`: 1, -.5, 2.5e-3, with '.'
 * or ',' for its point; neither hexadecimal numbers nor words. A comma in it becomes '.'.
 * Returns where it ends, or NULL. */
char *fvi_lines_decimal(char *at, char point, double *value);

#endif
