/* src/input/fvi_compile.c -- Compile a C file to a shared object. */
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
#include <time.h>
#include <unistd.h>

extern char **environ;

enum { PATH = PATH_MAX + 64 };

/* Write the options -I for the headers of this program: where `make install` puts them, and in the source tree. */
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

static const char *find_compiler(void)
{
    const char *cc = getenv("CC");
    return cc && cc[strspn(cc, " ")] ? cc : "cc";
}

/* Split the value of $CC into words, as in "ccache gcc -m64". Return their number. */
static size_t split(char *cc, const char **words)
{
    size_t count = 0;
    char *rest;
    for (char *word = strtok_r(cc, " ", &rest); word;
         word = strtok_r(NULL, " ", &rest))
        words[count++] = word;
    return count;
}

/* Collect the signals that end the program. Signals that the program ignores are left out. */
static void find_ends(sigset_t *ends)
{
    const int deadly[] = { SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGXCPU };
    struct sigaction now;
    sigemptyset(ends);
    for (size_t i = 0; i < sizeof deadly / sizeof *deadly; i++)
        if (sigaction(deadly[i], NULL, &now) == 0 && now.sa_handler != SIG_IGN)
            sigaddset(ends, deadly[i]);
}

/* End the compiler and its child processes. They have a second to remove their own files. */
static void end_compiler(pid_t child)
{
    const struct timespec pause = { .tv_nsec = 50000000 };
    int ended;
    kill(-child, SIGTERM);
    for (int i = 0; i < 20 && waitpid(child, &ended, WNOHANG) == 0; i++)
        nanosleep(&pause, NULL);
    kill(-child, SIGKILL);
    waitpid(child, &ended, 0);
}

/* Wait for the compiler, which may hang. If a signal comes that ends the program, end the compiler, and raise the
 * signal again, so that it ends the program when signals are unblocked. Return 0 if the compiler ended without an
 * error. */
static int wait_for(pid_t child)
{
    const struct timespec pause = { .tv_nsec = 200000000 };
    sigset_t awaited, ends;
    int ended = 1;
    pid_t found;
    find_ends(&ends);
    awaited = ends;
    sigaddset(&awaited, SIGCHLD);
    while ((found = waitpid(child, &ended, WNOHANG)) == 0) {
        const int number = sigtimedwait(&awaited, NULL, &pause);
        if (number <= 0 || !sigismember(&ends, number))
            continue;
        end_compiler(child);
        raise(number);
        return 1;
    }
    return found != child || ended != 0;
}

/* Start the compiler with these blocked signals, in a process group of its own. Its messages go to the file `log`, and
 * its standard input is empty. Return 0 if it runs. */
static int start(const char **words, const char *log, const sigset_t *blocked,
                 pid_t *child)
{
    posix_spawn_file_actions_t files;
    posix_spawnattr_t signals;
    if (posix_spawn_file_actions_init(&files))
        return 1;
    posix_spawnattr_init(&signals);
    posix_spawnattr_setsigmask(&signals, blocked);
    posix_spawnattr_setpgroup(&signals, 0);
    posix_spawnattr_setflags(&signals,
                             POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETPGROUP);
    posix_spawn_file_actions_addopen(&files, 0, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&files, 1, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_addopen(&files, 2, log,
                                     O_WRONLY | O_CREAT | O_TRUNC, 0600);
    const int failed = posix_spawnp(child, words[0], &files, &signals,
                                    (char *const *)words, environ);
    posix_spawnattr_destroy(&signals);
    posix_spawn_file_actions_destroy(&files);
    return failed;
}

/* Run the compiler. Return 0, or 1. */
static int run_compiler(const char *file, const char *object, const char *log,
                        const sigset_t *blocked)
{
    char flag[2][PATH], cc[PATH];
    pid_t child;
    if (strlen(find_compiler()) >= sizeof cc)
        return 1;
    includes(flag);
    const char *const options[] = { "-O2",     "-fPIC", "-ffp-contract=off",
                                    "-shared", flag[0], flag[1],
                                    "-o",      object,  file,
                                    "-lm",     NULL };
    const char *words[PATH / 2 + sizeof options / sizeof *options];
    memcpy(words + split(strcpy(cc, find_compiler()), words), options,
           sizeof options);
    return start(words, log, blocked, &child) || wait_for(child);
}

/* Copy the first line of the log that contains "error". */
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
        snprintf(line, size, "the compiler %s does not run", find_compiler());
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
        &all); /* a signal that would end the program waits until the folder is removed */
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
    remove(object); /* the loaded object stays in memory */
    remove(log);
    rmdir(place);
    sigprocmask(SIG_SETMASK, &before, NULL);
    return *library == NULL;
}
