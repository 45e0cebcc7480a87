/* src/output/fvi_table.c -- Print the table of a run. */
#define _GNU_SOURCE /* for _SC_PHYS_PAGES */
#include "fvi_table.h"
#include "fvi_complain.h"
#include "fvi_format.h"
#include "fvi_output.h"
#include "fvi_plot.h"

#include <fvi/error.h>
#include <fvi/lagrangian.h>

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* ---- the head ---- */

void fvi_table_head(FILE *out, const fvi_options *o)
{
    const char *name, *value;
    fvi_format_begin(out, o->format);
    for (size_t i = 0; fvi_options_describe(o, i, &name, &value); i++)
        fvi_format_parameter(out, o->format, name, value);
    if (o->no_solution)
        fvi_format_parameter(out, o->format, "warning", o->no_solution);
}

size_t fvi_table_column_width(const fvi_options *o, size_t n)
{
    const fvi_column column = o->columns.at[n];
    return column == FVI_COLUMN_TYPED                             ? o->columns.width[n]
           : column == FVI_COLUMN_T || column == FVI_COLUMN_ENERGY ? 1
                                                                   : o->shown_count;
}

/* Write the names of item n. Its first column is column number `first` of the table. */
static void print_names(FILE *out, const fvi_options *o, size_t n, size_t first)
{
    const fvi_column column = o->columns.at[n];
    const int numbered = o->numbered && column != FVI_COLUMN_T
                         && column != FVI_COLUMN_ENERGY;
    for (size_t i = 0; i < fvi_table_column_width(o, n); i++)
        if (column == FVI_COLUMN_TYPED)
            fvi_format_name(out, o->format, first + i,
                            fvi_typed_column_name(o->typed,
                                                  o->columns.first[n] + i),
                            0);
        else
            fvi_format_name(out, o->format, first + i, fvi_column_names[column],
                            numbered ? o->shown[i] + 1 : 0);
}

void fvi_table_column_names(FILE *out, const fvi_options *o, size_t first)
{
    const size_t reductions = fvi_reductions_count(o->typed);
    for (size_t n = 0; n < o->columns.count && reductions == 0; n++) {
        print_names(out, o, n, first);
        first += fvi_table_column_width(o, n);
    }
    for (size_t i = 0; i < reductions; i++)
        fvi_format_name(out, o->format, first++, fvi_reduction_name(o->typed, i),
                        0);
    fvi_format_names_end(out, o->format);
}

void fvi_table_names(const fvi_table *t)
{
    fvi_table_column_names(t->out, t->o, 0);
}

void fvi_table_mark_last(fvi_table *t)
{
    if (t->o->steps % t->o->every == 0 && !t->o->text[REDUCE])
        return;
    t->last = ftello(t->out);
    t->last_drawn = t->plot ? ftello(t->plot) : 0;
}

/* ---- rows ---- */

static int is_printed(const fvi_options *o, size_t k)
{
    return k % o->every == 0 || k == o->steps;
}

static size_t row_number(const fvi_options *o, size_t k)
{
    return k / o->every + (k == o->steps && k % o->every != 0);
}

void fvi_table_shape(fvi_table *t, const fvi_options *o,
                     const fvi_system *system)
{
    *t = (fvi_table){ .o = o, .system = system };
    for (size_t n = 0; n < o->columns.count; n++) {
        t->width += fvi_table_column_width(o, n);
        t->wait |= o->columns.at[n] == FVI_COLUMN_Y;
    }
    if (fvi_reductions_count(o->typed) > 0) { /* the reductions are the only row */
        t->width = fvi_reductions_count(o->typed);
        t->wait = 0;
    }
    t->height = t->wait ? row_number(o, o->steps) + 1 : 1;
}

double fvi_machine_bytes(void)
{
    return fmin((double)sysconf(_SC_PHYS_PAGES) * (double)sysconf(_SC_PAGESIZE),
                (double)(SIZE_MAX / 2));
}

double *fvi_table_room(const fvi_table *t, double bytes)
{
    bytes += (double)sizeof *t->rows * (double)t->height * (double)t->width;
    return bytes < fvi_machine_bytes()
               ? calloc(t->height * t->width, sizeof *t->rows)
               : NULL;
}

