/* src/system/arrays.h -- Arrays of numbers that stand in one block. */
#ifndef FVI_ARRAYS_H
#define FVI_ARRAYS_H

#include <stdint.h>
#include <stdlib.h>

typedef struct {
    double **to; /* the pointer that gets the address of the array */
    size_t count;
} fvi_array;

/* fvi_arrays_alloc -- zeros for all these arrays, one after another in a block. Returns the block, where the first array
 * begins: free the block, and no array alone. NULL if there is no memory, and then no pointer is set.
 * FVI_ARRAYS -- the same of a list. For example, with double *x, *G:
 *
 *     double *block = FVI_ARRAYS({ &x, d }, { &G, d * d });
 *
 * The caller answers for each count, such as d * d; that their sum does not overflow is checked here. */
static inline double *fvi_arrays_alloc(size_t arrays, const fvi_array *array)
{
    size_t all = 1;
    for (size_t i = 0; i < arrays; i++) {
        if (array[i].count > SIZE_MAX - all)
            return NULL;
        all += array[i].count;
    }
    double *const block = calloc(all, sizeof *block), *next = block;
    for (size_t i = 0; block && i < arrays; next += array[i++].count)
        *array[i].to = next;
    return block;
}

#define FVI_ARRAYS(...)                                                                                             \
    fvi_arrays_alloc(sizeof((const fvi_array[]){ __VA_ARGS__ }) / sizeof(fvi_array), (const fvi_array[]){ __VA_ARGS__ })

#endif
