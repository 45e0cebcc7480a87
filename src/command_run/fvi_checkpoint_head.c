/* src/command_run/fvi_checkpoint_head.c -- Write and compare the heads of checkpoints, which say to which run a
 * checkpoint belongs. */
#define _GNU_SOURCE
#include "fvi_checkpoint_head.h"

#include "input/fvi_files.h"
#include "options/fvi_option_columns.h"
#include "output/fvi_complain.h"
#include <fvi/version.h>

#include <errno.h>
#include <inttypes.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The hash is FNV-1a with 64 bits. */
uint64_t fvi_add_to_sum(uint64_t sum, const void *data, size_t bytes)
{
    const unsigned char *at = data;
    for (size_t i = 0; i < bytes; i++)
        sum = (sum ^ at[i]) * 0x100000001b3u;
    return sum;
}

/* Return nonzero if this option may change when a run goes on. */
static int is_free(const char *name)
{
    static const char *const names[] = { "steps", "time", "columns", "unknowns", "every", NULL };
    return fvi_is_one_of(name, names);
}

/* Write a line for each file that was read for the problem, with a hash of its contents, because a file may change and
 * keep its name. Return 0 if there is no memory. */
static int describe_files(FILE *head)
{
    char part[1 << 14];
    for (size_t i = 0; i < fvi_marked_files(); i++) {
        const char *name = fvi_marked_file(i);
        if (strcmp(fvi_marked_option(i), "problem") == 0)
            continue; /* the head contains the options of that file */
        uint64_t sum = FVI_FIRST_SUM;
        FILE *f = name ? fopen(name, "r") : NULL;
        if (!name || (!f && errno == ENOMEM))
            return 0;
        for (size_t n; f && (n = fread(part, 1, sizeof part, f)) > 0;)
            sum = fvi_add_to_sum(sum, part, n);
        if (f)
            fclose(f);
        fputs("file ", head);
        for (const char *c = name; *c; c++) /* keep the line a single line */
            fputc((unsigned char)*c < ' ' ? '?' : *c, head);
        fprintf(head, " = %016" PRIx64 "\n", sum);
    }
    return 1;
}

char *fvi_checkpoint_head(const fvi_options *o)
{
    const char *name, *value;
    char *text = NULL;
    size_t size;
    FILE *f = open_memstream(&text, &size);
    if (!f)
        return NULL;
    fprintf(f, "fvi " FVI_VERSION " checkpoint 5\n");
    for (size_t i = 0; fvi_options_describe(o, i, &name, &value); i++)
        if (!is_free(name))
            fprintf(f, "%s = %s\n", name, value);
    if (fvi_options_observes(o)) /* then the state has more pieces */
        fprintf(f, "columns with sums = yes\n");
    int whole = describe_files(f);
    fputc('\n', f);
    whole = whole && !ferror(f);
    if (fclose(f) == 0 && whole)
        return text;
    free(text);
    return NULL;
}

int fvi_checkpoint_refuse(const fvi_options *o, const char *why)
{
    fvi_error error;
    fvi_refuse(&error, "continue", "%s: %s", o->checkpoint, why);
    return fvi_refused(&error, "run");
}

int fvi_checkpoint_unreadable(const fvi_options *o)
{
    return errno == ENOMEM ? fvi_complain("not enough memory")
                           : fvi_checkpoint_refuse(o, strerror(errno));
}

/* Return the length of "file NAME" in a line of the head, or 0 if the line is about something else. */
static size_t file_in(const char *line)
{
    const size_t length = strcspn(line, "\n");
    const int is = strncmp(line, "file ", 5) == 0 && length > 24;
    return is ? length - 19 : 0; /* " = " and 16 digits */
}

/* Say how two lines differ if at least one of them is about a file: the file has changed, or only one of the runs reads
 * it. */
static void describe_file_difference(const char *line, const char *want,
                                     const char *head, size_t size, char *why)
{
    const size_t saved = file_in(line), wanted = file_in(want);
    const char *at = head;
    while (saved > 0 && *at
           && !(strncmp(at, line, saved) == 0 && file_in(at) == saved))
        at += strcspn(at, "\n") + 1;
    if (saved > 0 && *at)
        snprintf(why, size, "the %.*s has changed", (int)saved, line);
    else if (saved > 0)
        snprintf(why, size, "a run with the %.*s, which is not given here",
                 (int)saved, line);
    else
        snprintf(why, size, "a run without the %.*s", (int)wanted, want);
}

/* Say how the line of a saved head differs from the wanted line. Both are "name = value". Either the values differ, or
 * one of the two heads has no such name. */
static void describe_difference(const char *line, const char *want, const char *head,
                                size_t size, char *why)
{
    const size_t name = strcspn(line, " "), length = strcspn(want, "\n");
    char known[100];
    if (file_in(line) > 0 || file_in(want) > 0) {
        describe_file_difference(line, want, head, size, why);
        return;
    }
    snprintf(known, sizeof known, "\n%.*s = ", (int)name, line);
    if (strncmp(line, want, name + 1) == 0)
        snprintf(why, size, "a run with %.150s, not %.*s", line, (int)length,
                 want);
    else if (name > 0 && !strstr(head, known))
        snprintf(why, size, "a run with %.150s, which is not given here", line);
    else
        snprintf(why, size, "a run without %.*s", (int)length, want);
}

/* Say why a file with this first line is refused. Older versions could also sum the history by FFT. For such a file
 * the message names the values of --memory that are left. Return 0 if the file cannot be read; errno then has the
 * reason. */
static int describe_version(const char *line, FILE *file, char *why,
                            size_t size)
{
    char *next = NULL;
    size_t room = 0;
    int names_fft = 0;
    const int is_checkpoint = strncmp(line, "fvi ", 4) == 0;
    ssize_t got = is_checkpoint ? 2 : 0;
    while (!names_fft && got > 1) {
        got = getline(&next, &room, file);
        names_fft = got > 1 && strcmp(next, "memory = fft\n") == 0;
    }
    free(next);
    if (got < 0 && !feof(file))
        return 0;
    snprintf(why, size, "%s",
             names_fft ? "a run with memory = fft, which this version does not "
                         "have; it has direct and exponentials"
             : is_checkpoint ? "a checkpoint of another version"
                             : "not a checkpoint");
    return 1;
}

int fvi_checkpoint_compare(const fvi_options *o, FILE *file, const char *head)
{
    char *line = NULL;
    size_t room = 0;
    int status = 0;
    for (const char *want = head; !status && *want;) {
        const size_t length = strcspn(want, "\n") + 1;
        const ssize_t got = getline(&line, &room, file);
        if (got == (ssize_t)length && memcmp(line, want, length) == 0) {
            want += length;
            continue;
        }
        char why[PATH_MAX + 100];
        int is_read = got > 0 || feof(file);
        if (got > 0 && line[got - 1] == '\n')
            line[got - 1] = '\0';
        if (is_read && want == head)
            is_read = describe_version(got > 0 ? line : "", file, why, sizeof why);
        else if (is_read)
            describe_difference(got > 0 ? line : "", want, head, sizeof why, why);
        status = is_read ? fvi_checkpoint_refuse(o, why)
                         : fvi_checkpoint_unreadable(o);
    }
    free(line);
    return status;
}
