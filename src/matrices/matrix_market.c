/* src/matrices/matrix_market.c -- Read symmetric matrices from Matrix Market files.       [H 27] */
#include "sparse.h"

#include "system/fail.h"
#include "system/lines.h"

#include <errno.h>
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

/* A file that is read line by line, and the reason of its refusal. */
typedef struct {
    fvi_lines lines;
    int general;
    size_t n, count, size_line;
    fvi_triplet
        *triplets;    /* for a symmetric file, twice as many triplets as in the file */
    size_t *lines_of; /* the line of each triplet */
    size_t kept;
    fvi_misread wrong;
} reader;

static const char blank[] = " \t";

/* Refuse a line. Line 0 means the whole file. */
static int refuse(reader *r, size_t line, const char *reason)
{
    r->wrong = (fvi_misread){ line, reason, 0 };
    return FVI_EDOM;
}

/* Refuse the current line, at a position in it. */
static int refuse_at(reader *r, const char *at, const char *reason)
{
    r->wrong = (fvi_misread){ r->lines.number, reason,
                              (size_t)(at - r->lines.text) + 1 };
    return FVI_EDOM;
}

/* Read the next line that is neither empty nor a comment; the first line is read in any case. *found is 0
 * at the end of the file. */
static int next_line(reader *r, int *found)
{
    int status;
    const char *at = NULL;
    do {
        status = fvi_lines_next(&r->lines, found);
        if (!status && *found)
            at = r->lines.text + strspn(r->lines.text, blank);
    } while (!status && *found && r->lines.number > 1
             && (*at == '\0' || *at == '%'));
    if (status == FVI_EDOM)
        r->wrong =
            (fvi_misread){ r->lines.number, r->lines.reason, r->lines.column };
    return status;
}

/* ---- head and size ---- */

static int read_head(reader *r)
{
    char object[20], format[20], field[20], symmetry[20], more[2];
    int found, status = next_line(r, &found);
    if (status)
        return status;
    if (!found)
        return refuse(r, 0, "cannot be read, or is empty");
    if (sscanf(r->lines.text, "%%%%MatrixMarket %19s %19s %19s %19s %1s",
               object, format, field, symmetry, more)
        != 4)
        return refuse(r, 1,
                      "not a head '%%MatrixMarket matrix coordinate real "
                      "symmetric'");
    if (strcasecmp(object, "matrix") != 0)
        return refuse(r, 1, "not a matrix");
    if (strcasecmp(format, "coordinate") != 0)
        return refuse(r, 1, "not in coordinates: dense arrays are not read");
    if (strcasecmp(field, "pattern") == 0)
        return refuse(r, 1, "a pattern without numbers");
    if (strcasecmp(field, "real") != 0 && strcasecmp(field, "integer") != 0)
        return refuse(r, 1, "its numbers are neither real nor integer");
    r->general = strcasecmp(symmetry, "general") == 0;
    if (!r->general && strcasecmp(symmetry, "symmetric") != 0)
        return refuse(r, 1, "neither symmetric nor general");
    return FVI_SUCCESS;
}

/* Read exactly three numbers, separated by blanks. at[i] is the position of number i. */
static int read_three(reader *r, const char *what, const char *at[3],
                      double value[3])
{
    char *next = r->lines.text;
    for (int i = 0; i < 3; i++) {
        next += strspn(next, blank);
        at[i] = next;
        next = fvi_lines_decimal(next, '.', &value[i]);
        if (!next || (*next && !strchr(blank, *next)))
            return refuse_at(r, at[i], what);
    }
    next += strspn(next, blank);
    return *next ? refuse_at(r, next, what) : FVI_SUCCESS;
}

static int read_size(reader *r)
{
    double value[3];
    const char *at[3];
    int found, status = next_line(r, &found);
    if (!status && !found)
        status = refuse(r, 0, "ends before its size");
    if (!status)
        status = read_three(r, "not a size: rows, columns, entries", at, value);
    if (status)
        return status;
    const double rows = value[0], columns = value[1], count = value[2];
    if (rows != columns)
        return refuse_at(r, at[1], "the matrix is not square");
    if (rows != floor(rows) || count != floor(count))
        return refuse_at(r, at[rows != floor(rows) ? 0 : 2],
                         "not a size: rows, columns, entries");
    if (!(rows >= 1 && rows < INT_MAX && count >= 0 && count < INT_MAX / 2))
        return refuse_at(r, at[0], "a size from 1 to 2^31 is wanted");
    r->size_line = r->lines.number;
    r->n = (size_t)rows;
    r->count = (size_t)count;
    const size_t most = 2 * r->count + 1;
    r->triplets = malloc(most * sizeof *r->triplets);
    r->lines_of = malloc(most * sizeof *r->lines_of);
    return r->triplets && r->lines_of ? FVI_SUCCESS : FVI_ENOMEM;
}

