/* src/output/fvi_plot.c -- Draw a table with gnuplot. */
#include "fvi_plot.h"
#include "fvi_table.h"

#include <string.h>

enum { MOST_LINES = 6 };

/* ---- the script ---- */

/* Write the command `plot` with a line for each shown coordinate: columns at, at + 1, ... of the data over the time
 * (over = 1), or over the columns over, over + 1, ... */
static void write_lines(FILE *g, const fvi_options *o, size_t over, size_t at)
{
    for (size_t i = 0; i < o->shown_count && i < MOST_LINES; i++) {
        fprintf(g, "%s $rows using %zu:%zu with lines lw 1.5 title ",
                i ? "," : "plot", over > 1 ? over + i : 1, at + i);
        fprintf(g, o->d > 1 ? "'%zu'" : "''", o->shown[i] + 1);
    }
    fputc('\n', g);
}

static void write_panel(FILE *g, const char *across, const char *up)
{
    fprintf(g, "set xlabel '%s'; set ylabel '%s'\n", across, up);
}

/* Return nonzero if the table has two typed columns and no others. They are drawn as a loop, for example force over
 * drift. */
static int is_loop(const fvi_options *o)
{
    size_t width = 0;
    for (size_t n = 0; n < o->columns.count; n++) {
        if (o->columns.at[n] != FVI_COLUMN_TYPED)
            return 0;
        width += o->columns.width[n];
    }
    return width == 2;
}

/* Find the first column of each item in the data, counted from 2; 0 if the table does not have it. Return the number of
 * panels. */
static size_t find_columns(const fvi_options *o, size_t at[FVI_ALL_COLUMNS])
{
    size_t next = 2, panels = 0;
    memset(at, 0, FVI_ALL_COLUMNS * sizeof *at);
    for (size_t n = 0; n < o->columns.count; n++) {
        const fvi_column column = o->columns.at[n];
        at[column] = next;
        next += fvi_table_column_width(o, n);
        panels += column == FVI_COLUMN_TYPED ? o->columns.width[n]
                                             : column != FVI_COLUMN_T;
        /* p is drawn over x in a phase panel, or has its own panel */
    }
    return is_loop(o) ? 1 : panels;
}

/* Write the name of a typed column as a text of gnuplot, with its quotes doubled. */
static void write_label(FILE *g, const char *axis, const char *name)
{
    fprintf(g, "set %slabel '", axis);
    for (; *name; name++)
        fprintf(g, *name == '\'' ? "''" : "%c", *name);
    fputs("' noenhanced\n", g);
}

/* Draw each typed column over the time. */
static void typed_panels(FILE *g, const fvi_options *o)
{
    size_t next = 2;
    for (size_t n = 0; n < o->columns.count; n++) {
        const int is_typed = o->columns.at[n] == FVI_COLUMN_TYPED;
        const size_t width = fvi_table_column_width(o, n);
        for (size_t i = 0; i < width && is_typed; i++) {
            write_label(g, "x", "t");
            write_label(g, "y",
                        fvi_typed_column_name(o->typed, o->columns.first[n] + i));
            fprintf(g, "plot $rows using 1:%zu with lines lw 1.5 title ''\n",
                    next + i);
        }
        next += width;
    }
}

/* Draw the second typed column over the first. */
static void write_loop(FILE *g, const fvi_options *o)
{
    write_label(g, "x", fvi_typed_column_name(o->typed, 0));
    write_label(g, "y", fvi_typed_column_name(o->typed, 1));
    fputs("plot $rows using 2:3 with lines lw 1.5 title ''\n", g);
}

static void script(FILE *g, const fvi_options *o,
                   const size_t at[FVI_ALL_COLUMNS], size_t panels)
{
    const size_t x = at[FVI_COLUMN_X], p = at[FVI_COLUMN_P];
    fprintf(g, "set multiplot layout %zu,1\n", panels);
    if (x) {
        write_panel(g, "t", "x");
        write_lines(g, o, 1, x);
    } else if (p) {
        write_panel(g, "t", "p");
        write_lines(g, o, 1, p);
    }
    if (at[FVI_COLUMN_ENERGY]) {
        write_panel(g, "t", "energy");
        fprintf(g, "plot $rows using 1:%zu with lines lw 1.5 title ''\n",
                at[FVI_COLUMN_ENERGY]);
    }
    if (at[FVI_COLUMN_Y]) {
        write_panel(g, "t", "y");
        write_lines(g, o, 1, at[FVI_COLUMN_Y]);
    }
    if (x && p) {
        write_panel(g, "x", "p");
        write_lines(g, o, x, p);
    }
    if (is_loop(o))
        write_loop(g, o);
    else
        typed_panels(g, o);
    fprintf(g, "unset multiplot\n");
}

/* What the script needs to draw the rows of a trajectory. */
typedef struct {
    const fvi_options *o;
    size_t at[FVI_ALL_COLUMNS], panels;
} trajectory_picture;

static void trajectory_script(FILE *g, const void *params)
{
    const trajectory_picture *p = params;
    script(g, p->o, p->at, p->panels);
}

int fvi_plot_end(FILE *rows, const fvi_options *o, int wanted)
{
    trajectory_picture p = { .o = o };
    p.panels = find_columns(o, p.at);
    const fvi_picture picture = { o->plot, 800, 80 + 260 * p.panels,
                                  trajectory_script, &p };
    return fvi_picture_end(rows, &picture, wanted);
}
