/* src/problem/data.c -- Read numbers and tables from files. */
#include "data.h"
#include "rows.h"

#include <fvi/parse.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

static const char blank[] = " \t";

int fvi_data_numbers(const char *field, const char *file, size_t *n, double **values, fvi_error *error)
{
    fvi_rows r;
    fvi_rows_kind kind = FVI_ROWS_COMMENT;
    size_t room = 0;
    int status = fvi_rows_open(&r, field, file, error);
    *n = 0;
    *values = NULL;
    while (!status && kind != FVI_ROWS_END) {
        status = fvi_rows_next(&r, &kind);
        if (!status && kind == FVI_ROWS_WORDS)
            status = fvi_rows_refuse(&r, 0, FVI_ROWS_NO_NUMBER);
        if (!status && *n + r.count > room) {
            room = 2 * (*n + r.count);
            double *more = realloc(*values, room * sizeof *more);
            status = more ? FVI_SUCCESS : fvi_no_memory(error, field);
            *values = more ? more : *values;
        }
        for (size_t i = 0; !status && i < r.count; i++)
            (*values)[(*n)++] = r.values[i];
    }
    fvi_rows_close(&r);
    return status;
}

/* ---- columns by their names ---- */

/* The ways to separate a line of names: any separators, or only one sign, because names may consist of several
 * words. */
static const char *const separators[] = { " \t,;", "\t", ",", ";" };
enum { SEPARATORS = sizeof separators / sizeof *separators };

