/* src/command_run/fvi_checkpoint.c -- Write the state of a run to a file, and read it back. */
#define _GNU_SOURCE
#include "fvi_checkpoint.h"

#include "fvi_checkpoint_head.h"
#include "fvi_run.h"
#include "command_shared/fvi_run_rows.h"
#include "options/fvi_option_columns.h"
#include "output/fvi_complain.h"
#include "output/fvi_output.h"
#include <fvi/error.h>

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* A checkpoint has four parts:
 *
 *   1. the head, up to an empty line;
 *   2. the form of the table, the rows of the table, and the rows of the picture. Each of the three has its length in
 *      front of it. They are empty unless the rows so far are in no file of the user;
 *   3. the pieces that fvi_stepper_archive lists, each with its length in front of it;
 *   4. the checksum of everything before it. */
typedef struct {
    fvi_archive archive; /* The first member, so that a pointer to it is also a pointer to the state. */
    FILE *file;
    uint64_t sum;
    int failed; /* nonzero after a read or a write has failed */
} state;

static void write_bytes(state *f, const void *data, size_t bytes)
{
    f->failed |= fwrite(data, 1, bytes, f->file) != bytes;
    f->sum = fvi_add_to_sum(f->sum, data, bytes);
}

static int read_bytes(state *f, void *data, size_t bytes)
{
    if (fread(data, 1, bytes, f->file) != bytes)
        return 0;
    f->sum = fvi_add_to_sum(f->sum, data, bytes);
    return 1;
}

static int save_piece(fvi_archive *v, void *data, size_t bytes, int constant)
{
    state *f = (state *)v;
    const uint64_t length = bytes;
    (void)constant;
    write_bytes(f, &length, sizeof length);
    write_bytes(f, data, bytes);
    return f->failed ? -1 : 0;
}

/* Compare a constant piece of the file with the data of this run, block by block. */
static int is_same(state *f, const unsigned char *data, size_t bytes)
{
    unsigned char part[4096];
    for (size_t n; bytes > 0; bytes -= n, data += n) {
        n = bytes < sizeof part ? bytes : sizeof part;
        if (!read_bytes(f, part, n) || memcmp(part, data, n) != 0)
            return 0;
    }
    return 1;
}

static int load_piece(fvi_archive *v, void *data, size_t bytes, int constant)
{
    state *f = (state *)v;
    uint64_t length;
    if (!read_bytes(f, &length, sizeof length) || length != bytes)
        return -1;
    return (constant ? is_same(f, data, bytes) : read_bytes(f, data, bytes)) ? 0 : -1;
}

/* Archive the stepper, its observer and the reductions. The observer is archived only if columns have sums over the
 * steps. Without such sums an observer stores nothing from step to step, so the run may go on with other columns. */
static int archive_run(const fvi_table *t, fvi_stepper *s, fvi_archive *archive)
{
    int status = fvi_stepper_archive(s, archive);
    if (!status && t->observer && fvi_options_observes(t->o))
        status = fvi_observer_archive(t->observer, archive);
    return status ? status : fvi_reductions_archive(t->o->typed, archive);
}

/* ---- the rows ---- */

/* Write the form of the rows: a checksum of --columns, --unknowns and --every, the format, and whether there is a
 * picture. Saved rows can only be followed by rows of the same form. */
enum { FORM = 60 };
static void form_of(const fvi_options *o, char text[FORM])
{
    static const char *const asked[] = { "columns", "unknowns", "every", NULL };
    const char *name, *value;
    uint64_t sum = FVI_FIRST_SUM; /* the options are summed because a list of unknowns may be long */
    for (size_t i = 0; fvi_options_describe(o, i, &name, &value); i++)
        if (fvi_is_one_of(name, asked)) {
            sum = fvi_add_to_sum(sum, name, strlen(name) + 1);
            sum = fvi_add_to_sum(sum, value, strlen(value) + 1);
        }
    snprintf(text, FORM, "%016jx %s %s", (uintmax_t)sum,
             fvi_format_names[o->format], o->plot ? "plot" : "");
}

/* Write the length and the bytes of an open file from `begin` to `end`, or to the end of the file if `end` is 0.
 * Without a file the length is 0. */
