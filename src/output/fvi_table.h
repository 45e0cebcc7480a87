/* src/output/fvi_table.h -- The table that the program prints. */
#ifndef FVI_TABLE_H
#define FVI_TABLE_H

#include <fvi/version.h>
#include "options/fvi_option_list.h"
#include <fvi/observer.h>

#include <stdio.h>
#include <sys/types.h>

/* A table on its way out. Rows go out as they come, unless the mirror
 * y_k = x_{N-k} is asked for: then all wait for the end of the run. */
typedef struct {
    const fvi_options *o;
    const fvi_system *system;
    FILE *out;
    size_t width;  /* numbers in a row */
    size_t height; /* rows that are kept: one, or all of them */
    double *rows;
    int wait;
    fvi_observer *observer; /* that goes with the run, or NULL */
    const fvi_observation *now; /* what typed columns are made of, at the row that is taken */
    const double *typed;        /* or these themselves; else NULL */
    double ended; /* when an event ended the run whose last row is taken; or 0 */
    FILE *plot;   /* where rows are kept to be drawn; or NULL */
    size_t begin; /* the first row of a run that goes on; 0 */
    int goes_on;  /* are there rows of it in the table before? */
    off_t first;  /* where the rows begin in a file */
    off_t last,
        last_drawn; /* where the last one does, if a longer run has no such row, in
                             * the table and in plot; else 0 */
} fvi_table;

/* fvi_table_shape -- fill everything but out and rows. */
void fvi_table_shape(fvi_table *t, const fvi_options *o,
                     const fvi_system *system);

/* fvi_machine_bytes -- the memory of this machine, as far as a program of its word
 * length can address it. */
double fvi_machine_bytes(void);

/* fvi_table_room -- rows for a table that has its shape, to be freed by the caller;
 * NULL if these and `bytes` more are more than the machine has. */
double *fvi_table_room(const fvi_table *t, double bytes);

/* fvi_table_head -- "# name = value" lines, for any command, and the warning of the past. */
void fvi_table_head(FILE *out, const fvi_options *o);

/* fvi_table_column_width -- how many columns item n of o->columns has. */
size_t fvi_table_column_width(const fvi_options *o, size_t n);

/* fvi_table_names -- the line with the names of the columns; fvi_table_column_names: where
 * others come first. */
void fvi_table_names(const fvi_table *t);
void fvi_table_column_names(FILE *out, const fvi_options *o, size_t first);

/* fvi_table_next -- the first step after k, k < N, of which the table wants
 * something: its row, or its mirror N - k for y. */
size_t fvi_table_next(const fvi_table *t, size_t k);

/* fvi_table_take -- step k is at x, p: keep or print what is asked for.
 * Returns FVI_SUCCESS, or FVI_EOVRFLW if a number to be printed is not finite; that
 * row is not printed. */
int fvi_table_take(const fvi_table *t, size_t k, const double *x,
                   const double *p);

/* fvi_table_mark_last -- the row that is taken next is the last. */
void fvi_table_mark_last(fvi_table *t);

/* fvi_table_open -- open o->output, and a place for the rows of a picture if one is wanted.
 * fvi_table_close -- the rows that waited, and the end, if nothing failed; then the file
 * gets its name, and the picture is drawn. Both return 0, or 1 after they have said what
 * is wrong, and close 1 if something failed before. */
int fvi_table_open(fvi_table *t);
int fvi_table_close(fvi_table *t, int failed);

#endif
