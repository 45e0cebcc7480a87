/* src/system/all_zero.h -- Is there anything to do? */
#ifndef FVI_ALL_ZERO_H
#define FVI_ALL_ZERO_H

#include <stddef.h>

/* fvi_all_zero -- are all n numbers of v zero? */
static inline int fvi_all_zero(size_t n, const double *v)
{
    for (size_t i = 0; i < n; i++)
        if (v[i] != 0)
            return 0;
    return 1;
}

#endif
