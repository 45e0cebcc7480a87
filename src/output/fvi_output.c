/* src/output/fvi_output.c -- Write files that are complete or do not appear at all. */
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

/* A file that is being written. stream is NULL if the place is free. */
typedef struct {
    FILE *stream;
    char target[PATH_MAX];    /* final name of the file */
    char temporary[PATH_MAX]; /* present name of the file; "" if it has none */
    int shared;               /* nonzero if the target has other names (hard links), too */
    int nameless;             /* nonzero while the file has no name */
} output;

enum { MOST_OPEN_FILES = 4 }; /* a table, a checkpoint, a picture, and one to spare */
static output outputs[MOST_OPEN_FILES];

static output *place_of(const FILE *stream)
{
    for (int i = 0; i < MOST_OPEN_FILES; i++)
        if (outputs[i].stream == stream)
            return &outputs[i];
    return NULL;
}

static void remove_and_die(int signal_number)
{
    for (int i = 0; i < MOST_OPEN_FILES; i++)
        if (outputs[i].temporary[0])
            unlink(outputs[i].temporary);
    signal(signal_number, SIG_DFL);
    raise(signal_number);
}

/* Remove the temporary files before a signal ends the program. A signal that is ignored, as after nohup, stays ignored.
 * A signal for which another part of the program has a handler keeps that handler. */
static void watch_signals(void)
{
    const int deadly[] = { SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGQUIT, SIGXCPU };
    struct sigaction now;
    for (size_t i = 0; i < sizeof deadly / sizeof *deadly; i++)
        if (sigaction(deadly[i], NULL, &now) == 0 && now.sa_handler == SIG_DFL)
            signal(deadly[i], remove_and_die);
    signal(SIGXFSZ, SIG_IGN); /* a write beyond the largest file size then fails with EFBIG */
}

static void block_signals(sigset_t *before)
{
    sigset_t all;
    sigfillset(&all);
    sigprocmask(SIG_BLOCK, &all, before);
}

static void folder_of(const output *f, char folder[PATH_MAX])
{
    const char *slash = strrchr(f->target, '/');
    snprintf(folder, PATH_MAX, "%.*s", slash ? (int)(slash - f->target) + 1 : 1,
             slash ? f->target : ".");
}

/* Open a file without a name in the folder of the target. Nothing is left of it, however the program ends. Return -1 if
 * the system has no such files, or no way to give them a name later. */
static int open_nameless(const output *f, mode_t mode)
{
#ifdef O_TMPFILE
    char folder[PATH_MAX];
    folder_of(f, folder);
    if (access("/proc/self/fd", X_OK) == 0)
        return open(folder, O_TMPFILE | O_RDWR | O_CLOEXEC, mode);
#endif
    (void)f;
    (void)mode;
    return -1;
}

/* Write the name of a file beside the target, with XXXXXX for its last letters. Return 0, or -1 with errno set. */
static int name_temporary(output *f)
{
    const char *slash = strrchr(f->target, '/');
    int length = snprintf(f->temporary, sizeof f->temporary, "%.*s.fvi-XXXXXX",
                          slash ? (int)(slash - f->target) + 1 : 0, f->target);
    if (length < (int)sizeof f->temporary)
        return 0;
    f->temporary[0] = '\0';
    errno = ENAMETOOLONG;
    return -1;
}

/* Open a file for the output, with these permissions. Signals are blocked between the choice of the temporary name and
 * the creation of the file, because until then a file of that name may belong to somebody else. */
static FILE *open_temporary(output *f, mode_t mode)
{
    sigset_t before;
    watch_signals();
    int file = open_nameless(f, mode);
    f->nameless = file >= 0;
    block_signals(&before);
    if (!f->nameless && name_temporary(f) == 0
        && (file = mkstemp(f->temporary)) < 0)
        f->temporary[0] = '\0';
    sigprocmask(SIG_SETMASK, &before, NULL);
    if (file < 0)
        return NULL;
    fchmod(file, mode);
    return f->stream = fdopen(file, "w");
}

/* Give the file without a name a name beside the target, so that it can be renamed. Return 0, or -1 with errno set. */
static int link_temporary_name(output *f)
{
    char open_file[64];
    snprintf(open_file, sizeof open_file, "/proc/self/fd/%d",
             fileno(f->stream));
    if (!f->nameless)
        return 0;
    f->nameless = 0;
    for (unsigned i = 0; name_temporary(f) == 0; i++) {
        snprintf(strrchr(f->temporary, '-') + 1, 7, "%06x",
                 ((unsigned)getpid() + 0x9e3779u * i) & 0xffffff);
        if (linkat(AT_FDCWD, open_file, AT_FDCWD, f->temporary,
                   AT_SYMLINK_FOLLOW)
            == 0)
            return 0;
        if (errno != EEXIST || i == 1000)
            break;
    }
    f->temporary[0] = '\0';
    return -1;
}

/* Return the descriptor of the open file for which a name such as /dev/stdout stands. To find it, follow the links one
 * by one. Return -1 for an ordinary name. */
