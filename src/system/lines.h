/* src/system/lines.h -- Read a text file line by line, and read decimal numbers in a line. */
#ifndef FVI_LINES_H
#define FVI_LINES_H

#include <stddef.h>
#include <stdio.h>

enum {
    FVI_LINE_BYTES = 1 << 26, /* largest length of a line */
    FVI_STREAM_BYTES =
        1 << 28 /* most bytes to read from a pipe or a device, which may never end */
};

/* A text file that is read line by line. fvi_lines_open initialises it. A zeroed one may be closed. */
typedef struct {
    FILE *file;
    char *text;         /* the current line, without its line end */
    size_t room, bytes; /* bytes allocated for text; bytes read so far from a stream */
    size_t number;      /* number of the current line, from 1 */
    size_t column;      /* byte in the line that was refused, from 1 */
    const char *reason; /* reason of the refusal, a static text */
    int is_stream;      /* nonzero if the file is not a regular file */
} fvi_lines;

/* fvi_lines_open -- Open the file. Return nonzero, or 0 with errno set if the file cannot be opened. */
int fvi_lines_open(fvi_lines *lines, const char *name);

/* fvi_lines_next -- Read the next line into lines->text.
 *
 *   found  output: 1 if there is a line; 0 at the end of the file or after a read error (ask ferror)
 *
 * Return FVI_SUCCESS; FVI_ENOMEM; or FVI_EDOM, with column and reason set, for a NUL byte, a carriage return within the
 * line, a line longer than FVI_LINE_BYTES, or more than FVI_STREAM_BYTES from a stream. */
int fvi_lines_next(fvi_lines *lines, int *found);

/* fvi_lines_close -- Close the file and free the line. A second call does nothing. */
void fvi_lines_close(fvi_lines *lines);

/* fvi_lines_decimal -- Read a finite decimal number at the position `at`, for example 1, -.5 or 2.5e-3. `point` is the
 * decimal point, '.' or ','. Hexadecimal numbers and words such as "inf" are refused. A decimal comma in the text is
 * overwritten with '.'. Return the position behind the number, or NULL if there is no number. */
char *fvi_lines_decimal(char *at, char point, double *value);

#endif
