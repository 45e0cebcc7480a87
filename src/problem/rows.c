/* src/problem/rows.c -- Read rows of numbers from a file. */
#include "rows.h"

#include "system/decimal.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char blank[] = " \t", between[] = " \t,;";

/* Opening and reading need memory of the C library, so ENOMEM is a lack of memory, not a fault of the file. */
static int cannot_read(const fvi_rows *r)
{
    return errno == ENOMEM ? fvi_no_memory(r->error, r->field)
                           : fvi_refuse(r->error, r->field, "cannot read '%s': %s", r->name, strerror(errno));
}

int fvi_rows_open(fvi_rows *r, const char *field, const char *name,
                  fvi_error *error)
{
    *r = (fvi_rows){ .field = field, .name = name, .error = error };
    return fvi_lines_open(&r->lines, name) ? 0 : cannot_read(r);
}

void fvi_rows_close(fvi_rows *r)
{
    fvi_lines_close(&r->lines);
    free(r->values);
    free(r->columns);
    r->values = NULL;
    r->columns = NULL;
}

static int refuse(const fvi_rows *r, size_t column, const char *reason)
{
    return fvi_refuse(r->error, r->field, "%s:%zu:%zu: %s", r->name, r->lines.number, column, reason);
}

static int refuse_at(const fvi_rows *r, const char *at, const char *reason)
{
    return refuse(r, (size_t)(at - r->lines.text) + 1, reason);
}

int fvi_rows_refuse(const fvi_rows *r, size_t i, const char *reason)
{
    const char *text = r->lines.text;
    const size_t column = i < r->count   ? r->columns[i]
                          : r->count > 0 ? strlen(text) + 1
                                         : strspn(text, blank) + 1;
    return refuse(r, column, reason);
}

int fvi_rows_check_width(const fvi_rows *r, size_t width)
{
    return r->count < width ? fvi_rows_refuse(r, r->count, FVI_ROWS_TOO_FEW)
           : r->count > width
               ? fvi_rows_refuse(r, width, "more numbers than columns")
               : 0;
}

/* Store a number that begins at `at`. */
static int append_number(fvi_rows *r, const char *at, double value)
{
    if (r->count == r->room) {
        const size_t room = 2 * r->room + 8;
        double *values = realloc(r->values, room * sizeof *values);
        r->values = values ? values : r->values;
        size_t *columns = realloc(r->columns, room * sizeof *columns);
        r->columns = columns ? columns : r->columns;
        if (!values || !columns)
            return fvi_no_memory(r->error, r->field);
        r->room = room;
    }
    r->columns[r->count] = (size_t)(at - r->lines.text) + 1;
    r->values[r->count++] = value;
    return 0;
}

/* Take a number, which must end at the end of the line or before a separator. */
static int read_number(fvi_rows *r, char **at)
{
    double value;
    char *from = *at, *end = from;
    if (*from == ';' || (*from == ',' && r->between != ';'))
        return refuse_at(r, from, "an empty field");
    const size_t length = strcspn(from, r->between == ';' ? " \t;" : between);
    const char *comma = r->between == ';' ? memchr(from, ',', length) : NULL,
               *mark = comma ? comma : memchr(from, '.', length);
    end = fvi_lines_decimal(from, comma ? ',' : '.', &value);
    if (end != from + length)
        return refuse_at(r, from, FVI_ROWS_NO_NUMBER);
    if (mark && r->point && r->point != (comma ? ',' : '.'))
        return refuse_at(r, mark,
                         comma ? "a decimal comma, where others are points"
                               : "a decimal point, where others are commas");
    if (mark)
        r->point = comma ? ',' : '.';
    *at = end;
    return append_number(r, from, value);
}

/* Skip the gap between two numbers, which contains at most one separator. */
static int skip_gap(fvi_rows *r, char **at)
{
    char *from = *at, *to = from + strspn(from, blank);
    const char here = *to == ';' || *to == ',' ? *to : ' ';
    *at = to;
    if (*to == '\0')
        return 0;
    if (r->between == 0)
        r->between = here;
    if (here != r->between)
        return refuse_at(
            r, here == ' ' ? from : to,
            "numbers are separated in two ways: decimal commas need ';' "
            "between the numbers");
    const char *tab = memchr(from, '\t', (size_t)(to - from));
    if (here == ' ' && tab && memchr(tab + 1, '\t', (size_t)(to - tab) - 1))
        return refuse_at(r, tab + 1, "an empty field");
    if (here != ' ')
        *at = to + 1 + strspn(to + 1, blank);
    return 0;
}

static int read_numbers(fvi_rows *r)
{
    char *text = r->lines.text, *at;
    text[strcspn(text, "#")] = '\0';
    if (r->between == 0 && strchr(text, ';'))
        r->between = ';';
    at = text + strspn(text, " ");
    int status = *at == '\t' ? refuse_at(r, at, "an empty field") : 0;
    for (r->count = 0; !status && *at;) {
        status = read_number(r, &at);
        if (!status)
            status = skip_gap(r, &at);
    }
    return status;
}

/* Return nonzero if a word begins here, not a number, which may be a wrong one. "info" is a word, although it begins
 * with inf. */
static int begins_with_word(const char *line)
{
    char *stop;
    line += strspn(line, between);
    if (*line >= '0' && *line <= '9') /* for most rows this avoids strtod, which is slow */
        return 0;
    const double value = fvi_strtod(line, &stop);
    const int whole = *stop == '\0' || strchr(between, *stop);
    return stop == line || (!isfinite(value) && !whole);
}

int fvi_rows_next(fvi_rows *r, fvi_rows_kind *kind)
{
    int found, status;
    const char *text;
    r->count = 0;
    do {
        status = fvi_lines_next(&r->lines, &found);
        text = r->lines.text;
    } while (!status && found && text[strspn(text, between)] == '\0');
    if (status)
        return status == FVI_ENOMEM
                   ? fvi_no_memory(r->error, r->field)
                   : refuse(r, r->lines.column, r->lines.reason);
    *kind = FVI_ROWS_END;
    if (!found) /* a folder can be opened, and fails when it is read */
        return ferror(r->lines.file) ? cannot_read(r) : 0;
    *kind = text[strspn(text, blank)] == '#' ? FVI_ROWS_COMMENT
            : begins_with_word(text)         ? FVI_ROWS_WORDS
                                             : FVI_ROWS_NUMBERS;
    return *kind == FVI_ROWS_NUMBERS ? read_numbers(r) : 0;
}
