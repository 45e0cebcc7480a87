/* src/input/fvi_compile.c -- A file of C becomes a shared object. */
#define _GNU_SOURCE
#include "fvi_compile.h"

#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <signal.h>
#include <spawn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

extern char **environ;

enum { PATH = PATH_MAX + 64 };

/* -I for the headers beside this program: where `make install` puts them, and where they
 * are in the folder that it was made in. */
static void includes(char flag[2][PATH])
{
    static const char *const places[] = { "include", "src" };
    char self[PATH_MAX] = "";
    const ssize_t length = readlink("/proc/self/exe", self, sizeof self - 1);
    self[length > 0 ? length : 0] = '\0';
    char *slash = strrchr(self, '/');
    if (slash)
        *slash = '\0';
    for (int i = 0; i < 2; i++)
        snprintf(flag[i], sizeof flag[i], "-I%s/../%s", self, places[i]);
}

static const char *compiler(void)
{
    const char *cc = getenv("CC");
    return cc && cc[strspn(cc, " ")] ? cc : "cc";
}

/* The words of $CC, as in "ccache gcc -m64", and how many. */
static size_t split(char *cc, const char **words)
{
    size_t count = 0;
    char *rest;
    for (char *word = strtok_r(cc, " ", &rest); word;
         word = strtok_r(NULL, " ", &rest))
        words[count++] = word;
    return count;
}

/* Runs the compiler, under these blocked signals; it says what it has to say into the file
 * `log`. Returns 0, or 1. */
static int run_compiler(const char *file, const char *object, const char *log,
                        const sigset_t *blocked)
{
    char flag[2][PATH], cc[PATH];
    if (strlen(compiler()) >= sizeof cc)
        return 1;
    includes(flag);
    const char *const options[] = { "-O2",   "-fPIC", "-ffp-contract=off",
                                    "-shared", flag[0], flag[1],
                                    "-o",      object,  file,
                                    "-lm",     NULL };
    const char *words[PATH / 2 + sizeof options / sizeof *options];
    memcpy(words + split(strcpy(cc, compiler()), words), options,
           sizeof options);
    posix_spawn_file_actions_t files;
    posix_spawnattr_t signals;
    pid_t child;
    int ended = 1;
    if (posix_spawn_file_actions_init(&files))
        return 1;
    posix_spawnattr_init(&signals);
    posix_spawnattr_setsigmask(&signals, blocked);
    posix_spawnattr_setflags(&signals, POSIX_SPAWN_SETSIGMASK);
    posix_spawn_file_actions_addopen(&files, 1, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_addopen(&files, 2, log,
                                     O_WRONLY | O_CREAT | O_TRUNC, 0600);
    const int spawned = posix_spawnp(&child, words[0], &files, &signals,
                                     (char *const *)words, environ);
    while (spawned == 0 && waitpid(child, &ended, 0) < 0 && errno == EINTR)
        ;
    posix_spawnattr_destroy(&signals);
    posix_spawn_file_actions_destroy(&files);
    return ended != 0;
}

/* The first line of the log that speaks of an error. */
static void first_error(const char *log, size_t size, char *line)
{
    FILE *f = fopen(log, "r");
    int found = 0;
    while (f && !found && fgets(line, (int)size, f))
        found = strstr(line, "error") != NULL;
    if (f)
        fclose(f);
    line[strcspn(line, "\n")] = '\0';
    if (!found)
        snprintf(line, size, "the compiler %s does not run", compiler());
}

int fvi_compile(const char *file, void **library, size_t size, char *why)
{
    const char *folder = getenv("TMPDIR");
    char place[PATH_MAX], object[PATH], log[PATH];
    sigset_t all, before;
    const int length = snprintf(place, sizeof place, "%s/fvi-XXXXXX",
                                folder && *folder ? folder : "/tmp");
    *library = NULL;
    if (length >= (int)sizeof place)
        errno = ENAMETOOLONG;
    sigfillset(
        &all); /* what would end the program waits until the folder is gone */
    sigprocmask(SIG_BLOCK, &all, &before);
    if (length >= (int)sizeof place || !mkdtemp(place)) {
        snprintf(why, size, "no folder for the compiler: %s", strerror(errno));
        sigprocmask(SIG_SETMASK, &before, NULL);
        return 1;
    }
    snprintf(object, sizeof object, "%s/potential.so", place);
    snprintf(log, sizeof log, "%s/log", place);
    if (run_compiler(file, object, log, &before))
        first_error(log, size, why);
    else if (!(*library = dlopen(object, RTLD_NOW)))
        snprintf(why, size, "%s", dlerror());
    remove(object); /* what is loaded stays */
    remove(log);
    rmdir(place);
    sigprocmask(SIG_SETMASK, &before, NULL);
    return *library == NULL;
}
