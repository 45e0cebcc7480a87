/* src/program/fvi_checkpoint.c -- The state of a run in a file. */
#define _GNU_SOURCE
#include "fvi_checkpoint.h"

#include "output/fvi_complain.h"
#include <fvi/error.h>
#include <fvi/version.h>

#include <errno.h>
#include <inttypes.h>
#include <limits.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

/* A file is a line with the version, a line for each parameter, an empty line, then the
 * pieces that fvi_visit shows, each behind its length, then the checksum of all before. */
typedef struct {
    fvi_visitor visitor; /* the first: a pointer to it is one to this */
    FILE *file;
    uint64_t sum;
    int failed; /* a read or a write */
} state;

#define FIRST_SUM 0xcbf29ce484222325u

/* FNV-1a. */
static void add_to_sum(state *f, const void *data, size_t bytes)
{
    const unsigned char *at = data;
    for (size_t i = 0; i < bytes; i++)
        f->sum = (f->sum ^ at[i]) * 0x100000001b3u;
}

static void put(state *f, const void *data, size_t bytes)
{
    f->failed |= fwrite(data, 1, bytes, f->file) != bytes;
    add_to_sum(f, data, bytes);
}

static int get(state *f, void *data, size_t bytes)
{
    if (fread(data, 1, bytes, f->file) != bytes)
        return 0;
    add_to_sum(f, data, bytes);
    return 1;
}

static int save_piece(fvi_visitor *v, void *data, size_t bytes, int constant)
{
    state *f = (state *)v;
    const uint64_t length = bytes;
    (void)constant;
    put(f, &length, sizeof length);
    put(f, data, bytes);
    return f->failed ? -1 : 0;
}

/* What is constant is compared, by parts. */
static int is_same(state *f, const unsigned char *data, size_t bytes)
{
    unsigned char part[4096];
    for (size_t n; bytes > 0; bytes -= n, data += n) {
        n = bytes < sizeof part ? bytes : sizeof part;
        if (!get(f, part, n) || memcmp(part, data, n) != 0)
            return 0;
    }
    return 1;
}

static int load_piece(fvi_visitor *v, void *data, size_t bytes, int constant)
{
    state *f = (state *)v;
    uint64_t length;
    if (!get(f, &length, sizeof length) || length != bytes)
        return -1;
    return (constant ? is_same(f, data, bytes) : get(f, data, bytes)) ? 0 : -1;
}

/* ---- the head ---- */

/* What may be another one when a run goes on. */
static int is_free(const char *name)
{
    static const char *const names[] = { "steps", "time", "columns", "unknowns",
                                         "every" };
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (strcmp(name, names[i]) == 0)
            return 1;
    return 0;
}

/* What the matrices of --system are, in a number: the folder's name does not tell. */
static uint64_t sum_of(const fvi_directory *directory)
{
    const fvi_sparse *A[3];
    state f = { .sum = FIRST_SUM };
    fvi_directory_matrices(directory, A);
    for (int l = 0; l < 3; l++) {
        const size_t n = A[l]->n, count = n ? (size_t)A[l]->start[n] : 0;
        add_to_sum(&f, &n, sizeof n);
        add_to_sum(&f, A[l]->start, n ? (n + 1) * sizeof *A[l]->start : 0);
        add_to_sum(&f, A[l]->row, count * sizeof *A[l]->row);
        add_to_sum(&f, A[l]->entry, count * sizeof *A[l]->entry);
    }
    return f.sum;
}

/* The head as a text of its own; NULL if there is no memory. */
static char *head_of(const fvi_options *o)
{
    const char *name, *value;
    char *text = NULL;
    size_t size;
    FILE *f = open_memstream(&text, &size);
    if (!f)
        return NULL;
    fprintf(f, "fvi " FVI_VERSION " checkpoint\n");
    for (size_t i = 0; fvi_options_describe(o, i, &name, &value); i++)
        if (!is_free(name))
            fprintf(f, "%s = %s\n", name, value);
    if (o->directory)
        fprintf(f, "matrices = %016" PRIx64 "\n", sum_of(o->directory));
    fputc('\n', f);
    if (fclose(f) == 0)
        return text;
    free(text);
    return NULL;
}

static int refuse(const fvi_options *o, const char *why)
{
    char text[FVI_COMPLAINT];
    const int status = fvi_refuse((fvi_complaint){ text, sizeof text },
                                  "--continue: %s: %s", o->checkpoint, why);
    fvi_refused(text, "run");
    return status;
}

/* How the line of a saved head differs from the wanted one, "name = value" both: by its value,
 * or because one of the two heads has no such name. */
static void tell_apart(const char *line, const char *want, const char *head,
                       size_t size, char *why)
{
    const size_t name = strcspn(line, " "), length = strcspn(want, "\n");
    char known[100];
    snprintf(known, sizeof known, "\n%.*s = ", (int)name, line);
    if (strncmp(line, want, name + 1) == 0)
        snprintf(why, size, "a run with %.150s, not %.*s", line, (int)length,
                 want);
    else if (name > 0 && !strstr(head, known))
        snprintf(why, size, "a run with %.150s, which is not given here", line);
    else
        snprintf(why, size, "a run without %.*s", (int)length, want);
}