static void copy_bytes(state *f, FILE *from, off_t begin, off_t end)
{
    unsigned char part[1 << 14];
    struct stat now = { 0 };
    if (from && (fflush(from) != 0 || fstat(fileno(from), &now) != 0))
        f->failed = 1;
    const uint64_t length =
        from ? (uint64_t)((end > 0 ? end : now.st_size) - begin) : 0;
    write_bytes(f, &length, sizeof length);
    for (uint64_t done = 0; done < length && !f->failed;) {
        const size_t n =
            length - done < sizeof part ? (size_t)(length - done) : sizeof part;
        const ssize_t got = pread(fileno(from), part, n, begin + (off_t)done);
        if (got <= 0)
            f->failed = 1;
        else
            write_bytes(f, part, (size_t)got);
        done += got > 0 ? (uint64_t)got : 0;
    }
}

/* Write the rows so far. A longer run may not have the last row, because the number of steps need not be a multiple of
 * --every. Therefore the rows end at t->last, where the last row begins. */
static void write_rows(state *f, const fvi_table *t)
{
    char form[FORM] = "";
    const int waits = fvi_output_waits(t->out);
    if (waits)
        form_of(t->o, form);
    const uint64_t length = strlen(form);
    write_bytes(f, &length, sizeof length);
    write_bytes(f, form, length);
    copy_bytes(f, waits ? t->out : NULL, t->first, t->last);
    copy_bytes(f, waits ? t->plot : NULL, 0, t->last_drawn);
}

/* Find the three parts with the rows. The file is then positioned behind them. Return 0 if a length does not fit into
 * the file. */
static int find_rows(fvi_checkpoint *c, off_t size)
{
    for (int i = 0; i < 3; i++) {
        fvi_checkpoint_part *part = &c->part[i];
        uint64_t length;
        if (fread(&length, sizeof length, 1, c->saved) != 1
            || (part->begin = ftello(c->saved)) < 0
            || length > (uint64_t)(size - part->begin))
            return 0;
        part->length = (off_t)length;
        if (fseeko(c->saved, part->length, SEEK_CUR) != 0)
            return 0;
    }
    return 1;
}

static int copy_part(const fvi_checkpoint *c, int i, FILE *to)
{
    char part[1 << 14];
    const off_t length = c->part[i].length;
    for (off_t done = 0; to && done < length && !ferror(to);) {
        const off_t left = length - done;
        const ssize_t got =
            pread(fileno(c->saved), part,
                  left < (off_t)sizeof part ? (size_t)left : sizeof part,
                  c->part[i].begin + done);
        if (got <= 0)
            return -1;
        fwrite(part, 1, (size_t)got, to);
        done += got;
    }
    return 0;
}

int fvi_checkpoint_judge_rows(const fvi_checkpoint *c, fvi_table *t)
{
    const fvi_options *o = t->o;
    char form[FORM], saved[FORM] = "";
    const off_t length = c->part[0].length;
    const int waits = fvi_output_waits(t->out);
    if (!c->saved || (c->anew && (waits || length > 0)))
        return 0; /* the table begins with its first row */
    if (length == 0 && waits && c->done > 0)
        return fvi_checkpoint_refuse(
            o, "its rows are on standard output, where the rest must go");
    t->begin = c->done < o->steps ? fvi_table_next(t, c->done) : o->steps + 1;
    if (length == 0)
        return 0;
    form_of(o, form);
    if (length < FORM
        && pread(fileno(c->saved), saved, (size_t)length, c->part[0].begin)
               != length)
        return fvi_checkpoint_refuse(o, "damaged");
    if (strcmp(form, saved) != 0)
        return fvi_checkpoint_refuse(o, "its rows have other --columns, "
                                        "--unknowns, --every, --format or "
                                        "--plot");
    t->goes_on = c->part[1].length > 0;
    if (c->done == o->steps && o->steps % o->every != 0)
        t->begin = o->steps; /* the last row was left out when the checkpoint was written */
    return 0;
}

int fvi_checkpoint_rows(const fvi_checkpoint *c, fvi_table *t)
{
    t->first = ftello(t->out); /* -1 for a pipe; t->first is not used then */
    if (t->goes_on
        && (copy_part(c, 1, t->out) != 0 || copy_part(c, 2, t->plot) != 0))
        return fvi_cannot_write(t->o->output);
    return 0;
}

/* ---- files ---- */