/* Find the next name of a line, without blanks and quotes. Return where the line goes on. */
static const char *read_name(const char *line, const char *between,
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

/* The columns to be found. names[k] lists the possible names of column k, such as "omega|w". must_be_named is that of
 * fvi_parse_table_columns. If `increases` is nonzero, the first column must increase. */
enum { COLUMNS = FVI_COLUMNS_MOST };
typedef struct {
    size_t count;
    const char *const *names;
    int must_be_named, increases;
} column_request;

/* The columns that were found: for each its number and which of its names it had. `of` is the number of columns in the
 * table. Of a line that does not name all columns, `words` is the number of its words, `astray` the number, from 1, of
 * a wanted column whose name stands in another place than the first columns would have it, and `missing` a wanted
 * column that it does not name; astray is 0 if there is none. `others`: nonzero if the line names all wanted columns
 * but the first. */
typedef struct {
    unsigned column[COLUMNS], name[COLUMNS], astray, missing;
    int others;
    size_t of, words;
} choice;

/* Return which of the names "a|b|c" the word is, from 0; -1 for none. */
static int name_of(const char *names, const char *word, size_t length)
{
    for (int i = 0; names; i++) {
        const size_t n = strcspn(names, "|");
        if (n == length && strncasecmp(names, word, n) == 0)
            return i;
        names = names[n] ? names + n + 1 : NULL;
    }
    return -1;
}

/* Find the columns that a line names if it is separated in this way. `of` is 0 if it does not name all of them. */
static choice choose_separator_columns(const char *line, const char *between, const column_request *w)
{
    choice to = { .others = 1 };
    int found[COLUMNS] = { 0 };
    line += strspn(line, "# ");
    if (between == separators[0])
        line += strspn(line, blank);
    for (; *line; to.of++) {
        const char *name;
        size_t length;
        line = read_name(line, between, &name, &length);
        for (size_t k = 0; k < w->count; k++) {
            const int which = name_of(w->names[k], name, length);
            if (which >= 0 && to.of != k)
                to.astray = (unsigned)k + 1;
            if (which < 0 || found[k])
                continue;
            found[k] = 1;
            to.column[k] = (unsigned)to.of;
            to.name[k] = (unsigned)which;
        }
    }
    for (size_t k = 0; k < w->count; k++)
        if (!found[k]) {
            to.others &= k == 0;
            to.missing = (unsigned)k;
        }
    to.words = to.of;
    if (!to.others || !found[0])
        to.of = 0;
    to.others &= !found[0];
    return to;
}

/* The names in the lines above the rows: the last line of words that names all columns, the last line of words and, for
 * each number of words, the last comment of that many words that names them. A comment may contain t and x among other
 * words, so it counts only if it has as many words as a row has numbers. If the first name is checked, a comment that
 * names all columns but the first is kept as a line of words, too. `first` is the first word of that line. */
enum { WORDS = 1000, LETTERS = 60 };
typedef struct {
    choice heading[SEPARATORS], partial[SEPARATORS], comment[WORDS];
    char first[SEPARATORS][LETTERS];
} names_above;

/* Keep a line of words for separator i, with its first word. */
static void store_partial_names(names_above *above, const char *line, int i, const choice *to)
{
    const char *name;
    size_t length;
    line += strspn(line, i == 0 ? "# \t" : "# ");
    read_name(line, separators[i], &name, &length);
    snprintf(above->first[i], LETTERS, "%.*s", (int)length, name);
    above->partial[i] = *to;
}

static void read_names(names_above *above, fvi_rows *r, fvi_rows_kind kind, const column_request *w)
{
    choice to[SEPARATORS];
    int named = 0;
    for (int i = 0; i < SEPARATORS; i++) {
        to[i] = choose_separator_columns(r->lines.text, separators[i], w);
        named = named || to[i].of;
        if (kind == FVI_ROWS_COMMENT && to[i].of < WORDS)
            above->comment[to[i].of] = to[i];
        if (kind != FVI_ROWS_COMMENT || (to[i].others && w->must_be_named == FVI_FIRST_NAME_CHECKED))
            store_partial_names(above, r->lines.text, i, &to[i]);
    }
    if (kind == FVI_ROWS_COMMENT || !named)
        return;
    memcpy(above->heading, to, sizeof to);
    r->between = to[SEPARATORS - 1].of ? ';' : 0;
}

/* Find out which name of the first column this is, and refuse another name. */
static int check_first_name(const char *name, const fvi_rows *r, const column_request *w, choice *to)
{
    const int which = name_of(w->names[0], name, strlen(name));
    if (which < 0)
        return fvi_refuse(r->error, r->field, "%s: the first column has the name '%s', which is none of %s", r->name,
                          name, w->names[0]);
    to->name[0] = (unsigned)which;
    return 0;
}

/* Find the columns of a row with r->count numbers. Return 0, or a code with the error filled in. */
static int choose_columns(const names_above *above, const fvi_rows *r, const column_request *w,
                          choice *to)
{
    int named = 0;
    *to = (choice){ .of = r->count };
    for (unsigned k = 0; k < COLUMNS; k++)
        to->column[k] = k;
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
        && above->comment[r->count].of == r->count) {
        *to = above->comment[r->count];
        return 0;
    }
    if (w->must_be_named == FVI_NAMES_NEEDED)
        return w->count == 2
                   ? fvi_refuse(r->error, r->field, "%s: no columns %s and %s above its numbers", r->name,
                              w->names[0], w->names[1])
                   : fvi_refuse(r->error, r->field, "%s: no line names a column '%s'", r->name,
                              w->names[w->count - 1]);
    for (int i = 0; i < SEPARATORS; i++) {
        const choice *line = &above->partial[i];
        const char *astray = line->astray ? w->names[line->astray - 1] : "", *missing = w->names[line->missing];
        if (line->astray && line->words == r->count)
            return fvi_refuse(r->error, r->field, "%s: a line names a column '%.*s' and no '%.*s', so the first "
                              "columns are not what is wanted", r->name, (int)strcspn(astray, "|"), astray,
                              (int)strcspn(missing, "|"), missing);
        if (w->must_be_named == FVI_FIRST_NAME_CHECKED && line->words == r->count)
            return check_first_name(above->first[i], r, w, to);
    }
    return r->count < w->count ? fvi_rows_refuse(r, r->count, FVI_ROWS_TOO_FEW) : 0;
}

/* ---- tables ---- */

