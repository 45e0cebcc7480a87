/* src/system/lines.c -- Read a text file line by line, and read decimal numbers in a line. */
#define _GNU_SOURCE /* for getc_unlocked */
#include "lines.h"

#include "decimal.h"

#include <fvi/error.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

int fvi_lines_open(fvi_lines *l, const char *name)
{
    struct stat file;
    *l = (fvi_lines){ .file = fopen(name, "r") };
    if (l->file)
        l->is_stream =
            fstat(fileno(l->file), &file) != 0 || !S_ISREG(file.st_mode);
    return l->file != NULL;
}

static int refuse(fvi_lines *l, size_t column, const char *reason)
{
    l->column = column;
    l->reason = reason;
    return FVI_EDOM;
}

/* Make room for one more byte and a NUL behind it. */
static int make_room(fvi_lines *l, size_t length)
{
    if (length + 2 <= l->room)
        return FVI_SUCCESS;
    const size_t room = 2 * l->room + 256;
    char *more = realloc(l->text, room);
    if (!more)
        return FVI_ENOMEM;
    l->text = more;
    l->room = room;
    return FVI_SUCCESS;
}

/* Finish the line. Spreadsheets begin a file with a byte order mark and end lines with \r\n, so both are removed. */
static int finish(fvi_lines *l, size_t length)
{
    static const char mark[] = "\xef\xbb\xbf";
    if (length > 0 && l->text[length - 1] == '\r')
        length--;
    l->text[length] = '\0';
    if (l->number == 1 && length >= 3 && memcmp(l->text, mark, 3) == 0)
        memmove(l->text, l->text + 3, length - 2);
    const char *within = strchr(l->text, '\r');
    return within ? refuse(l, (size_t)(within - l->text) + 1,
                           "a carriage return within the line")
                  : FVI_SUCCESS;
}

/* Read the bytes of a line, and skip the line end. */
static int read_bytes(fvi_lines *l, size_t *length)
{
    int byte;
    for (*length = 0; (byte = getc_unlocked(l->file)) != EOF; ++*length) {
        if (l->is_stream && ++l->bytes > FVI_STREAM_BYTES)
            return refuse(l, *length + 1,
                          "more than 256 MiB from what is no ordinary file");
        if (byte == '\n')
            break;
        if (byte == '\0')
            return refuse(l, *length + 1, "a NUL byte: this is no text");
        if (*length == FVI_LINE_BYTES)
            return refuse(l, *length + 1, "a line of more than 64 MiB");
        if (*length + 2 > l->room && make_room(l, *length))
            return FVI_ENOMEM;
        l->text[*length] = (char)byte;
    }
    return make_room(l, *length);
}

int fvi_lines_next(fvi_lines *l, int *found)
{
    size_t length;
    l->number++;
    int status = read_bytes(l, &length);
    *found = !status && !ferror(l->file) && (length > 0 || !feof(l->file));
    return *found ? finish(l, length) : status;
}

void fvi_lines_close(fvi_lines *l)
{
    if (l->file)
        fclose(l->file);
    free(l->text);
    l->file = NULL;
    l->text = NULL;
}

/* Skip digits. Return their number. */
static size_t digits(char **at)
{
    const size_t n = strspn(*at, "0123456789");
    *at += n;
    return n;
}

char *fvi_lines_decimal(char *at, char point, double *value)
{
    char *end = at + (*at == '+' || *at == '-'), *comma = NULL, *stop;
    size_t n = digits(&end);
    if (*end == point) {
        comma = point == ',' ? end : NULL;
        end++;
        n += digits(&end);
    }
    if (n == 0)
        return NULL;
    if (*end == 'e' || *end == 'E') {
        end += 1 + (end[1] == '+' || end[1] == '-');
        if (digits(&end) == 0)
            return NULL;
    }
    if (comma)
        *comma = '.';
    *value = fvi_strtod(at, &stop);
    return stop == end && isfinite(*value) ? end : NULL;
}
