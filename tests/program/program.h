/* tests/program/program.h -- Running build/fvi as a user would, in a folder of its own. */
#ifndef PROGRAM_H
#define PROGRAM_H

#include "harness/ulp.h"

#include <fcntl.h>
#include <limits.h>
#include <spawn.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

static char out[1 << 20], err[4096]; /* what the last command printed */
static char folder[PATH_MAX];        /* made beside the program */

static inline void read_file(const char *name, char *text, size_t size)
{
    FILE *f = fopen(name, "r");
    size_t n = f ? fread(text, 1, size - 1, f) : 0;
    text[n] = '\0';
    if (f)
        fclose(f);
}

/* Fill out and err; the exit code of what wrote them. */
static inline int collect(int status)
{
    char name[PATH_MAX + 10];
    snprintf(name, sizeof name, "%s/out", folder);
    read_file(name, out, sizeof out);
    snprintf(name, sizeof name, "%s/err", folder);
    read_file(name, err, sizeof err);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128;
}

/* Run a shell command in the test's own folder; fill out and err. $FVI is the
 * program. */
static inline int shell(const char *command)
{
    char line[PATH_MAX + 3000];
    snprintf(line, sizeof line, "cd '%s' && { %s\n} >out 2>err", folder,
             command);
    return collect(system(line));
}

/* A piece of a shell's line: wait until the program $pid catches SIGTERM, 5 s at most. On a busy machine it may take
 * that long to begin, and a signal before it catches one tests nothing. The fourth digit of the mask is that of the
 * signals 13 to 16; a run with a checkpoint catches SIGALRM, too, and has [67ef] there. */
#define CATCHES_TERM "[4-7c-f]"
#define CATCHES_TERM_AND_ALARM "[67ef]"
#define WAIT_UNTIL(catches)                                                             \
    "n=0; until grep -q '^SigCgt:.*" catches "...$' /proc/$pid/status || "              \
    "[ $((n += 1)) -gt 500 ]; do sleep 0.01; done; "

/* The program alone, without a shell: words are what spaces divide. */
static inline int fvi_of_words(const char *arguments)
{
    enum { ROOM = 1800, WORDS = ROOM / 2 };
    const int flags = O_WRONLY | O_CREAT | O_TRUNC;
    char line[ROOM], *word[WORDS + 1] = { getenv("FVI") };
    posix_spawn_file_actions_t files;
    pid_t child;
    int status = 0;
    ck_assert_uint_lt(strlen(arguments), sizeof line);
    strcpy(line, arguments);
    for (size_t n = 0; n < WORDS && word[n]; n++)
        word[n + 1] = strtok(n ? NULL : line, " ");
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_addchdir_np(&files, folder);
    posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, "out", flags, 0666);
    posix_spawn_file_actions_addopen(&files, STDERR_FILENO, "err", flags, 0666);
    ck_assert_int_eq(posix_spawn(&child, word[0], &files, NULL, word, environ),
                     0);
    posix_spawn_file_actions_destroy(&files);
    ck_assert_int_eq(waitpid(child, &status, 0), child);
    return collect(status);
}

/* The program alone; where a shell has to read the words, it becomes the program. */
static inline int fvi(const char *arguments)
{
    char line[1800];
    if (!strpbrk(arguments, "'\"\\`$*?[](){}<>|&;~#!\t\n"))
        return fvi_of_words(arguments);
    snprintf(line, sizeof line, "exec \"$FVI\" %s", arguments);
    return shell(line);
}

static inline int exists(const char *name)
{
    char path[PATH_MAX + 100];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    return access(path, F_OK) == 0;
}

/* Write a file into the folder of the test. */
static inline void write_file(const char *name, const char *text)
{
    char path[PATH_MAX + 100];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *f = fopen(path, "w");
    ck_assert_ptr_nonnull(f);
    fputs(text, f);
    ck_assert_int_eq(fclose(f), 0);
}

static inline size_t count_lines(const char *text)
{
    size_t n = 0;
    for (; *text; text++)
        n += *text == '\n';
    return n;
}

/* The first row of the table in out. */
static inline const char *first_row(void)
{
    const char *row = out;
    while (*row == '#')
        row = strchr(row, '\n') + 1;
    return row;
}

static inline size_t count_rows(void)
{
    return count_lines(first_row());
}

/* Column c of row k of the table in out. */
static inline double cell(size_t k, size_t c)
{
    const char *at = first_row();
    while (k-- > 0)
        at = strchr(at, '\n') + 1;
    while (c-- > 0)
        at = strchr(at, '\t') + 1;
    return strtod(at, NULL);
}

/* The folder, and $FVI as an absolute path. */
static inline int prepare(void)
{
    const char *program = getenv("FVI");
    char *path = realpath(program ? program : "build/fvi", NULL);
    if (!path)
        return -1;
    setenv("FVI", path, 1);
    int length = snprintf(folder, sizeof folder, "%s-test-XXXXXX", path);
    free(path);
    return length < (int)sizeof folder && mkdtemp(folder) ? 0 : -1;
}

static inline int clean_up(void)
{
    char line[PATH_MAX + 100];
    snprintf(line, sizeof line, "rm -rf '%s'", folder);
    return system(line);
}

/* Run the suite in its folder. Exit status for main. */
static inline int run_suite_of_program(Suite *suite)
{
    if (prepare() != 0) {
        perror("build/fvi, or a folder for it");
        return 1;
    }
    int failed = run_suite(suite);
    return clean_up() != 0 || failed;
}

/* Exit code 2, nothing printed, and what is said first. */
#define ck_assert_refused(line, said) ck_assert_refused_with(line, said "\n")

/* The same, with a caret at the end of `said`: the pointer to the help is behind it. */
#define ck_assert_refused_at(line, said)                                       \
    do {                                                                       \
        ck_assert_refused_with(line, said "  Try 'fvi ");                      \
        ck_assert_uint_eq(count_lines(err), 2);                                \
    } while (0)

#define ck_assert_refused_with(line, said)                                     \
    do {                                                                       \
        ck_assert_msg(fvi(line) == 2, "%s", line);                             \
        ck_assert_str_eq(out, "");                                             \
        ck_assert_msg(strncmp(err, said, strlen(said)) == 0, "%s", err);       \
    } while (0)

#endif
