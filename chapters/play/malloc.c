/* chapters/play/malloc.c -- An allocator of thirty lines.
 *
 * The linker takes it instead of wasi-libc's, which would add 4.8 kB to the page. All
 * else of the C library is wasi-libc's, and compiler-rt's, own. */
#include <stdlib.h>
#include <string.h>

/* Whatever a call of the page takes, it gives back. */
static _Alignas(16) char heap[1 << 18];
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
