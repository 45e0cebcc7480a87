/* src/matrices/matrix_market.c -- Symmetric matrices from files.       [Chapter 27] */
#define _GNU_SOURCE /* getline */
#include "sparse.h"

#include "system/fail.h"

#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

/* A file that is read line by line, and what is wrong with it. */
typedef struct {
    FILE *file;
    char *line;
    size_t room, number; /* of the line, from 1 */
    int general;
    size_t n, count, size_line;
    fvi_triplet
        *triplets; /* of a symmetric file twice as many as stand there */
    size_t *lines; /* of each triplet */
    size_t kept;
    fvi_misread wrong;
} reader;

/* Line 0 is the file as a whole. */
static int refuse(reader *r, size_t line, const char *reason)
{
    r->wrong = (fvi_misread){ line, reason };
    return FVI_EDOM;
}

/* The next line that says something: 0 at the end. Comments stand below the first line. */
static int next_line(reader *r)
{
    while (getline(&r->line, &r->room, r->file) >= 0) {
        r->number++;
        const char *at = r->line + strspn(r->line, " \t\r\n");
        if (r->number == 1 || (*at != '\0' && *at != '%'))
            return 1;
    }
    return 0;
}

/* ---- the first lines ---- */

static int read_head(reader *r)
{
    char object[20], format[20], field[20], symmetry[20], more[2];
    if (!next_line(r))
        return refuse(r, 0, "cannot be read, or is empty");
    if (sscanf(r->line, "%%%%MatrixMarket %19s %19s %19s %19s %1s", object,
               format, field, symmetry, more)
            != 4
        || r->number != 1)
        return refuse(r, r->number,
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

static int read_size(reader *r)
{
    double rows, columns, count;
    char more[2];
    if (!next_line(r))
        return refuse(r, 0, "ends before its size");
    if (sscanf(r->line, "%lf %lf %lf %1s", &rows, &columns, &count, more) != 3
        || rows != floor(rows) || count != floor(count))
        return refuse(r, r->number, "not a size: rows, columns, entries");
    if (rows != columns)
        return refuse(r, r->number, "the matrix is not square");
    if (!(rows >= 1 && rows < INT_MAX && count >= 0 && count < INT_MAX / 2))
        return refuse(r, r->number, "a size from 1 to 2^31 is wanted");
    r->size_line = r->number;
    r->n = (size_t)rows;
    r->count = (size_t)count;
    const size_t most = 2 * r->count + 1;
    r->triplets = malloc(most * sizeof *r->triplets);
    r->lines = malloc(most * sizeof *r->lines);
    return r->triplets && r->lines ? FVI_SUCCESS : FVI_ENOMEM;
}

/* ---- the entries ---- */

static int index_of(reader *r, char **at, int *index)
{
    char *stop;
    const double value = strtod(*at, &stop);
    if (stop == *at || (*stop != ' ' && *stop != '\t'))
        return refuse(r, r->number, "not a row, a column and a number");
    if (value != floor(value) || !(value >= 1 && value <= (double)r->n))
        return refuse(r, r->number, "a row or column that is not there");
    *at = stop;
    *index = (int)value - 1;
    return FVI_SUCCESS;
}

static void keep(reader *r, int row, int column, double entry)
{
    r->lines[r->kept] = r->number;
    r->triplets[r->kept++] = (fvi_triplet){ row, column, entry };
}

static int read_entry(reader *r)
{
    int row = 0, column = 0;
    char *at = r->line, *stop;
    int status = index_of(r, &at, &row);
    if (!status)
        status = index_of(r, &at, &column);
    if (status)
        return status;
    const double entry = strtod(at, &stop);
    if (stop == at || stop[strspn(stop, " \t\r\n")] != '\0')
        return refuse(r, r->number, "not a row, a column and a number");
    if (!isfinite(entry))
        return refuse(r, r->number, "not a finite number");
    keep(r, row, column, entry);
    if (!r->general && row != column)
        keep(r, column, row, entry);
    return FVI_SUCCESS;
}

static int read_entries(reader *r)
{
    int status = FVI_SUCCESS;
    for (size_t i = 0; !status && i < r->count; i++)
        status = next_line(r) ? read_entry(r)
                              : refuse(r, r->size_line,
                                       "fewer entries follow than it says");
    if (!status && next_line(r))
        status = refuse(r, r->number, "more entries than it says");
    return status;
}

/* ---- what is wrong with the whole ---- */

/* The line of the last triplet in this place; 0 if there is none. */
static size_t line_of(const reader *r, int row, int column)
{
    for (size_t i = r->kept; i-- > 0;)
        if (r->triplets[i].row == row && r->triplets[i].column == column)
            return r->lines[i];
    return 0;
}

/* Sums are fewer than triplets: two stand in one place. Which? Each triplet takes the
 * first free of its place's, so the one that finds none is the second. */
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
            line = r->lines[l];
        taken[e] = 1;
    }
    free(taken);
    return refuse(r, line,
                  r->general ? "an entry that stands twice"
                             : "an entry that stands twice; of a symmetric "
                               "matrix only one triangle is given");
}

/* The matrix of the triplets, if it is one. */
static int finish(reader *r, fvi_sparse *A)
{
    fvi_sparse whole;
    int place = 0, status = fvi_sparse_sum(r->n, r->kept, r->triplets, &whole);
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

/* What is made of a file, but the matrix; to be given back with end. */
static int begin(reader *r, const char *file)
{
    *r = (reader){ .file = fopen(file, "r") };
    int status = r->file ? read_head(r) : refuse(r, 0, "cannot be read");
    if (!status)
        status = read_size(r);
    return status ? status : read_entries(r);
}

static void end(reader *r)
{
    if (r->file)
        fclose(r->file);
    free(r->line);
    free(r->triplets);
    free(r->lines);
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
