/* src/system/arrays.h -- Arrays of numbers that stand in one block. */
#ifndef FVI_ARRAYS_H
#define FVI_ARRAYS_H

#include <stdlib.h>

typedef struct {
    double **to; /* where its address goes */
    size_t count;
} fvi_array;

/* fvi_arrays_alloc -- zeros for all these arrays, one after another. They are freed with the block that is returned, which
 * is the first of them; NULL without memory, and then no address is written.
 * FVI_ARRAYS -- the same of a list: block = FVI_ARRAYS({ &x, d }, { &G, d * d }). */
static inline double *fvi_arrays_alloc(size_t arrays, const fvi_array *array)
{
    size_t all = 1;
    for (size_t i = 0; i < arrays; i++)
        all += array[i].count;
    double *const block = calloc(all, sizeof *block), *next = block;
    for (size_t i = 0; block && i < arrays; next += array[i++].count)
        *array[i].to = next;
    return block;
}

#define FVI_ARRAYS(...)                                                                                             \
    fvi_arrays_alloc(sizeof((const fvi_array[]){ __VA_ARGS__ }) / sizeof(fvi_array), (const fvi_array[]){ __VA_ARGS__ })

#endif
