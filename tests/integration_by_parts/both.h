/* tests/integration_by_parts/both.h -- Both operators, and numbers to try them on. */
#ifndef BOTH_H
#define BOTH_H

#include <fvi/error.h>
#include <fvi/paper/integration_by_parts.h>
#include "harness/ulp.h"
#include "system/seeded.h"

/* Delta_- and Delta_+ of z; NULL for one that is not wanted. */
static inline void both(double alpha, double h, size_t N, size_t d,
                        const double *z, double *minus, double *plus)
{
    if (minus)
        ck_assert_int_eq(fvi_delta_minus(alpha, h, N, d, z, minus),
                         FVI_SUCCESS);
    if (plus)
        ck_assert_int_eq(fvi_delta_plus(alpha, h, N, d, z, plus), FVI_SUCCESS);
}

/* Numbers in (-1, 1) that look random and are the same on every machine. */
static inline double next_number(void)
{
    static uint64_t state = 88172645463325252u;
    return (double)(int64_t)fvi_seeded_next(&state) * 0x1p-63;
}

#endif
