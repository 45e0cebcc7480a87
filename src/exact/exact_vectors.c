/* src/exact/exact_vectors.c -- Complex exponentials, many at once.     [Chapter 11] */
#include "exact_vectors.h"

#include "memory/memory_kinds.h" /* FVI_VECTORS */

#include <stdint.h>
#include <string.h>

/* Adding it rounds a double below 2^51 in size to an integer, which then stands in the last
 * bits of the sum. */
static const double ROUND = 0x1.8p52;

/* ln 2 and pi in pieces: the products with an integer below 2^20 are exact but for the
 * last. */
static const double LN2[] = { 0x1.62e42feep-1, 0x1.a39ef35793c76p-33 },
                    PI[] = { 0x1.921fb544p+1, 0x1.0b4611a6p-33,
                             0x1.3198a2e037073p-68 };

/* 1 / n!; what a series leaves out is below u / 5 where |r| <= ln 2 / 2, |r| <= pi / 2. */
static const double FACTORIAL[] = { 1.,
                                    1.,
                                    1. / 2,
                                    1. / 6,
                                    1. / 24,
                                    1. / 120,
                                    1. / 720,
                                    1. / 5040,
                                    1. / 40320,
                                    1. / 362880,
                                    1. / 3628800,
                                    1. / 39916800,
                                    1. / 479001600,
                                    1. / 6227020800,
                                    1. / 87178291200,
                                    1. / 1307674368000,
                                    1. / 20922789888000,
                                    1. / 355687428096000,
                                    1. / 6402373705728000,
                                    1. / 121645100408832000,
                                    1. / 2432902008176640000,
                                    1. / 51090942171709440000. };

static inline uint64_t bits_of(double x)
{
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

static inline double of_bits(uint64_t bits)
{
    double x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

/* sum of sign^k y^k / (first + 2 k)! for first + 2 k <= last */
static inline double series(double y, int first, int step, int last)
{
    double sum = FACTORIAL[last];
#pragma GCC unroll 16
    for (int n = last - step; n >= first; n -= step)
        sum = sum * y + FACTORIAL[n];
    return sum;
}

//> exp
FVI_VECTORS static void exponentials(size_t n, double *restrict re,
                                     double *restrict im)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        const double twos = re[i] * (1 / 0x1.62e42fefa39efp-1) + ROUND,
                     k = twos - ROUND, x = re[i] - k * LN2[0] - k * LN2[1];
        const double halves = im[i] * (1 / 0x1.921fb54442d18p+1) + ROUND,
                     l = halves - ROUND,
                     y = im[i] - l * PI[0] - l * PI[1] - l * PI[2];
        const double size =
            of_bits(bits_of(series(x, 0, 1, 13)) + (bits_of(twos) << 52));
        const uint64_t turn = bits_of(halves) << 63; /* odd: the other sign */
        re[i] = size * of_bits(bits_of(series(-y * y, 0, 2, 20)) ^ turn);
        im[i] = size * of_bits(bits_of(y * series(-y * y, 1, 2, 21)) ^ turn);
    }
}
//< exp

void fvi_vector_exp(size_t n, double *re, double *im)
{
    exponentials(n, re, im);
}
