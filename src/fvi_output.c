/* src/fvi_output.c -- A file that is complete or not there at all. */
#define _GNU_SOURCE
#include "fvi_output.h"

#include <errno.h>
#include <limits.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

static char target[PATH_MAX];    /* the name that the file is to have */
static char temporary[PATH_MAX]; /* the name that it has; "" if there is none */

static void remove_and_die(int signal_number)
{
    if (temporary[0])
        unlink(temporary);
    signal(signal_number, SIG_DFL);
    raise(signal_number);
}

/* A signal that is ignored, as by nohup, stays ignored. */
static void watch_signals(void)
{
    const int deadly[] = { SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGQUIT, SIGXCPU };
    for (size_t i = 0; i < sizeof deadly / sizeof *deadly; i++)
        if (signal(deadly[i], remove_and_die) == SIG_IGN)
            signal(deadly[i], SIG_IGN);
    signal(SIGXFSZ, SIG_IGN); /* a file too large is a failed write */
}

/* A file of a new name in the folder of the target, with these permissions. */
static FILE *open_temporary(mode_t mode)
{
    const char *slash = strrchr(target, '/');
    int length = snprintf(temporary, sizeof temporary, "%.*s.fvi-XXXXXX",
                          slash ? (int)(slash - target) + 1 : 0, target);
    int file = -1;
    if (length < (int)sizeof temporary)
        file = mkstemp(temporary);
    else
        errno = ENAMETOOLONG;
    if (file < 0) {
        temporary[0] = '\0';
        return NULL;
    }
    watch_signals();
    fchmod(file, mode);
    return fdopen(file, "w");
}

FILE *fvi_output_open(const char *name)
{
    struct stat old = { 0 };
    temporary[0] = '\0';
    if (!name)
        return stdout;
    if (stat(name, &old) == 0) {
        if (!S_ISREG(old.st_mode))
            return fopen(name, "w");
        if (access(name, W_OK) != 0 || !realpath(name, target))
            return NULL; /* a link stays a link */
        FILE *stream = open_temporary(old.st_mode & 0777);
        if (stream && fchown(fileno(stream), old.st_uid, old.st_gid) != 0)
            errno = 0; /* only root may give files away */
        return stream;
    }
    if (errno != ENOENT || lstat(name, &old) == 0)
        return NULL;
    if (strlen(name) >= sizeof target) {
        errno = ENAMETOOLONG;
        return NULL;
    }
    strcpy(target, name);
    mode_t mask = umask(0);
    umask(mask);
    return open_temporary(0666 & ~mask);
}

int fvi_output_close(FILE *stream, int keep)
{
    int failed = fflush(stream) != 0 || ferror(stream);
    int why = errno;
    if (stream != stdout && fclose(stream) != 0 && !failed) {
        failed = 1;
        why = errno;
    }
    if (temporary[0] && keep && !failed && rename(temporary, target) != 0) {
        failed = 1;
        why = errno;
    }
    if (temporary[0] && (failed || !keep))
        unlink(temporary);
    temporary[0] = '\0';
    errno = why;
    return failed ? -1 : 0;
}

static int shown; /* is there a line on the terminal? */

void fvi_progress(size_t k, size_t steps)
{
    static int terminal = -1;
    static double began = -1, last = 0;
    struct timespec clock;
    if (terminal < 0)
        terminal = isatty(STDERR_FILENO);
    if (!terminal)
        return;
    clock_gettime(CLOCK_MONOTONIC, &clock);
    double now = (double)clock.tv_sec + 1e-9 * (double)clock.tv_nsec;
    if (began < 0)
        began = now;
    if (now - began < 1 || now - last < 0.2)
        return;
    last = now;
    shown = 1;
    fprintf(stderr, "\rstep %zu of %zu (%.0f %%), %.0f s\033[K", k, steps,
            100 * (double)k / (double)steps, now - began);
}

void fvi_progress_clear(void)
{
    if (shown)
        fprintf(stderr, "\r\033[K");
    shown = 0;
}
