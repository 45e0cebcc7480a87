/* src/fvi_output.c -- A file that is complete or not there at all. */
#define _GNU_SOURCE
#include "fvi_output.h"

#include <errno.h>
#include <fcntl.h>
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

static void watch_signals(void)
{
    const int deadly[] = { SIGINT, SIGTERM, SIGHUP, SIGPIPE };
    for (size_t i = 0; i < sizeof deadly / sizeof *deadly; i++)
        signal(deadly[i], remove_and_die);
    signal(SIGXFSZ, SIG_IGN); /* a file too large is a failed write */
}

FILE *fvi_output_open(const char *name)
{
    struct stat old = { 0 };
    temporary[0] = '\0';
    if (!name)
        return stdout;
    int exists = stat(name, &old) == 0;
    if (exists && !S_ISREG(old.st_mode))
        return fopen(name, "w");
    if (exists && access(name, W_OK) != 0)
        return NULL;
    if (exists && !realpath(name, target)) /* a link stays a link */
        return NULL;
    if (!exists && strlen(name) >= sizeof target) {
        errno = ENAMETOOLONG;
        return NULL;
    }
    if (!exists)
        strcpy(target, name);
    int length = snprintf(temporary, sizeof temporary, "%s.%ld~", target,
                          (long)getpid());
    if (length < 0 || (size_t)length >= sizeof temporary) {
        temporary[0] = '\0';
        errno = ENAMETOOLONG;
        return NULL;
    }
    int file = open(temporary, O_WRONLY | O_CREAT | O_EXCL,
                    exists ? old.st_mode & 0777 : 0666);
    if (file < 0) {
        temporary[0] = '\0';
        return NULL;
    }
    watch_signals();
    return fdopen(file, "w");
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

void fvi_progress(size_t k, size_t steps)
{
    static double began = -1, shown = 0;
    struct timespec clock;
    if (!isatty(STDERR_FILENO))
        return;
    clock_gettime(CLOCK_MONOTONIC, &clock);
    double now = (double)clock.tv_sec + 1e-9 * (double)clock.tv_nsec;
    if (began < 0)
        began = now;
    if (k == steps && shown > 0) {
        fprintf(stderr, "\r\033[K");
    } else if (k < steps && now - began >= 1 && now - shown >= 0.2) {
        shown = now;
        fprintf(stderr, "\rstep %zu of %zu (%.0f %%), %.0f s\033[K", k, steps,
                100 * (double)k / (double)steps, now - began);
    }
}
