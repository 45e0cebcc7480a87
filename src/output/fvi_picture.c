/* src/output/fvi_picture.c -- Draw rows of numbers with gnuplot. */
#define _GNU_SOURCE
#include "fvi_picture.h"

#include "fvi_complain.h"
#include "fvi_output.h"

#include <errno.h>
#include <fcntl.h>
#include <spawn.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/wait.h>
#include <unistd.h>

extern char **environ;

enum { MOST_POINTS = 5000 };

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

/* Set the colours of Okabe and Ito, which the colour-blind can also tell apart. */
static void write_style(FILE *g)
{
    static const char *const colours[] = {
        "0072B2", "D55E00", "009E73", "CC79A7", "E69F00", "56B4E9"
    };
    fputs("set border 3; set tics nomirror\n"
          "set grid lt 1 lc rgb '#dddddd' lw 0.6\n",
          g);
    for (int i = 0; i < 6; i++)
        fprintf(g, "set linetype %d lc rgb '#%s'\n", i + 1, colours[i]);
}

/* Choose the format of the picture from its name. gnuplot writes the picture to its standard output, so it never sees
 * the user's name, in which it would take the text after a | for a command. */
static void write_terminal(FILE *g, const fvi_picture *p)
{
    const char *const end = p->name + strlen(p->name) - 4;
    const int svg = strcasecmp(end, ".svg") == 0;
    fprintf(g, "set terminal %s size %zu,%zu %s\n",
            svg ? "svg dynamic" : "pngcairo", p->width, p->height,
            svg ? "background 'white'" : "");
}

/* Copy the rows into the script. Of more than MOST_POINTS rows copy each n-th, because gnuplot reads its input byte by
 * byte. */
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

/* Start gnuplot, which reads the script and writes the picture to the pipe. Return 0 if it runs, else -1. */
static int start_gnuplot(int script, const int ends[2], pid_t *child)
{
    static char name[] = "gnuplot";
    char *const words[] = { name, NULL };
    posix_spawn_file_actions_t files;
    if (posix_spawn_file_actions_init(&files))
        return -1;
    posix_spawn_file_actions_adddup2(&files, script, STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&files, ends[1], STDOUT_FILENO);
    posix_spawn_file_actions_addopen(&files, STDERR_FILENO, "/dev/null",
                                     O_WRONLY, 0);
    posix_spawn_file_actions_addclose(&files, ends[0]);
    posix_spawn_file_actions_addclose(&files, ends[1]);
    const int status =
        posix_spawnp(child, words[0], &files, NULL, words, environ);
    posix_spawn_file_actions_destroy(&files);
    return status ? -1 : 0;
}

/* Run the script and copy the picture from the pipe, because gnuplot itself does not notice a full disk. Return 0 if
 * gnuplot has drawn a picture, else -1. Errors of writing are recorded in the stream `picture`. */
static int run_gnuplot(FILE *script, FILE *picture)
{
    int ends[2], ended = 1;
    pid_t child;
    char block[1 << 14];
    size_t bytes = 0;
    if (pipe(ends) != 0)
        return -1;
    const int started = start_gnuplot(fileno(script), ends, &child) == 0;
    close(ends[1]);
    for (ssize_t n = started; n > 0 || (n < 0 && errno == EINTR);
         bytes += n > 0 ? (size_t)n : 0) {
        n = read(ends[0], block, sizeof block);
        if (n > 0)
            fwrite(block, 1, (size_t)n, picture);
    }
    close(ends[0]);
    while (started && waitpid(child, &ended, 0) < 0 && errno == EINTR)
        ;
    return started && ended == 0 && bytes > 0 ? 0 : -1;
}

/* Draw the picture. Return 0, or 1 after a message. */
static int draw_picture(FILE *rows, const fvi_picture *p)
{
    FILE *g = tmpfile(), *picture = g ? fvi_output_open_file(p->name) : NULL;
    int failed =
        !picture ? fvi_cannot_write(g ? p->name : "a temporary file") : 0;
    if (!failed) {
        copy_rows(rows, g);
        write_terminal(g, p);
        write_style(g);
        p->script(g, p->params);
        if (fflush(g) != 0 || ferror(g) || lseek(fileno(g), 0, SEEK_SET) != 0)
            failed = fvi_cannot_write("a temporary file");
    }
    if (!failed && run_gnuplot(g, picture) != 0)
        failed = fvi_complain("--plot: gnuplot drew no picture");
    if (picture && fvi_output_close(picture, !failed) != 0 && !failed)
        failed = fvi_cannot_write(p->name);
    if (g)
        fclose(g);
    return failed;
}

int fvi_picture_end(FILE *rows, const fvi_picture *p, int wanted)
{
    int failed = 0;
    if (rows && wanted)
        failed = fflush(rows) != 0 || ferror(rows)
                     ? fvi_cannot_write("a temporary file")
                     : draw_picture(rows, p);
    if (rows)
        fclose(rows);
    return failed;
}
