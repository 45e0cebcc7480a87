/* src/output/fvi_table.h -- Print the table of a run. */
#ifndef FVI_TABLE_H
#define FVI_TABLE_H

#include <fvi/version.h>
#include "options/fvi_option_list.h"
#include <fvi/observer.h>

#include <stdio.h>
#include <sys/types.h>

/* A table that is being printed. Rows are printed as they come. Only if the mirrored motion y_k = x_{N-k} is a column,
 * all rows wait for the end of the run. */
typedef struct {
    const fvi_options *o;
    const fvi_system *system;
    FILE *out;
    size_t width;  /* numbers in a row */
    size_t height; /* number of rows that are kept: one, or all if they wait */
    double *rows;
    int wait;
    fvi_observer *observer; /* observer of the run, or NULL */
    const fvi_observation *now; /* observation at the row that is taken, for typed columns */
    const double *typed;        /* the typed columns of that row, if they are known already; else NULL */
    double ended; /* time at which an event ended the run, for the last row; else 0 */
    FILE *plot;   /* temporary file with the rows for the picture, or NULL */
    size_t begin; /* first row to be printed by a run that goes on; else 0 */
    int goes_on;  /* nonzero if the table begins with saved rows */
    off_t first;  /* position of the first row in the file */
    /* Positions of the last row in the table and in plot, if a longer run does not have that row; else 0. */
    off_t last,
        last_drawn;
} fvi_table;

/* fvi_table_shape -- Fill in width, height and wait, and set all other members but o and system to 0. */
void fvi_table_shape(fvi_table *t, const fvi_options *o,
                     const fvi_system *system);

/* fvi_machine_bytes -- Return the bytes of memory of this machine, or the most that a program can address if that is
 * less. */
double fvi_machine_bytes(void);

/* fvi_table_room -- Return an array for the rows of a table that has its shape. The caller frees it. NULL if the array
 * and `bytes` more do not fit into the memory of the machine. */
double *fvi_table_room(const fvi_table *t, double bytes);

/* fvi_table_head -- Write the "# name = value" lines of any command, and the warning of the initial history. */
void fvi_table_head(FILE *out, const fvi_options *o);

/* fvi_table_column_width -- Return the number of columns of item n of o->columns. */
size_t fvi_table_column_width(const fvi_options *o, size_t n);

/* fvi_table_names -- Write the line with the names of the columns.
 * fvi_table_column_names -- Do the same after `first` other columns. */
void fvi_table_names(const fvi_table *t);
void fvi_table_column_names(FILE *out, const fvi_options *o, size_t first);

/* fvi_table_next -- Return the first step after k at which the table needs the state: for the row of that step, or for
 * y at the row N - k. k < N. */
size_t fvi_table_next(const fvi_table *t, size_t k);

/* fvi_table_take -- Keep or print the row of step k, at which the state is x, p. Return FVI_SUCCESS; FVI_EOVRFLW if a
 * number to be printed is not finite (this row is not printed); or what fvi_typed_columns_values and fvi_energy_at
 * return. */
int fvi_table_take(const fvi_table *t, size_t k, const double *x,
                   const double *p);

/* fvi_table_mark_last -- Say that the next row is the last one. */
void fvi_table_mark_last(fvi_table *t);

/* fvi_table_open -- Open o->output, and a temporary file for the rows of a picture if one is wanted.
 * fvi_table_close -- If nothing failed, print the rows that waited and the end of the table, give the file its name,
 * and draw the picture.
 * Both return 0, or 1 after a message. fvi_table_close also returns 1 if `failed` is nonzero. */
int fvi_table_open(fvi_table *t);
int fvi_table_close(fvi_table *t, int failed);

#endif
