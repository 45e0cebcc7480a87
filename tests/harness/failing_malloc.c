/* tests/harness/failing_malloc.c -- A library to preload, which lets one allocation of each process fail.
 *
 * The environment variable MALLOC_FAILS is the number of this allocation, counted from 1. If MALLOC_FAILED names
 * a file, an empty file of this name is created when the allocation fails, so that the caller knows that the
 * process had so many allocations. Allocations that the C library makes for itself count, too. */
#define _GNU_SOURCE
#include <errno.h>
#include <fcntl.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <unistd.h>

/* glibc's own functions, below those that a program may replace. */
void *__libc_malloc(size_t bytes);
void *__libc_calloc(size_t count, size_t bytes);
void *__libc_realloc(void *old, size_t bytes);
void *__libc_memalign(size_t alignment, size_t bytes);

static atomic_ulong done, wanted;

/* Begin to count. The loader calls this function after the constructors of all other libraries. So allocations
 * that libgfortran and libgomp (CHOLMOD needs them) make before main are not counted; they would end the
 * process if one failed. */
__attribute__((constructor)) static void begin_to_count(void)
{
    const char *number = getenv("MALLOC_FAILS");
    wanted = number ? strtoul(number, NULL, 10) : 0;
}

static int fails(void)
{
    if (wanted == 0 || ++done != wanted)
        return 0;
    const char *name = getenv("MALLOC_FAILED");
    const int file = name ? open(name, O_CREAT | O_WRONLY, 0600) : -1;
    if (file >= 0)
        close(file);
    errno = ENOMEM;
    return 1;
}

void *malloc(size_t bytes)
{
    return fails() ? NULL : __libc_malloc(bytes);
}

void *calloc(size_t count, size_t bytes)
{
    return fails() ? NULL : __libc_calloc(count, bytes);
}

void *realloc(void *old, size_t bytes)
{
    return fails() ? NULL : __libc_realloc(old, bytes);
}

void *aligned_alloc(size_t alignment, size_t bytes)
{
    return fails() ? NULL : __libc_memalign(alignment, bytes);
}

int posix_memalign(void **place, size_t alignment, size_t bytes)
{
    void *block = fails() ? NULL : __libc_memalign(alignment, bytes);
    if (!block)
        return ENOMEM;
    *place = block;
    return 0;
}