/* ---- entries ---- */

static void append_entry(reader *r, int row, int column, double entry)
{
    r->lines_of[r->kept] = r->lines.number;
    r->triplets[r->kept++] = (fvi_triplet){ row, column, entry };
}

static int read_entry(reader *r)
{
    double value[3];
    const char *at[3];
    const int status = read_three(
        r, "not a row, a column and a finite decimal number", at, value);
    if (status)
        return status;
    for (int i = 0; i < 2; i++)
        if (value[i] != floor(value[i])
            || !(value[i] >= 1 && value[i] <= (double)r->n))
            return refuse_at(r, at[i], "a row or column that is not there");
    const int row = (int)value[0] - 1, column = (int)value[1] - 1;
    append_entry(r, row, column, value[2]);
    if (!r->general && row != column)
        append_entry(r, column, row, value[2]);
    return FVI_SUCCESS;
}

static int read_entries(reader *r)
{
    int found, status = FVI_SUCCESS;
    for (size_t i = 0; !status && i < r->count; i++) {
        status = next_line(r, &found);
        if (!status)
            status = found ? read_entry(r)
                           : refuse(r, r->size_line,
                                    "fewer entries follow than it says");
    }
    if (!status)
        status = next_line(r, &found);
    return !status && found
               ? refuse(r, r->lines.number, "more entries than it says")
               : status;
}

/* ---- checks of the whole matrix ---- */

/* Return the line of the last triplet at this position, or 0 if there is none. */
static size_t line_of(const reader *r, int row, int column)
{
    for (size_t i = r->kept; i-- > 0;)
        if (r->triplets[i].row == row && r->triplets[i].column == column)
            return r->lines_of[i];
    return 0;
}

/* Find the line of the second triplet at one position. It exists, because the matrix has fewer entries
 * than there are triplets. */
static int find_double(reader *r, const fvi_sparse *A)
{
    char *taken = calloc((size_t)A->start[A->n] + 1, 1);
    if (!taken)
        return FVI_ENOMEM;
    size_t line = 0;
    for (size_t l = 0; l < r->kept && line == 0; l++) {
        const fvi_triplet *t = &r->triplets[l];
        int e = A->start[t->column];
        while (A->row[e] != t->row)
            e++;
        if (taken[e])
            line = r->lines_of[l];
        taken[e] = 1;
    }
    free(taken);
    return refuse(r, line,
                  r->general ? "an entry that stands twice"
                             : "an entry that stands twice; of a symmetric "
                               "matrix only one triangle is given");
}

/* Assemble the matrix and test that it is symmetric. */
static int finish(reader *r, fvi_sparse *A)
{
    fvi_sparse whole;
    int place = 0, status = fvi_sparse_assemble(r->n, r->kept, r->triplets, &whole);
    if (status)
        return status;
    if ((size_t)whole.start[r->n] < r->kept)
        status = find_double(r, &whole);
    if (!status)
        status = fvi_sparse_is_symmetric(&whole, &place);
    if (status == FVI_EDOM && !r->wrong.reason) {
        int column = 0;
        while (whole.start[column + 1] <= place)
            column++;
        refuse(r, line_of(r, whole.row[place], column),
               "the matrix is not symmetric: entry (j, i) is another one");
    }
    if (status)
        fvi_sparse_free(&whole);
    else
        *A = whole;
    return status;
}

/* Read a file into triplets. The caller frees them with `end`, also after an error. */
static int begin(reader *r, const char *file)
{
    *r = (reader){ .kept = 0 };
    errno = 0;
    int status = fvi_lines_open(&r->lines, file) ? read_head(r)
                 : errno == ENOMEM               ? FVI_ENOMEM
                                   : refuse(r, 0, "cannot be read");
    if (!status)
        status = read_size(r);
    return status ? status : read_entries(r);
}

static void end(reader *r)
{
    fvi_lines_close(&r->lines);
    free(r->triplets);
    free(r->lines_of);
}

size_t fvi_sparse_line(const char *file, int row, int column)
{
    reader r;
    size_t line = 0;
    if (!begin(&r, file))
        line = row < 0 ? r.size_line : line_of(&r, row, column);
    end(&r);
    return line;
}

//> read
int fvi_sparse_read(const char *file, fvi_sparse *A, fvi_misread *wrong)
{
    if (!file || !A)
        FVI_FAIL("null pointer", FVI_EFAULT);
    reader r;
    int status = begin(&r, file);
    if (!status)
        status = finish(&r, A);
    end(&r);
    if (status == FVI_EDOM && wrong)
        *wrong = r.wrong;
    if (status == FVI_ENOMEM)
        FVI_FAIL("no memory for the matrix", FVI_ENOMEM);
    return status;
}
//< read