int fvi_checkpoint_write(const fvi_checkpoint *c, const fvi_table *t,
                         fvi_stepper *s)
{
    const char *name = t->o->checkpoint;
    fvi_checkpoint_in_rows(1);
    const int lost = fflush(t->out) != 0; /* the rows must be written before the state */
    fvi_checkpoint_in_rows(0);
    if (lost)
        return fvi_cannot_write(t->o->output);
    state f = { .archive = { save_piece },
                .file = fvi_output_open_file(name),
                .sum = FVI_FIRST_SUM };
    if (!f.file)
        return fvi_cannot_write(name);
    write_bytes(&f, c->head, strlen(c->head));
    write_rows(&f, t);
    const int status = archive_run(t, s, &f.archive);
    const uint64_t sum = f.sum;
    write_bytes(&f, &sum, sizeof sum);
    const int why = errno, whole = !status && !f.failed;
    if (fvi_output_close(f.file, whole) == 0 && whole)
        return 0;
    if (!whole)
        errno = why;
    return fvi_cannot_write(name);
}

/* Return nonzero if the last number of the file is the checksum of everything before it. The position in the file does
 * not change. */
static int is_whole(FILE *file)
{
    state f = { .file = file, .sum = FVI_FIRST_SUM };
    const long at = ftell(file);
    struct stat now;
    uint64_t sum = 0;
    if (at < 0 || fstat(fileno(file), &now) != 0
        || now.st_size < (off_t)sizeof sum)
        return 0;
    rewind(file);
    unsigned char part[4096];
    off_t left = now.st_size - (off_t)sizeof sum;
    for (size_t n; left > 0; left -= (off_t)n) {
        n = left < (off_t)sizeof part ? (size_t)left : sizeof part;
        if (!read_bytes(&f, part, n))
            return 0;
    }
    return fread(&sum, sizeof sum, 1, file) == 1 && sum == f.sum
           && fseek(file, at, SEEK_SET) == 0;
}

/* Read the state of a file whose checksum is right and whose problem is that of this run. If a constant piece differs
 * all the same, then either the memory depends on the number of steps and the number has changed, or another build of
 * the program with other last digits wrote the file. In both cases this program would have had other last digits from
 * the first step on. So the run begins again at the start. */
static int load_all(fvi_table *t, state *f, fvi_stepper *s, fvi_checkpoint *c)
{
    const fvi_options *o = t->o;
    const int status = archive_run(t, s, &f->archive);
    c->done = s->k;
    if (s->k > o->steps)
        return fvi_checkpoint_refuse(o, "it is further than --steps");
    if (status > 0) /* an error of the library, not of load_piece */
        return fvi_checkpoint_refuse(o, "not a state of such a run");
    if (status == 0)
        return 0;
    fprintf(stderr,
            "fvi: --continue: the memory depends on --steps, and on the version: the first %zu "
            "steps are done again\n",
            c->done);
    c->anew = 1;
    return fvi_stepper_reset(s) || fvi_run_observe(t, s, NULL)
               ? fvi_complain("not enough memory")
               : 0;
}

static int read_checkpoint(fvi_table *t, fvi_stepper *s, fvi_checkpoint *c)
{
    const fvi_options *o = t->o;
    struct stat now;
    c->saved = fopen(o->checkpoint, "r");
    state f = { .archive = { load_piece },
                .file = c->saved,
                .sum = FVI_FIRST_SUM };
    if (!c->saved)
        return fvi_checkpoint_unreadable(o);
    const int status = fvi_checkpoint_compare(o, c->saved, c->head);
    if (status)
        return status;
    return is_whole(c->saved) && fstat(fileno(c->saved), &now) == 0
                   && find_rows(c, now.st_size)
               ? load_all(t, &f, s, c)
               : fvi_checkpoint_refuse(o, "damaged");
}

int fvi_checkpoint_begin(fvi_table *t, fvi_stepper *s, fvi_checkpoint *c)
{
    const fvi_options *o = t->o;
    *c = (fvi_checkpoint){ .head = NULL };
    if (!o->checkpoint)
        return 0;
    if (s->method_state && !s->method->serialize) {
        fvi_error error;
        fvi_refuse(&error, "checkpoint", "not known to %s", s->method->name);
        return fvi_refused(&error, "run");
    }
    if (!(c->head = fvi_checkpoint_head(o)))
        return fvi_complain("not enough memory");
    return o->resume ? read_checkpoint(t, s, c) : 0;
}

void fvi_checkpoint_free(fvi_checkpoint *c)
{
    free(c->head);
    if (c->saved)
        fclose(c->saved);
}