/* Make room for one more row of `width` numbers. */
static int make_room(size_t n, size_t width, size_t *room, double **rows, const fvi_rows *r)
{
    if (n < *room)
        return 0;
    *room = 2 * *room + 256;
    double *more = realloc(*rows, width * *room * sizeof *more);
    if (!more)
        return fvi_no_memory(r->error, r->field);
    *rows = more;
    return 0;
}

/* Take the wanted columns of a row of numbers. */
static int read_row(const fvi_rows *r, const choice *from, const column_request *w, int is_first,
                    double *row)
{
    int status = fvi_rows_check_width(r, from->of);
    if (status)
        return status;
    for (size_t k = 0; k < w->count; k++)
        row[k] = r->values[from->column[k]];
    return is_first || !w->increases || row[0] > *(row - w->count)
               ? 0
               : fvi_rows_refuse(r, from->column[0], "t does not increase");
}

/* Read all rows, one after the other. */
static int read_rows(fvi_rows *r, const column_request *w, size_t *n, double **rows, choice *from)
{
    names_above above = { 0 };
    fvi_rows_kind kind;
    int status;
    size_t room = 0;
    while (!(status = fvi_rows_next(r, &kind)) && kind != FVI_ROWS_END) {
        if (kind == FVI_ROWS_WORDS && *n > 0)
            return fvi_rows_refuse(r, 0, FVI_ROWS_NO_NUMBER);
        if (kind != FVI_ROWS_NUMBERS) {
            if (*n == 0 && w->names)
                read_names(&above, r, kind, w);
            continue;
        }
        if (*n == 0)
            status = choose_columns(&above, r, w, from);
        if (!status)
            status = make_room(*n, w->count, &room, rows, r);
        if (!status)
            status = read_row(r, from, w, *n == 0, *rows + w->count * *n);
        if (status)
            return status;
        ++*n;
    }
    return status;
}

/* Read the columns into a block, one column after the other. */
static int read_columns(const char *field, const char *file, const column_request *w, size_t *n,
                        double **block, choice *from, fvi_error *error)
{
    fvi_rows r;
    double *rows = NULL;
    *n = 0;
    int status = fvi_rows_open(&r, field, file, error);
    if (!status)
        status = read_rows(&r, w, n, &rows, from);
    fvi_rows_close(&r);
    if (!status && *n == 0)
        status = fvi_refuse(error, field, "%s: has no rows", file);
    *block = !status ? malloc(w->count * *n * sizeof **block) : NULL;
    if (!status && !*block)
        status = fvi_no_memory(error, field);
    for (size_t i = 0; !status && i < *n; i++)
        for (size_t k = 0; k < w->count; k++)
            (*block)[k * *n + i] = rows[w->count * i + k];
    free(rows);
    return status;
}

static int read_two_columns(const char *field, const char *file, const column_request *two, size_t *n, double **t,
                            double **v, fvi_error *error)
{
    choice from;
    const int status = read_columns(field, file, two, n, t, &from, error);
    *v = *t ? *t + *n : NULL;
    return status;
}

int fvi_parse_table(const char *field, const char *file, const char *const names[2], size_t *n, double **t,
                    double **v, fvi_error *error)
{
    return read_two_columns(field, file, &(column_request){ 2, names, 0, 1 }, n, t, v, error);
}

int fvi_parse_named_table(const char *field, const char *file, const char *const names[2], size_t *n, double **t,
                          double **v, fvi_error *error)
{
    return read_two_columns(field, file, &(column_request){ 2, names, 1, 1 }, n, t, v, error);
}

int fvi_parse_table_columns(const char *field, const char *file, size_t count,
                      const char *const *names, int must_be_named, size_t *n,
                      double **columns, size_t *which, fvi_error *error)
{
    const column_request all = { count, names, must_be_named, 0 };
    choice from = { .of = 0 };
    const int status = read_columns(field, file, &all, n, columns, &from, error);
    for (size_t k = 0; !status && k < count; k++)
        which[k] = from.name[k];
    return status;
}
