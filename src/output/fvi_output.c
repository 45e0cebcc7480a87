/* src/output/fvi_output.c -- A file that is complete or not there at all. */
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
static int shared;               /* does the target have other names, too? */
static int nameless;             /* is the file without a name so far? */

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

/* A file without a name in the folder of the target: nothing is left of it, however the
 * program ends. -1 where the system has no such thing, or could not name it later. */
static int open_nameless(mode_t mode)
{
#ifdef O_TMPFILE
    char folder[PATH_MAX];
    const char *slash = strrchr(target, '/');
    snprintf(folder, sizeof folder, "%.*s",
             slash ? (int)(slash - target) + 1 : 1, slash ? target : ".");
    if (access("/proc/self/fd", X_OK) == 0)
        return open(folder, O_TMPFILE | O_RDWR | O_CLOEXEC, mode);
#endif
    (void)mode;
    return -1;
}

/* The name of a file beside the target, all but its last letters. */
static int name_temporary(void)
{
    const char *slash = strrchr(target, '/');
    int length = snprintf(temporary, sizeof temporary, "%.*s.fvi-XXXXXX",
                          slash ? (int)(slash - target) + 1 : 0, target);
    if (length < (int)sizeof temporary)
        return 0;
    temporary[0] = '\0';
    errno = ENAMETOOLONG;
    return -1;
}

/* A file for the table, with these permissions. */
static FILE *open_temporary(mode_t mode)
{
    watch_signals();
    int file = open_nameless(mode);
    nameless = file >= 0;
    if (!nameless && name_temporary() == 0 && (file = mkstemp(temporary)) < 0)
        temporary[0] = '\0';
    if (file < 0)
        return NULL;
    fchmod(file, mode);
    return fdopen(file, "w");
}

/* A name beside the target for the file that has none, so that it can be renamed. */
static int give_name(int file)
{
    char open_file[64];
    snprintf(open_file, sizeof open_file, "/proc/self/fd/%d", file);
    if (!nameless)
        return 0;
    nameless = 0;
    for (unsigned i = 0; name_temporary() == 0; i++) {
        snprintf(strrchr(temporary, '-') + 1, 7, "%06x",
                 ((unsigned)getpid() + 0x9e3779u * i) & 0xffffff);
        if (linkat(AT_FDCWD, open_file, AT_FDCWD, temporary, AT_SYMLINK_FOLLOW)
            == 0)
            return 0;
        if (errno != EEXIST || i == 1000)
            break;
    }
    temporary[0] = '\0';
    return -1;
}

/* The number of the open file that a name such as /dev/stdout stands for, by the
 * links that lead to it; -1 if it is a name like others. */
static int descriptor(const char *name)
{
    char at[PATH_MAX], folder[PATH_MAX], link[PATH_MAX], ours[64];
    snprintf(ours, sizeof ours, "/proc/%ld/fd", (long)getpid());
    if (strlen(name) >= sizeof at)
        return -1;
    strcpy(at, name);
    for (int links = 0; links < 40; links++) {
        char *slash = strrchr(at, '/'), *last = slash ? slash + 1 : at;
        const char in = *last;
        *last = '\0'; /* for a moment: the folder alone */
        const int known = realpath(*at ? at : ".", folder) != NULL;
        *last = in;
        if (known && strcmp(folder, ours) == 0 && in >= '0' && in <= '9')
            return atoi(last);
        const ssize_t length = readlink(at, link, sizeof link - 1);
        if (!known || length < 0)
            return -1;
        link[length] = '\0';
        if (link[0] == '/')
            last = at;
        if ((size_t)(last - at) + (size_t)length >= sizeof at)
            return -1;
        strcpy(last, link);
    }
    return -1;
}

FILE *fvi_output_open(const char *name)
{
    struct stat old = { 0 };
    temporary[0] = '\0';
    nameless = 0;
    if (!name)
        return stdout;
    int file = descriptor(name); /* >> has chosen where it goes on */
    if (file >= 0)
        return (file = dup(file)) < 0 ? NULL : fdopen(file, "w");
    if (stat(name, &old) == 0) {
        if (!S_ISREG(old.st_mode))
            return fopen(name, "w");
        shared = old.st_nlink > 1;
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
    shared = 0;
    mode_t mask = umask(0);
    umask(mask);
    return open_temporary(0666 & ~mask);
}

/* Make room for `size` bytes in a file of `old` bytes, or leave it as it is. */
static int reserve(int file, off_t old, off_t size)
{
    const int why = size > old ? posix_fallocate(file, old, size - old) : 0;
    if (why == 0 || why == EOPNOTSUPP || why == EINVAL) /* no such service */
        return 0;
    if (ftruncate(file, old) != 0)
        return -1;
    errno = why;
    return -1;
}

static int copy(int from, int to, off_t size)
{
    char block[1 << 14];
    ssize_t count;
    while ((count = read(from, block, sizeof block)) > 0)
        if (write(to, block, (size_t)count) != count)
            return -1;
    return count < 0 ? -1 : ftruncate(to, size);
}

/* The complete table into the file that is there, under all its names. A full disk
 * or a signal comes before the old contents are touched, or not at all. */
static int overwrite(void)
{
    struct stat new, old;
    sigset_t all, before;
    sigfillset(&all);
    sigprocmask(SIG_BLOCK, &all, &before);
    const int from = open(temporary, O_RDONLY), to = open(target, O_RDWR);
    int failed = from < 0 || to < 0 || fstat(from, &new) || fstat(to, &old)
                 || reserve(to, old.st_size, new.st_size)
                 || copy(from, to, new.st_size);
    const int why = errno;
    if (from >= 0)
        close(from);
    if (to >= 0 && close(to) != 0 && !failed)
        failed = 1;
    else
        errno = why;
    if (!failed)
        unlink(temporary);
    sigprocmask(SIG_SETMASK, &before, NULL);
    return failed ? -1 : 0;
}

static int put_in_place(void)
{
    return shared ? overwrite() : rename(temporary, target);
}

int fvi_output_close(FILE *stream, int keep)
{
    int failed =
        fflush(stream) != 0 || ferror(stream)
        || (keep && stream != stdout && give_name(fileno(stream)) != 0);
    int why = errno;
    if (stream != stdout && fclose(stream) != 0 && !failed) {
        failed = 1;
        why = errno;
    }
    if (temporary[0] && keep && !failed && put_in_place() != 0) {
        failed = 1;
        why = errno;
    }
    if (temporary[0] && (failed || !keep))
        unlink(temporary);
    temporary[0] = '\0';
    nameless = 0;
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
    fprintf(stderr, "\rstep %zu of %zu (%.0f %%), %.0f s, %.0f s left\033[K", k,
            steps, 100 * (double)k / (double)steps, now - began,
            (now - began) * (double)(steps - k) / (double)k);
}

void fvi_progress_clear(void)
{
    if (shown)
        fprintf(stderr, "\r\033[K");
    shown = 0;
}
