/* src/input/fvi_files.c -- Find out which file a name stands for, and which files were read. */
#define _GNU_SOURCE /* for PATH_MAX */
#include "fvi_files.h"
#include <fvi/parse_words.h>

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* Find the ordinary file of this name; `last` is then "". If it does not exist, find the folder in which it would be
 * made; `last` is then its name in that folder. Return 0 if neither exists. */
static int find_ordinary_file(const char *name, struct stat *file, const char **last)
{
    char folder[PATH_MAX];
    *last = "";
    if ((name ? stat(name, file) : fstat(STDOUT_FILENO, file)) == 0)
        return S_ISREG(file->st_mode);
    if (!name)
        return 0;
    const char *slash = strrchr(name, '/');
    *last = slash ? slash + 1 : name;
    snprintf(folder, sizeof folder, "%.*s.", (int)(*last - name), name);
    return stat(folder, file) == 0;
}

int fvi_same_file(const char *a, const char *b)
{
    struct stat of_a, of_b;
    const char *last_a, *last_b;
    a = a && strcmp(a, "-") == 0 ? NULL : a;
    b = b && strcmp(b, "-") == 0 ? NULL : b;
    if (a == b || (a && b && strcmp(a, b) == 0))
        return 1;
    return find_ordinary_file(a, &of_a, &last_a) && find_ordinary_file(b, &of_b, &last_b)
           && of_a.st_dev == of_b.st_dev && of_a.st_ino == of_b.st_ino
           && strcmp(last_a, last_b) == 0;
}

int fvi_may_be_ordinary(const char *name)
{
    struct stat file;
    return stat(name, &file) != 0 || S_ISREG(file.st_mode);
}

enum { KEPT = 1000 };
static struct {
    const char *option;
    char *name;
    dev_t device;
    ino_t number;
} inputs[KEPT];
static size_t marks; /* number of all marks, including those that were overwritten */

void fvi_mark_read(const char *option, const char *name)
{
    struct stat file;
    if (stat(name, &file) != 0 || !S_ISREG(file.st_mode))
        return;
    free(inputs[marks % KEPT].name);
    inputs[marks % KEPT].name = strdup(name);
    inputs[marks % KEPT].option = option;
    inputs[marks % KEPT].device = file.st_dev;
    inputs[marks % KEPT].number = file.st_ino;
    marks++;
}

/* If the text is "@file", record that the file is read. */
static void mark_list(const char *field, const char *text)
{
    if (*text == '@')
        fvi_mark_read(strncmp(field, "DATA", 4) == 0 ? "DATA" : field, text + 1);
}

int fvi_read_numbers(const char *field, const char *text, double low, double high, const char *brackets, size_t d,
                     double *values, fvi_error *c)
{
    mark_list(field, text);
    return fvi_parse_numbers(field, text, low, high, brackets, d, values, c);
}

int fvi_read_list(const char *field, const char *text, double low, double high, const char *brackets, size_t *count,
                  double **values, fvi_error *c)
{
    mark_list(field, text);
    return fvi_parse_list(field, text, low, high, brackets, count, values, c);
}

size_t fvi_marked_files(void)
{
    return marks < KEPT ? marks : KEPT;
}

const char *fvi_marked_file(size_t i)
{
    return inputs[i].name;
}

const char *fvi_marked_option(size_t i)
{
    return inputs[i].option;
}

int fvi_check_output(const char *option, const char *name, fvi_error *c)
{
    struct stat file;
    if (!name || strcmp(name, "-") == 0 || stat(name, &file) != 0)
        return 0;
    for (size_t i = 0; i < fvi_marked_files(); i++)
        if (inputs[i].device == file.st_dev && inputs[i].number == file.st_ino)
            return fvi_refuse(c, NULL,
                              strcmp(inputs[i].option, "DATA") == 0
                                  ? "%s: '%s' is the file of the data, too"
                                  : "%s: '%s' is the file of --%s, too",
                              option, name, inputs[i].option);
    return 0;
}

int fvi_check_second_file(const char *option, const char *name, const char *table, fvi_error *c)
{
    if (name && !*name)
        return fvi_refuse(c, option, "'' is not a file's name");
    return name && fvi_same_file(name, table) ? fvi_refuse(c, option, "'%s' is the table's file, too", name) : 0;
}
