/* chapters/play/malloc.c -- An allocator of forty lines.
 *
 * The linker takes it instead of wasi-libc's, which would add 4.8 kB to the page. All
 * else of the C library is wasi-libc's, and compiler-rt's, own. */
#include <stdlib.h>
#include <string.h>

/* Whatever a call of the page takes, it gives back. */
static _Alignas(64) char heap[1 << 18];
static size_t top, blocks;

void *malloc(size_t size)
{
    if (size > sizeof heap - top)
        return NULL;
    char *block = heap + top;
    top += (size + 15) & ~(size_t)15;
    blocks++;
    return block;
}

void *calloc(size_t count, size_t size)
{
    void *block = count <= sizeof heap ? malloc(count * size) : NULL;
    return block ? memset(block, 0, count * size) : NULL;
}

/* Up to 64. */
void *aligned_alloc(size_t alignment, size_t size)
{
    const size_t before = top;
    top = (top + alignment - 1) & ~(alignment - 1);
    void *block = top <= sizeof heap ? malloc(size) : NULL;
    if (!block)
        top = before;
    return block;
}

/* The old block stays where it is, until all are free. */
void *realloc(void *block, size_t size)
{
    char *next = malloc(size);
    if (block && next) {
        const size_t most = (size_t)(next - (char *)block);
        memcpy(next, block, size < most ? size : most);
        blocks--;
    }
    return next;
}

/* When the last block has come back, the heap is empty again. */
void free(void *block)
{
    if (block && --blocks == 0)
        top = 0;
}
