/* src/problem/data.c -- Numbers from files. */
#include "data.h"
#include "rows.h"

#include <fvi/parse.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

static const char blank[] = " \t";

int fvi_data_numbers(const char *field, const char *file, size_t most,
                     double *values, size_t *n, fvi_error *error)
{
    fvi_rows r;
    fvi_rows_kind kind = FVI_ROWS_COMMENT;
    int status = fvi_rows_open(&r, field, file, error);
    *n = 0;
    while (!status && kind != FVI_ROWS_END) {
        status = fvi_rows_next(&r, &kind);
        if (!status && kind == FVI_ROWS_WORDS)
            status = fvi_rows_refuse(&r, 0, FVI_ROWS_NO_NUMBER);
        for (size_t i = 0; !status && i < r.count; i++, ++*n)
            if (*n < most)
                values[*n] = r.values[i];
    }
    fvi_rows_close(&r);
    return status;
}

/* ---- columns by their names ---- */

/* How a line of names may be separated: by whatever there is, or by one sign alone, where names are
 * of several words. */
static const char *const separators[] = { " \t,;", "\t", ",", ";" };
enum { SEPARATORS = sizeof separators / sizeof *separators };

/* The next name of a line: where the line goes on, and the name without blanks and quotes. */
static const char *take_name(const char *line, const char *between,
                             const char **name, size_t *length)
{
    size_t n = strcspn(line, between);
    const char *rest = line + n;
    const int any = between == separators[0];
    if (any)
        rest += strspn(rest, blank);
    if (*rest && strchr(any ? ",;" : between, *rest))
        rest++;
    if (any)
        rest += strspn(rest, blank);
    for (; n > 0 && strchr(blank, *line); n--)
        line++;
    while (n > 0 && strchr(blank, line[n - 1]))
        n--;
    const size_t quoted = n >= 2 && *line == '"';
    *name = line + quoted;
    *length = n - 2 * quoted;
    return rest;
}

/* Columns, and of how many. */
typedef struct {
    size_t column[2], of;
} choice;

/* The columns that a line names if it is separated so; of = 0 if it does not name both. */
static choice choose(const char *line, const char *between,
                     const char *const names[2])
{
    choice to = { { 0, 0 }, 0 };
    int found[2] = { 0, 0 };
    line += strspn(line, "# ");
    if (between == separators[0])
        line += strspn(line, blank);
    for (; *line; to.of++) {
        const char *name;
        size_t length;
        line = take_name(line, between, &name, &length);
        for (int k = 0; k < 2; k++)
            if (!found[k] && length == strlen(names[k])
                && strncasecmp(name, names[k], length) == 0) {
                found[k] = 1;
                to.column[k] = to.of;
            }
    }
    if (!found[0] || !found[1])
        to.of = 0;
    return to;
}

/* What the lines above the rows name: the last line of words that names both columns, and of
 * the comments with so many words the last. A comment may have t and x among its words;
 * names are as many as the numbers. */
enum { WORDS = 1000 };
typedef struct {
    choice heading[SEPARATORS], comment[WORDS];
} names_above;

static void read_names(names_above *above, fvi_rows *r, fvi_rows_kind kind,
                       const char *const names[2])
{
    choice to[SEPARATORS];
    int named = 0;
    for (int i = 0; i < SEPARATORS; i++) {
        to[i] = choose(r->lines.text, separators[i], names);
        named = named || to[i].of;
        if (kind == FVI_ROWS_COMMENT && to[i].of < WORDS)
            above->comment[to[i].of] = to[i];
    }
    if (kind == FVI_ROWS_COMMENT || !named)
        return;
    memcpy(above->heading, to, sizeof to);
    r->between = to[SEPARATORS - 1].of ? ';' : 0;
}

