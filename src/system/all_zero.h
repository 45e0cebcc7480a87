/* src/system/all_zero.h -- Test whether an array contains only zeros. */
#ifndef FVI_ALL_ZERO_H
#define FVI_ALL_ZERO_H

#include <stddef.h>

/* fvi_all_zero -- Return 1 if all n numbers of v are zero, and 0 if not. An empty array (n = 0) gives 1. */
static inline int fvi_all_zero(size_t n, const double *v)
{
    for (size_t i = 0; i < n; i++)
        if (v[i] != 0)
            return 0;
    return 1;
}

#endif
