/* src/output/fvi_plot.c -- A picture of a table, drawn by gnuplot. */
#define _GNU_SOURCE /* popen */
#include "fvi_plot.h"

#include "fvi_complain.h"

#include <errno.h>
#include <limits.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <unistd.h>

enum { MOST_POINTS = 5000, MOST_LINES = 6 };

FILE *fvi_plot_begin(void)
{
    FILE *rows = NULL;
    if (system("gnuplot --version >/dev/null 2>&1 </dev/null") != 0)
        fvi_complain("--plot: gnuplot is not installed");
    else if (!(rows = tmpfile()))
        fvi_cannot_write("a temporary file");
    return rows;
}

void fvi_plot_row(FILE *rows, double t, size_t width, const double *row)
{
    fprintf(rows, "%.9g", t);
    for (size_t i = 0; i < width; i++)
        fprintf(rows, " %.9g", row[i]);
    fputc('\n', rows);
}

/* ---- the script ---- */

/* What stands behind `plot`: lines from column `at` of the data on, of the time or of
 * the columns from `over` on. */
static void lines(FILE *g, const fvi_options *o, size_t over, size_t at)
{
    for (size_t i = 0; i < o->shown_count && i < MOST_LINES; i++) {
        fprintf(g, "%s $rows using %zu:%zu with lines lw 1.5 title ",
                i ? "," : "plot", over > 1 ? over + i : 1, at + i);
        fprintf(g, o->d > 1 ? "'%zu'" : "''", o->shown[i] + 1);
    }
    fputc('\n', g);
}

static void panel(FILE *g, const char *across, const char *up)
{
    fprintf(g, "set xlabel '%s'; set ylabel '%s'\n", across, up);
}

/* Where each column stands in the data, from 2; 0 if it is none. */
static size_t place_columns(const fvi_options *o, size_t at[FVI_ALL_COLUMNS])
{
    size_t next = 2, panels = 0;
    memset(at, 0, FVI_ALL_COLUMNS * sizeof *at);
    for (size_t n = 0; n < o->columns.count; n++) {
        const fvi_column column = o->columns.at[n];
        at[column] = next;
        next += column == FVI_COLUMN_T || column == FVI_COLUMN_ENERGY
                    ? 1
                    : o->shown_count;
        panels += column != FVI_COLUMN_T; /* p is the phase, or its own */
    }
    return panels;
}

static void script(FILE *g, const fvi_options *o,
                   const size_t at[FVI_ALL_COLUMNS], size_t panels)
{
    const size_t x = at[FVI_COLUMN_X], p = at[FVI_COLUMN_P];
    static const char *const colours[MOST_LINES] = {
        "0072B2", "D55E00", "009E73", "CC79A7", "E69F00", "56B4E9"
    }; /* Okabe and Ito's, told apart also by the colour-blind */
    fputs("set border 3; set tics nomirror\n"
          "set grid lt 1 lc rgb '#dddddd' lw 0.6\n",
          g);
    for (int i = 0; i < MOST_LINES; i++)
        fprintf(g, "set linetype %d lc rgb '#%s'\n", i + 1, colours[i]);
    fprintf(g, "set multiplot layout %zu,1\n", panels);
    if (x) {
        panel(g, "t", "x");
        lines(g, o, 1, x);
    } else if (p) {
        panel(g, "t", "p");
        lines(g, o, 1, p);
    }
    if (at[FVI_COLUMN_ENERGY]) {
        panel(g, "t", "energy");
        fprintf(g, "plot $rows using 1:%zu with lines lw 1.5 title ''\n",
                at[FVI_COLUMN_ENERGY]);
    }
    if (at[FVI_COLUMN_Y]) {
        panel(g, "t", "y");
        lines(g, o, 1, at[FVI_COLUMN_Y]);
    }
    if (x && p) {
        panel(g, "x", "p");
        lines(g, o, x, p);
    }
    fprintf(g, "unset multiplot\n");
}

/* A name between gnuplot's quotes, and where it draws. */
static void terminal(FILE *g, const char *name, const char *type, size_t panels)
{
    const int svg = strcasecmp(type, ".svg") == 0;
    fprintf(g, "set terminal %s size 800,%zu %s\nset output '",
            svg ? "svg dynamic" : "pngcairo", 80 + 260 * panels,
            svg ? "background 'white'" : "");
    for (; *name; name++)
        fprintf(g, *name == '\'' ? "''" : "%c", *name);
    fprintf(g, "'\n");
}

/* The rows; of many, each n-th, as gnuplot reads its input a byte at a time. */
static void copy_rows(FILE *rows, FILE *g)
{
    size_t count = 0, row = 0;
    rewind(rows);
    for (int c; (c = fgetc(rows)) != EOF;)
        count += c == '\n';
    const size_t every = 1 + count / MOST_POINTS;
    rewind(rows);
    fprintf(g, "$rows << EOD\n");
    for (int c; (c = fgetc(rows)) != EOF; row += c == '\n')
        if (row % every == 0)
            fputc(c, g);
    fprintf(g, "EOD\n");
}

/* gnuplot draws under another name, which becomes o->plot. Returns 0 if all went well. */
static int draw(FILE *rows, const fvi_options *o)
{
    char new[PATH_MAX];
    struct stat old;
    size_t at[FVI_ALL_COLUMNS];
    const size_t panels = place_columns(o, at);
    const int length = snprintf(new, sizeof new, "%s.new", o->plot);
    if (stat(o->plot, &old) == 0 && !S_ISREG(old.st_mode)) {
        errno = EEXIST;
        return -1;
    }
    errno = EINVAL;
    if (length >= (int)sizeof new || panels == 0)
        return -1;
    void (*before)(int) = signal(SIGPIPE, SIG_IGN); /* a script that fails */
    FILE *g = popen("gnuplot >/dev/null 2>&1", "w");
    if (g) {
        copy_rows(rows, g);
        terminal(g, new, o->plot + strlen(o->plot) - 4, panels);
        script(g, o, at, panels);
    }
    const int failed = !g || pclose(g) != 0 || access(new, R_OK) != 0
                       || rename(new, o->plot) != 0;
    signal(SIGPIPE, before);
    if (failed)
        unlink(new);
    return failed;
}

int fvi_plot_end(FILE *rows, const fvi_options *o, int wanted)
{
    int failed = 0;
    if (rows && wanted)
        failed = fflush(rows) != 0 || ferror(rows) || draw(rows, o) != 0;
    if (failed)
        failed = fvi_cannot_write(o->plot);
    if (rows)
        fclose(rows);
    return failed;
}