static int descriptor_of(const char *name)
{
    char at[PATH_MAX], folder[PATH_MAX], link[PATH_MAX], ours[64];
    snprintf(ours, sizeof ours, "/proc/%ld/fd", (long)getpid());
    if (strlen(name) >= sizeof at)
        return -1;
    strcpy(at, name);
    for (int links = 0; links < 40; links++) {
        char *slash = strrchr(at, '/'), *last = slash ? slash + 1 : at;
        const char in = *last;
        *last = '\0'; /* cut the path for a moment, to look up the folder alone */
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

/* Open a temporary file that will replace the ordinary file of this name. `old` is the state of that file, or NULL if
 * it does not exist. */
static FILE *open_beside(const char *name, const struct stat *old)
{
    output *f = place_of(NULL);
    errno = !f ? EMFILE : strlen(name) >= sizeof f->target ? ENAMETOOLONG : 0;
    if (errno)
        return NULL;
    f->temporary[0] = '\0';
    f->shared = old && old->st_nlink > 1;
    if (!old) {
        const mode_t mask = umask(0);
        umask(mask);
        strcpy(f->target, name);
        return open_temporary(f, 0666 & ~mask);
    }
    if (access(name, W_OK) != 0 || !realpath(name, f->target))
        return NULL; /* if the name is a link, the file behind it is replaced */
    FILE *stream = open_temporary(f, old->st_mode & 0777);
    if (stream && fchown(fileno(stream), old->st_uid, old->st_gid) != 0)
        errno = 0; /* only root may change the owner, so an error is ignored */
    return stream;
}

static FILE *open_ordinary(const char *name)
{
    struct stat old;
    if (stat(name, &old) == 0)
        return open_beside(name, &old);
    if (errno != ENOENT || lstat(name, &old) == 0)
        return NULL;
    return open_beside(name, NULL);
}

FILE *fvi_output_open(const char *name)
{
    struct stat old;
    if (!name || strcmp(name, "-") == 0)
        return stdout;
    int file = descriptor_of(name); /* a duplicate goes on where the shell's >> has put the end */
    if (file >= 0)
        return (file = dup(file)) < 0 ? NULL : fdopen(file, "w");
    return stat(name, &old) == 0 && !S_ISREG(old.st_mode) ? fopen(name, "w")
                                                          : open_ordinary(name);
}

FILE *fvi_output_open_file(const char *name)
{
    struct stat old;
    if (descriptor_of(name) < 0 && (stat(name, &old) != 0 || S_ISREG(old.st_mode)))
        return open_ordinary(name);
    errno = EEXIST; /* for example a device, which must not be replaced */
    return NULL;
}

int fvi_output_waits(FILE *stream)
{
    return place_of(stream) != NULL;
}

/* Reserve room for `size` bytes in a file that has `old` bytes. If that fails, restore the length of the file. Return
 * 0, or -1 with errno set. */
static int reserve(int file, off_t old, off_t size)
{
    const int why = size > old ? posix_fallocate(file, old, size - old) : 0;
    if (why == 0 || why == EOPNOTSUPP || why == EINVAL) /* the file system cannot reserve room */
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

/* Write the data of a file to the disk, so that a power cut does not lose it. Return 0 also if the file is of a kind
 * that cannot be synchronised. */
static int sync_file(int file)
{
    return fsync(file) != 0 && errno != EINVAL && errno != ENOTSUP ? -1 : 0;
}

/* Write the names of the folder to the disk, too. Return 0 if the folder cannot be read, because it cannot be
 * synchronised then. */
static int sync_folder(const output *f)
{
    char name[PATH_MAX];
    folder_of(f, name);
    const int folder = open(name, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (folder < 0)
        return 0;
    const int status = sync_file(folder), why = errno;
    close(folder);
    errno = why;
    return status;
}

/* Copy the complete file into the target, so that all names of the target stay valid. Room on the disk is reserved
 * first, so a full disk is found before the old contents are touched. If a power cut or SIGKILL comes during the copy,
 * the complete file is still there under its temporary name. Return 0, or -1 with errno set. */
static int overwrite_target(const output *f)
{
    struct stat new, old;
    const int from = open(f->temporary, O_RDONLY | O_NOFOLLOW),
              to = open(f->target, O_RDWR | O_NOFOLLOW);
    int failed = from < 0 || to < 0 || fstat(from, &new) || fstat(to, &old)
                 || sync_folder(f) || reserve(to, old.st_size, new.st_size)
                 || copy(from, to, new.st_size) || sync_file(to);
    const int why = errno;
    if (from >= 0)
        close(from);
    if (to >= 0 && close(to) != 0 && !failed)
        failed = 1;
    else
        errno = why;
    if (!failed)
        unlink(f->temporary);
    return failed ? -1 : 0;
}

/* Write the file to the disk first, and then give it its name, so that a power cut leaves no empty file under that
 * name. Return 0, or nonzero with errno set. */
static int rename_to_target(output *f)
{
    int failed = link_temporary_name(f) != 0 || sync_file(fileno(f->stream)) != 0;
    int why = errno;
    if (fclose(f->stream) != 0 && !failed) {
        failed = 1;
        why = errno;
    }
    errno = why;
    return failed ? -1
           : f->shared
               ? overwrite_target(f)
               : rename(f->temporary, f->target) != 0 || sync_folder(f) != 0;
}

int fvi_output_close(FILE *stream, int keep)
{
    output *f = place_of(stream); /* NULL: the stream is no file of ours and is written to directly */
    sigset_t before;
    if (f) /* a signal waits until the file is complete or removed */
        block_signals(&before);
    int failed = fflush(stream) != 0 || ferror(stream), why = errno;
    if (f && keep && !failed) {
        failed = rename_to_target(f) != 0;
        why = errno;
    } else if (stream != stdout && fclose(stream) != 0 && !failed) {
        failed = 1;
        why = errno;
    }
    if (f && (failed || !keep) && f->temporary[0])
        unlink(f->temporary);
    if (f) {
        f->temporary[0] = '\0';
        f->stream = NULL;
        sigprocmask(SIG_SETMASK, &before, NULL);
    }
    errno = why;
    return failed ? -1 : 0;
}

static int shown; /* nonzero if the terminal shows a line of progress */

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
