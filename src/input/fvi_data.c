/* src/input/fvi_data.c -- Numbers from files. */
#define _GNU_SOURCE /* getline */
#include "fvi_data.h"
#include "fvi_files.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

static const char blank[] = " \t\r\n\v\f", between[] = " \t\r\n\v\f,;";

/* A file that is read line by line. */
typedef struct {
    const char *option, *name;
    FILE *file;
    char *line;
    size_t room, number; /* of the line, from 1 */
    fvi_complaint c;
} reader;

static int begin(reader *r)
{
    fvi_mark_read(r->option, r->name);
    r->file = fopen(r->name, "r");
    return r->file ? 0
                   : fvi_refuse(r->c, "--%s: cannot read '%s': %s", r->option,
                                r->name, strerror(errno));
}

/* Nonzero while there is a line. Spreadsheets begin a file with a mark of its encoding. */
static int next_line(reader *r)
{
    static const char mark[] = "\xef\xbb\xbf";
    const ssize_t length = getline(&r->line, &r->room, r->file);
    if (++r->number == 1 && length >= 3 && memcmp(r->line, mark, 3) == 0)
        memmove(r->line, r->line + 3, (size_t)length - 2);
    return length >= 0;
}

/* A folder opens, and fails when it is read. */
static int end(reader *r, int status)
{
    if (!status && ferror(r->file))
        status = fvi_refuse(r->c, "--%s: cannot read '%s': %s", r->option,
                            r->name, strerror(errno));
    free(r->line);
    fclose(r->file);
    return status;
}

/* Behind a number or a word stand blanks, and at most one comma. */
static size_t gap(const char *at)
{
    const size_t blanks = strspn(at, blank);
    const int comma = at[blanks] == ',' || at[blanks] == ';';
    return blanks + (comma ? 1 + strspn(at + blanks + 1, blank) : 0);
}

/* The next number of the line: 1, 0 at its end, -1 if what stands there is none. */
static int next_number(char **at, double *value)
{
    char *stop;
    *at += strspn(*at, blank);
    if (**at == '\0')
        return 0;
    *value = strtod(*at, &stop);
    const int is = stop != *at && isfinite(*value)
                   && (*stop == '\0' || strchr(between, *stop));
    *at = stop + gap(stop);
    return is ? 1 : -1;
}

int fvi_data_numbers(const char *option, const char *file, size_t most,
                     double *values, size_t *n, fvi_complaint c)
{
    reader r = { .option = option, .name = file, .c = c };
    int status = begin(&r), found;
    if (status)
        return status;
    *n = 0;
    while (!status && next_line(&r)) {
        double value;
        char *at = r.line;
        at[strcspn(at, "#")] = '\0';
        for (; (found = next_number(&at, &value)) > 0; ++*n)
            if (*n < most)
                values[*n] = value;
        if (found < 0)
            status = fvi_refuse(c, "--%s: %s:%zu: not a finite number", option,
                                file, r.number);
    }
    return end(&r, status);
}

/* ---- tables ---- */

/* The number of a word in a line of words, or -1. */
static int column_of(const char *line, const char *word)
{
    const size_t length = strlen(word);
    for (int i = 0; *line; i++) {
        const size_t here = strcspn(line, between);
        const size_t quoted = here >= 2 && *line == '"';
        if (here == length + 2 * quoted
            && strncasecmp(line + quoted, word, length) == 0)
            return i;
        line += here;
        line += gap(line);
    }
    return -1;
}

/* How many words, or numbers. */
static int words_of(const char *line)
{
    int n = 0;
    for (line += strspn(line, blank); *line; n++) {
        line += strcspn(line, between);
        line += gap(line);
    }
    return n;
}

/* Both columns of a row of numbers. */
static int row(reader *r, const int column[2], double pair[2])
{
    char *at = r->line;
    double value;
    const int last = column[0] > column[1] ? column[0] : column[1];
    for (int i = 0; i <= last; i++) {
        const int found = next_number(&at, &value);
        if (found <= 0)
            return fvi_refuse(
                r->c, "--%s: %s:%zu: %s", r->option, r->name, r->number,
                found ? "not a finite number" : "a number is missing");
        for (int k = 0; k < 2; k++)
            if (i == column[k])
                pair[k] = value;
    }
    return 0;
}

/* Does a line of words stand here, not one that begins with a number, be it a wrong one?
 * "info" is none, though it begins with inf. */
static int is_heading(const char *line)
{
    char *stop;
    line += strspn(line, between);
    const double value = strtod(line, &stop);
    const int whole = *stop == '\0' || strchr(between, *stop);
    return stop == line || (!isfinite(value) && !whole);
}

/* Columns, and of how many; of names behind # at most WORDS - 1. */
enum { WORDS = 1000 };
typedef struct {
    int column[2], of;
} choice;

/* The columns that a line of words names, if it names both. */
static void choose(const char *line, const char *const names[2], choice *to)
{
    line += strspn(line, "# \t");
    const int t = names ? column_of(line, names[0]) : -1,
              v = t >= 0 ? column_of(line, names[1]) : -1;
    if (v >= 0)
        *to = (choice){ { t, v }, words_of(line) };
}

/* All rows into pairs t, v. */
static int rows(reader *r, const char *const names[2], size_t *n,
                double **pairs)
{
    choice named = { { 0, 1 }, 0 }, behind[WORDS] = { 0 }, comment;
    int status = 0;
    size_t room = 0;
    while (!status && next_line(r)) {
        if (r->line[strspn(r->line, between)] == '\0')
            continue;
        if (*r->line == '#') {
            comment.of = 0;
            choose(r->line, *n == 0 ? names : NULL, &comment);
            behind[comment.of < WORDS ? comment.of : 0] = comment;
            continue;
        }
        if (*n == 0 && is_heading(r->line)) {
            choose(r->line, names, &named);
            continue;
        }
        /* A comment may have t and x among its words; names are as many as the numbers. */
        const int words = *n == 0 && named.of == 0 ? words_of(r->line) : 0;
        if (words < WORDS && words > 0 && behind[words].of == words)
            named = behind[words];
        if (*n == room) {
            room = 2 * room + 256;
            double *more = realloc(*pairs, 2 * room * sizeof *more);
            if (!more) {
                fvi_refuse(r->c, "not enough memory");
                return 1;
            }
            *pairs = more;
        }
        double *pair = *pairs + 2 * *n;
        status = row(r, named.column, pair);
        if (!status && *n > 0 && !(pair[0] > pair[-2]))
            status = fvi_refuse(r->c, "--%s: %s:%zu: t does not increase",
                                r->option, r->name, r->number);
        ++*n;
    }
    return status;
}

int fvi_data_table(const char *option, const char *file,
                   const char *const names[2], size_t *n, double **t,
                   double **v, fvi_complaint c)
{
    reader r = { .option = option, .name = file, .c = c };
    double *pairs = NULL;
    int status = begin(&r);
    *n = 0;
    if (status)
        return status;
    status = end(&r, rows(&r, names, n, &pairs));
    if (!status && *n == 0)
        status = fvi_refuse(c, "--%s: %s: has no rows", option, file);
    double *block = !status ? malloc(2 * *n * sizeof *block) : NULL;
    if (!status && !block) {
        fvi_refuse(c, "not enough memory");
        status = 1;
    }
    for (size_t i = 0; !status && i < *n; i++) {
        block[i] = pairs[2 * i];
        block[*n + i] = pairs[2 * i + 1];
    }
    free(pairs);
    *t = block;
    *v = block ? block + *n : NULL;
    return status;
}