size_t fvi_table_next(const fvi_table *t, size_t k)
{
    const size_t N = t->o->steps, every = t->o->every;
    size_t step = every - k % every;
    if (t->wait && 1 + (N - k - 1) % every < step)
        step = 1 + (N - k - 1) % every; /* then N - k is a row */
    return step < N - k ? k + step : N;
}

/* Copy the shown coordinates of d numbers. */
static void select_columns(const fvi_options *o, const double *from, double *row)
{
    for (size_t i = 0; i < o->shown_count; i++)
        row[i] = from[o->shown[i]];
}

/* Fill in the columns of row k. With only_y nonzero, fill in only the columns y of row N - k, which are x_k. */
static int fill_row(const fvi_table *t, size_t k, const double *x, const double *p,
                    int only_y, double *row)
{
    const double time = t->ended > 0 ? t->ended : (double)k * t->o->h; /* one product */
    int status = FVI_SUCCESS;
    if (t->typed)
        memcpy(t->o->typed_row, t->typed,
               fvi_typed_columns_count(t->o->typed) * sizeof *row);
    else if (!only_y && fvi_typed_columns_count(t->o->typed) > 0)
        status = fvi_typed_columns_values(t->o->typed, t->now, t->o->typed_row);
    for (size_t n = 0; n < t->o->columns.count && !status; n++) {
        const fvi_column column = t->o->columns.at[n];
        const size_t width = fvi_table_column_width(t->o, n);
        if (only_y == (column == FVI_COLUMN_Y)) {
            if (column == FVI_COLUMN_TYPED)
                memcpy(row, t->o->typed_row + t->o->columns.first[n],
                       width * sizeof *row);
            else if (column == FVI_COLUMN_T)
                *row = time;
            else if (column == FVI_COLUMN_ENERGY)
                status = fvi_energy_at(t->system, time, x, p, row);
            else
                select_columns(t->o, column == FVI_COLUMN_P ? p : x, row);
        }
        row += width;
    }
    return status;
}

/* Print the row of step k as the i-th row of the table. The last step need not be a multiple of --every, so k may be
 * too large for the last row. */
static void print_row(const fvi_table *t, size_t k, size_t i, const double *row)
{
    const size_t step = k < t->o->steps ? k : t->o->steps;
    fvi_format_row(t->out, t->o->format, i, t->width, row);
    if (t->plot)
        fvi_plot_row(t->plot, (double)step * t->o->h, t->width, row);
}

int fvi_table_take(const fvi_table *t, size_t k, const double *x,
                   const double *p)
{
    const fvi_options *o = t->o;
    if (is_printed(o, k)) {
        double *row = t->rows + (t->wait ? row_number(o, k) * t->width : 0);
        int status = fill_row(t, k, x, p, 0, row);
        if (status)
            return status;
        if (!fvi_all_finite(t->width, row)) /* for example an energy that is too large */
            return FVI_EOVRFLW;
        if (!t->wait)
            print_row(t, k, k - t->begin + (t->goes_on != 0), row);
    }
    if (t->wait && is_printed(o, o->steps - k))
        return fill_row(t, k, x, p, 1,
                        t->rows + row_number(o, o->steps - k) * t->width);
    return FVI_SUCCESS;
}

int fvi_table_open(fvi_table *t)
{
    const fvi_options *o = t->o;
    if (o->plot && !(t->plot = fvi_plot_begin()))
        return 1;
    if ((t->out = fvi_output_open(o->output)))
        return 0;
    fvi_cannot_write(o->output);
    return fvi_plot_end(t->plot, o, 0) || 1;
}

int fvi_table_close(fvi_table *t, int failed)
{
    for (size_t i = 0; !failed && t->wait && i < t->height; i++)
        print_row(t, i * t->o->every, i, t->rows + i * t->width);
    if (!failed)
        fvi_format_end(t->out, t->o->format);
    if (fvi_output_close(t->out, !failed) != 0)
        failed = fvi_cannot_write(t->o->output);
    return fvi_plot_end(t->plot, t->o, !failed) || failed;
}