/* The head, line by line: the first that differs is said. */
static int compare_heads(const fvi_options *o, state *f, const char *head)
{
    char *line = NULL;
    size_t room = 0;
    int status = 0;
    for (const char *want = head; !status && *want;) {
        const size_t length = strcspn(want, "\n") + 1;
        const ssize_t got = getline(&line, &room, f->file);
        if (got > 0)
            add_to_sum(f, line, (size_t)got);
        if (got == (ssize_t)length && memcmp(line, want, length) == 0) {
            want += length;
            continue;
        }
        char why[400];
        if (got > 0 && line[got - 1] == '\n')
            line[got - 1] = '\0';
        if (want == head)
            snprintf(why, sizeof why, "%s",
                     got > 4 && strncmp(line, "fvi ", 4) == 0
                         ? "a checkpoint of another version"
                         : "not a checkpoint");
        else
            tell_apart(got > 0 ? line : "", want, head, sizeof why, why);
        status = refuse(o, why);
    }
    free(line);
    return status;
}

/* ---- files ---- */

static int write_all(const char *name, const char *head, fvi_stepper *s)
{
    state f = { .visitor = { save_piece },
                .file = fopen(name, "w"),
                .sum = FIRST_SUM };
    if (!f.file)
        return 0;
    put(&f, head, strlen(head));
    int status = fvi_visit(s, &f.visitor);
    const uint64_t sum = f.sum;
    put(&f, &sum, sizeof sum);
    status |= fflush(f.file) != 0 || fsync(fileno(f.file)) != 0;
    return !(fclose(f.file) != 0 || status || f.failed);
}

int fvi_checkpoint_write(const fvi_options *o, fvi_stepper *s)
{
    char new[PATH_MAX], *head = head_of(o);
    const int length = snprintf(new, sizeof new, "%s.new", o->checkpoint);
    struct stat old;
    int done = 0;
    errno = ENAMETOOLONG;
    if (stat(o->checkpoint, &old) == 0 && !S_ISREG(old.st_mode))
        errno = EEXIST; /* a device, say, that must stay one */
    else if (head && length < (int)sizeof new)
        done = write_all(new, head, s) && rename(new, o->checkpoint) == 0;
    const int why = errno;
    if (!done && length < (int)sizeof new)
        unlink(new);
    free(head);
    errno = why;
    return done ? 0 : fvi_cannot_write(o->checkpoint);
}

/* Is the last number of the file the sum of all before? The file stays where it is. */
static int is_whole(FILE *file)
{
    state f = { .file = file, .sum = FIRST_SUM };
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
        if (!get(&f, part, n))
            return 0;
    }
    return fread(&sum, sizeof sum, 1, file) == 1 && sum == f.sum
           && fseek(file, at, SEEK_SET) == 0;
}

/* The file is whole, and of this problem. If it does not fit all the same, the memory depends
 * on N, and N is another one: a run of the new N had other last digits from the first
 * step on, and so it begins anew. */
static int load_all(const fvi_options *o, state *f, fvi_stepper *s,
                    size_t *done)
{
    const int status = fvi_visit(s, &f->visitor);
    *done = s->k;
    if (s->k > o->steps)
        return refuse(o, "it is further than --steps");
    if (status == 0)
        return 0;
    fprintf(stderr,
            "fvi: --continue: the memory depends on --steps: the first %zu "
            "steps are done again\n",
            *done);
    return fvi_reset(s) ? fvi_complain("not enough memory") : 0;
}

static int read_checkpoint(const fvi_options *o, fvi_stepper *s, size_t *done)
{
    state f = { .visitor = { load_piece },
                .file = fopen(o->checkpoint, "r"),
                .sum = FIRST_SUM };
    if (!f.file)
        return refuse(o, strerror(errno));
    char *head = head_of(o);
    int status =
        head ? compare_heads(o, &f, head) : fvi_complain("not enough memory");
    if (!status)
        status =
            is_whole(f.file) ? load_all(o, &f, s, done) : refuse(o, "damaged");
    free(head);
    fclose(f.file);
    return status;
}

int fvi_checkpoint_begin(const fvi_options *o, fvi_stepper *s, size_t *done)
{
    *done = 0;
    if (s->own && !s->method->visit) {
        char text[FVI_COMPLAINT];
        const int status =
            fvi_refuse((fvi_complaint){ text, sizeof text },
                       "--checkpoint: not known to %s", s->method->name);
        fvi_refused(text, "run");
        return status;
    }
    return o->resume ? read_checkpoint(o, s, done) : 0;
}

/* ---- when ---- */

static volatile sig_atomic_t signal_number;

static void note(int number)
{
    signal_number = number;
}

void fvi_checkpoint_watch(void)
{
    static const int ends[] = { SIGINT, SIGTERM, SIGHUP };
    for (size_t i = 0; i < sizeof ends / sizeof *ends; i++)
        if (signal(ends[i], note) == SIG_IGN)
            signal(ends[i], SIG_IGN);
}

int fvi_checkpoint_stopped(void)
{
    return signal_number != 0;
}

void fvi_checkpoint_end(void)
{
    if (!signal_number)
        return;
    signal(signal_number, SIG_DFL);
    raise(signal_number);
}

int fvi_checkpoint_due(void)
{
    static double last = -1;
    struct timespec clock;
    clock_gettime(CLOCK_MONOTONIC, &clock);
    const double now = (double)clock.tv_sec + 1e-9 * (double)clock.tv_nsec;
    if (last < 0)
        last = now;
    if (now - last < 10)
        return 0;
    last = now;
    return 1;
}
