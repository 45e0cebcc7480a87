/* src/system/arrays.h -- Allocate several arrays of numbers in one block of memory. */
#ifndef FVI_ARRAYS_H
#define FVI_ARRAYS_H

#include <stdint.h>
#include <stdlib.h>

typedef struct {
    double **to; /* the pointer that will hold the address of the array */
    size_t count;
} fvi_array;

/* fvi_arrays_alloc -- Allocate all arrays of the list, one after another in one block, and set every number to zero.
 * Return the block, which is also the first array. The caller frees the block, never a single array. If memory is
 * short, return NULL and set no pointer.
 * FVI_ARRAYS -- Do the same for a list of arrays. For example, with double *x, *G:
 *
 *     double *block = FVI_ARRAYS({ &x, d }, { &G, d * d });
 *
 * The function checks that the sum of the counts does not overflow. The caller checks each count, such as d * d. */
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
