/* tests/run/failing_allocator.h -- malloc and its kin on top of glibc's: they count, and one of them fails.
 *
 * For one file of a test, whose program then allocates by them, GSL, CHOLMOD and UMFPACK included. Where a
 * sanitizer brings its own allocator nothing is defined but OTHER_ALLOCATOR: the test returns at once. */
#ifndef FAILING_ALLOCATOR_H
#define FAILING_ALLOCATOR_H

#include <malloc.h>
#include <stdlib.h>

#if defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define OTHER_ALLOCATOR
#endif
#endif
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)              \
    || !defined(__GLIBC__)
#define OTHER_ALLOCATOR
#endif

static size_t made, failing; /* allocations since the last call; which one fails, 0: none */
static int has_failed;
static long alive; /* blocks that were allocated and not yet freed */
static size_t used, budget; /* their bytes, and how many there may be; 0: any number */

#ifndef OTHER_ALLOCATOR
void *__libc_malloc(size_t bytes);
void *__libc_calloc(size_t count, size_t bytes);
void *__libc_realloc(void *old, size_t bytes);
void *__libc_memalign(size_t alignment, size_t bytes);
void __libc_free(void *block);

static int fails(size_t bytes)
{
    made++;
    if (made != failing && (budget == 0 || used + bytes <= budget))
        return 0;
    has_failed = 1;
    return 1;
}

static void *counted(void *block)
{
    alive += block != NULL;
    used += malloc_usable_size(block);
    return block;
}

static void forget(void *block)
{
    alive -= block != NULL;
    used -= malloc_usable_size(block);
}

/* Seen from without, so that GSL and CHOLMOD allocate by them, too. */
#pragma GCC visibility push(default)
void *malloc(size_t bytes)
{
    return fails(bytes) ? NULL : counted(__libc_malloc(bytes));
}

void *calloc(size_t count, size_t bytes)
{
    return fails(count * bytes) ? NULL : counted(__libc_calloc(count, bytes));
}

void *realloc(void *old, size_t bytes)
{
    if (fails(bytes))
        return NULL;
    forget(old);
    return counted(__libc_realloc(old, bytes));
}

void *aligned_alloc(size_t alignment, size_t bytes)
{
    return fails(bytes) ? NULL : counted(__libc_memalign(alignment, bytes));
}

void free(void *block)
{
    forget(block);
    __libc_free(block);
}
#pragma GCC visibility pop
#endif

#endif
