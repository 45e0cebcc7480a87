/* tests/harness/failing_malloc.c -- A library to be preloaded, in which one allocation
 * fails: the one whose number MALLOC_FAILS says, from 1 on, of each process. Where
 * MALLOC_FAILED names a file, that is then made, empty, so that whoever counts knows
 * that there were so many. Allocations that the C library makes for itself count too. */
#define _GNU_SOURCE
#include <errno.h>
#include <fcntl.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <unistd.h>

/* glibc's own, beneath those that it lets others replace. */
void *__libc_malloc(size_t bytes);
void *__libc_calloc(size_t count, size_t bytes);
void *__libc_realloc(void *old, size_t bytes);
void *__libc_memalign(size_t alignment, size_t bytes);

static atomic_ulong done, wanted;

/* From here on allocations are counted. The loader calls this function after those of all
 * other libraries, so what libgfortran and libgomp, on which CHOLMOD stands, allocate before
 * main is not counted: they end the process if they get nothing. */
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
