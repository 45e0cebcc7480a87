/* src/input/fvi_problem_words.c -- Read options of the command line from a file. */
#define _GNU_SOURCE /* for asprintf */
#include "fvi_problem_words.h"
#include "fvi_files.h"

#include <ctype.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The list of words, ended by NULL. */
typedef struct {
    char **word;
    int count, room;
} list;

static int add(list *l, char *word, fvi_error *error)
{
    if (l->count + 1 >= l->room) {
        const int room = 2 * l->room + 64;
        char **more = realloc(l->word, (size_t)room * sizeof *more);
        if (!more)
            word = NULL;
        else
            l->word = more;
        if (more)
            l->room = room;
    }
    if (!word)
        return fvi_no_memory(error, "problem");
    l->word[l->count++] = word;
    l->word[l->count] = NULL;
    return 0;
}

static char *trim(char *text)
{
    while (isspace((unsigned char)*text))
        text++;
    size_t n = strlen(text);
    while (n > 0 && isspace((unsigned char)text[n - 1]))
        text[--n] = '\0';
    return text;
}

/* Add the words of a line: "NAME VALUE", "NAME = VALUE" or "NAME" alone. */
static int parse_line(list *l, const char *file, size_t number, char *line,
                      fvi_error *error)
{
    char *word = NULL;
    line = trim(line);
    if (*line == '\0' || *line == '#')
        return 0;
    const size_t name =
        strspn(line, "abcdefghijklmnopqrstuvwxyz0123456789-ABCDEFGHIJKLMNOPQRSTUVWXYZ");
    if (name == 0 || *line == '-'
        || (line[name] && !strchr(" \t=", line[name])))
        return fvi_refuse(error, "problem",
                          "%s, line %zu: '%.40s' does not begin with the name of an option, without --", file, number,
                          line);
    if (strncmp(line, "problem", name) == 0 && name == 7)
        return fvi_refuse(error, "problem", "%s, line %zu: a file in a file", file, number);
    char *value = trim(line + name);
    if (*value == '=')
        value = trim(value + 1);
    else if (*value == '\0')
        value = NULL;
    const int is_output = name == 1 && *line == 'o'; /* -o FILE */
    if (asprintf(&word, "%s%.*s%s%s", is_output ? "-" : "--", (int)name, line,
                 value && !is_output ? "=" : "",
                 value && !is_output ? value : "")
        < 0)
        word = NULL;
    int status = add(l, word, error);
    if (!status && is_output && value)
        status = add(l, strdup(value), error);
    return status;
}

/* Skip the byte order mark with which editors on Windows begin a file. */
static char *skip_byte_order_mark(char *line)
{
    return strncmp(line, "\xef\xbb\xbf", 3) == 0 ? line + 3 : line;
}

/* Read a line without its end; *found becomes 0 if there is none. A NUL byte ends the reading at once, because a device
 * may give NUL bytes for ever. Return 0, FVI_EINVAL after a NUL byte, or FVI_ENOMEM. */
static int read_line(FILE *f, char **line, size_t *room, int *found)
{
    size_t n = 0;
    int byte;
    while ((byte = getc(f)) != EOF && byte != '\n' && byte != '\0') {
        if (n + 2 > *room) {
            char *more = realloc(*line, 2 * *room + 256);
            if (!more)
                return FVI_ENOMEM;
            *line = more;
            *room = 2 * *room + 256;
        }
        (*line)[n++] = (char)byte;
    }
    *found = n > 0 || byte == '\n';
    if (n > 0)
        (*line)[n] = '\0';
    else if (*line)
        **line = '\0';
    return byte == '\0' ? FVI_EINVAL : 0;
}

static int read_problem_file(list *l, const char *name, fvi_error *error)
{
    FILE *f = fopen(name, "r");
    char *line = NULL;
    size_t room = 0, number = 0;
    int status = 0, found = 1;
    if (!f)
        return fvi_refuse(error, "problem", "cannot read '%s': %s", name, strerror(errno));
    fvi_mark_read("problem", name);
    errno = 0;
    while (!status && found) {
        number++;
        status = read_line(f, &line, &room, &found);
        if (status)
            status = status == FVI_ENOMEM ? fvi_no_memory(error, "problem")
                                          : fvi_refuse(error, "problem", "%s, line %zu: a NUL byte", name, number);
        else if (found && line)
            status = parse_line(l, name, number, number == 1 ? skip_byte_order_mark(line) : line, error);
    }
    if (!status && ferror(f))
        status = fvi_refuse(error, "problem", "cannot read '%s': %s", name, strerror(errno));
    free(line);
    fclose(f);
    return status;
}

int fvi_word_is_option(const char *word, const char *name)
{
    const size_t length = strcspn(word, "=");
    return strncmp(word, "--", 2) == 0 && length == strlen(name) + 2 && strncmp(word + 2, name, length - 2) == 0;
}

int fvi_option_with_value(char *const *words, int *i, const char *name, const char **value)
{
    if (!fvi_word_is_option(words[*i], name))
        return 0;
    const char *equals = strchr(words[*i], '=');
    *value = equals ? equals + 1 : words[++*i];
    return 1;
}

int fvi_problem_words(int *argc, char ***argv, fvi_error *error)
{
    static list l; /* The list lives as long as the process, because options point into it. */
    int found = 0, status = 0;
    for (int i = 0; i < *argc && !status; i++) {
        const char *file;
        if (i < 2 || !fvi_option_with_value(*argv, &i, "problem", &file)) {
            status = add(&l, (*argv)[i], error);
            continue;
        }
        found = 1;
        status = file ? read_problem_file(&l, file, error)
                      : fvi_refuse(error, NULL, "--problem: a value is missing");
    }
    if (!found)
        return status;
    *argc = l.count;
    *argv = l.word;
    return status;
}