/* Which columns are those of a row of so many numbers? */
static int choose_columns(const names_above *above, const fvi_rows *r,
                          const char *const must[2], choice *to)
{
    int named = 0;
    *to = (choice){ { 0, 1 }, r->count };
    for (int i = SEPARATORS; i-- > 0;) {
        named = named || above->heading[i].of;
        if (above->heading[i].of == r->count) {
            *to = above->heading[i];
            return 0;
        }
    }
    if (named)
        return fvi_rows_refuse(r, 0, "not as many numbers as names above them");
    if (r->count > 0 && r->count < WORDS
        && above->comment[r->count].of == r->count)
        *to = above->comment[r->count];
    else if (must)
        return fvi_fail(r->error, FVI_EINVAL, r->field, NAN,
                        "%s: no columns %s and %s above its numbers",
                        r->name, must[0], must[1]);
    return r->count < 2 ? fvi_rows_refuse(r, 1, FVI_ROWS_TOO_FEW) : 0;
}

/* ---- tables ---- */

/* Room for one more pair. */
static int make_room(size_t n, size_t *room, double **pairs, const fvi_rows *r)
{
    if (n < *room)
        return 0;
    *room = 2 * *room + 256;
    double *more = realloc(*pairs, 2 * *room * sizeof *more);
    if (!more)
        return fvi_fail(r->error, FVI_ENOMEM, r->field, NAN,
                        "not enough memory");
    *pairs = more;
    return 0;
}

/* Both columns of a row of numbers. */
static int take_row(const fvi_rows *r, const choice *from, int is_first,
                    double *pair)
{
    int status = fvi_rows_check_width(r, from->of);
    if (status)
        return status;
    for (int k = 0; k < 2; k++)
        pair[k] = r->values[from->column[k]];
    return is_first || pair[0] > pair[-2]
               ? 0
               : fvi_rows_refuse(r, from->column[0], "t does not increase");
}

/* All rows into pairs t, v. */
static int read_rows(fvi_rows *r, const char *const names[2], int must,
                     size_t *n, double **pairs)
{
    names_above above = { 0 };
    choice from = { { 0, 1 }, 0 };
    fvi_rows_kind kind;
    int status;
    size_t room = 0;
    while (!(status = fvi_rows_next(r, &kind)) && kind != FVI_ROWS_END) {
        if (kind == FVI_ROWS_WORDS && *n > 0)
            return fvi_rows_refuse(r, 0, FVI_ROWS_NO_NUMBER);
        if (kind != FVI_ROWS_NUMBERS) {
            if (*n == 0 && names)
                read_names(&above, r, kind, names);
            continue;
        }
        if (*n == 0)
            status = choose_columns(&above, r, must ? names : NULL, &from);
        if (!status)
            status = make_room(*n, &room, pairs, r);
        if (!status)
            status = take_row(r, &from, *n == 0, *pairs + 2 * *n);
        if (status)
            return status;
        ++*n;
    }
    return status;
}

static int parse_table(const char *field, const char *file,
                       const char *const names[2], int must, size_t *n,
                       double **t, double **v, fvi_error *error)
{
    fvi_rows r;
    double *pairs = NULL;
    *n = 0;
    int status = fvi_rows_open(&r, field, file, error);
    if (!status)
        status = read_rows(&r, names, must, n, &pairs);
    fvi_rows_close(&r);
    if (!status && *n == 0)
        status = fvi_fail(error, FVI_EINVAL, field, NAN, "%s: has no rows",
                          file);
    double *block = !status ? malloc(2 * *n * sizeof *block) : NULL;
    if (!status && !block)
        status = fvi_fail(error, FVI_ENOMEM, field, NAN, "not enough memory");
    for (size_t i = 0; !status && i < *n; i++) {
        block[i] = pairs[2 * i];
        block[*n + i] = pairs[2 * i + 1];
    }
    free(pairs);
    *t = block;
    *v = block ? block + *n : NULL;
    return status;
}

int fvi_parse_table(const char *field, const char *file,
                    const char *const names[2], size_t *n, double **t,
                    double **v, fvi_error *error)
{
    return parse_table(field, file, names, 0, n, t, v, error);
}

int fvi_parse_named_table(const char *field, const char *file,
                          const char *const names[2], size_t *n, double **t,
                          double **v, fvi_error *error)
{
    return parse_table(field, file, names, 1, n, t, v, error);
}
