/* src/problem/directory_force.c -- Read the forces of a folder from f.tsv. */
#define _GNU_SOURCE /* for PATH_MAX */
#include "directory_state.h"

#include "polygon.h"
#include "rows.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char between[] = " \t\r,;";

/* Choose the columns 1 to d. */
static int select_all_columns(loads *l, size_t d)
{
    l->unknown = malloc(d * sizeof *l->unknown);
    for (l->width = 0; l->unknown && l->width < d; l->width++)
        l->unknown[l->width] = l->width;
    return l->unknown ? FVI_SUCCESS : FVI_ENOMEM;
}

/* Return nonzero if a line with # contains names such as "t f3 f7", not a comment. */
static int names_columns(const char *line)
{
    const char *at = line + strspn(line, "# \t");
    const char *next = at + 1 + (*at == 't' ? strspn(at + 1, between) : 0);
    return *at == 't' && next > at + 1 && *next == 'f' && next[1] >= '0'
           && next[1] <= '9';
}

/* Refuse an error in the line of names. */
static int refuse_name(const fvi_rows *r, const char *at, const char *reason)
{
    return fvi_refuse(r->error, "system", "%s:%zu:%zu: %s", r->name, r->lines.number, (size_t)(at - r->lines.text) + 1,
                      reason);
}

/* Read names such as "t f3 f7", with or without #. */
static int named_columns(const fvi_rows *r, loads *l, size_t d)
{
    char *at = r->lines.text + strspn(r->lines.text, "# \t"), *stop;
    if (*at != 't' || !at[1] || !strchr(between, at[1]))
        return refuse_name(r, at, "names are t, then f1, f2, ...");
    l->unknown = malloc(d * sizeof *l->unknown);
    if (!l->unknown)
        return FVI_ENOMEM;
    for (at++; *(at += strspn(at, between)); at = stop) {
        const int digit = *at == 'f' && at[1] >= '0' && at[1] <= '9';
        const size_t i = digit ? strtoul(at + 1, &stop, 10) : 0;
        if (!digit || !strchr(between, *stop) || i < 1 || i > d)
            return refuse_name(r, at, "a name that is none of the unknowns'");
        for (size_t k = 0; k < l->width; k++)
            if (l->unknown[k] == i - 1)
                return refuse_name(r, at, "an unknown that is named twice");
        l->unknown[l->width++] = i - 1;
    }
    return l->width > 0 ? 0
                        : refuse_name(r, at, "names are t, then f1, f2, ...");
}

/* Take a row of numbers. t must increase. */
static int read_row(const fvi_rows *r, loads *l, size_t *room)
{
    const size_t width = l->width + 1, n = l->rows;
    const int status = fvi_rows_check_width(r, width);
    if (status)
        return status;
    if (n == *room) {
        *room = 2 * *room + 64;
        double *more = realloc(l->t, *room * width * sizeof *more);
        if (!more)
            return FVI_ENOMEM;
        l->t = more;
    }
    memcpy(l->t + n * width, r->values, width * sizeof *l->t);
    if (n > 0 && !(l->t[n * width] > l->t[(n - 1) * width]))
        return fvi_rows_refuse(r, 0, "t does not increase");
    l->rows++;
    return 0;
}

static int read_rows(fvi_rows *r, loads *l, size_t d)
{
    fvi_rows_kind kind;
    size_t room = 0;
    int status;
    while (!(status = fvi_rows_next(r, &kind)) && kind != FVI_ROWS_END) {
        const char *text = r->lines.text;
        const int is_name =
            !l->unknown
            && (kind == FVI_ROWS_COMMENT ? names_columns(text) : *text == 't');
        if (kind == FVI_ROWS_COMMENT && !is_name)
            continue;
        if (is_name)
            status = named_columns(r, l, d);
        else if (kind == FVI_ROWS_WORDS)
            status = fvi_rows_refuse(r, 0, FVI_ROWS_NO_NUMBER);
        else if (!l->unknown)
            status = select_all_columns(l, d);
        if (!status && !is_name)
            status = read_row(r, l, &room);
        if (status)
            return status;
    }
    return status;
}

int fvi_directory_force(fvi_directory *d, double last, int *found,
                        fvi_error *error)
{
    char place[PATH_MAX + 8];
    loads *l = &d->loads;
    fvi_rows r;
    *found = fvi_file_is_there(fvi_directory_path(d, "f.tsv", place));
    if (!*found)
        return 0;
    int status = fvi_rows_open(&r, "system", place, error);
    if (!status)
        status = read_rows(&r, l, d->M.n);
    fvi_rows_close(&r);
    if (status)
        return status == FVI_ENOMEM ? fvi_no_memory(error, "system") : status;
    if (l->rows == 0)
        return fvi_refuse(error, "system", "%s: has no rows", place);
    const double end = l->t[(l->rows - 1) * (l->width + 1)];
    if (l->t[0] > 0 || end < last * (1 - 1e-12))
        return fvi_refuse(error, "system", "%s: from t = %g to %g, the run from 0 to %g", place, l->t[0], end, last);
    return 0;
}

/* Interpolate linearly between two rows. Outside the table, which can only be a rounding error away, take the nearest
 * row. */
static int value(double t, size_t d, void *params, double *F)
{
    const loads *l = &((const fvi_directory *)params)->loads;
    const size_t width = l->width + 1;
    const fvi_polygon rows = { l->rows, width, width, l->t, NULL };
    const size_t low = fvi_polygon_row(&rows, t);
    const double *before = l->t + low * width,
                 *after = low + 1 < l->rows ? before + width : before;
    const double part = after > before ? (t - *before) / (*after - *before) : 0;
    memset(F, 0, d * sizeof *F);
    for (size_t i = 0; i < l->width; i++)
        F[l->unknown[i]] =
            before[1 + i]
            + fmin(fmax(part, 0), 1) * (after[1 + i] - before[1 + i]);
    return 0;
}

/* An unknown without a column has no force. */
static int bound(double from, double to, size_t order, size_t d, void *params,
                 double *most)
{
    const loads *l = &((const fvi_directory *)params)->loads;
    memset(most, 0, (order + 1) * d * sizeof *most);
    for (size_t i = 0; i < l->width; i++) {
        const fvi_polygon rows = { l->rows, l->width + 1, l->width + 1, l->t, l->t + 1 + i };
        fvi_polygon_bound(&rows, from, to, order, d, most + l->unknown[i]);
    }
    return 0;
}

fvi_force fvi_directory_typed_force(const fvi_directory *d)
{
    return (fvi_force){ value, (void *)d, .bound = bound };
}
