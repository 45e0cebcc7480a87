/* src/reference/exact_vectors.c -- Compute complex functions of many numbers at once.        [H 11] */
#include "exact_vectors.h"

#include "memory/history_kinds.h" /* for FVI_VECTORS */

#include <gsl/gsl_math.h>
#include <stdint.h>
#include <string.h>

/* Adding ROUND rounds a double below 2^51 in size to an integer, which then stands in the last bits of the sum. */
static const double ROUND = 0x1.8p52;

/* ln 2 and pi in two parts. Products of the first part with an integer below 2^20 are exact. */
static const double LN2[] = { 0x1.62e42feep-1, 0x1.a39ef35793c76p-33 },
                    PI[] = { 0x1.921fb544p+1, 0x1.0b4611a626331p-33 };

/* 1 / n!. A series with them has an error below u / 5 for |r| <= ln 2 / 2 and |r| <= pi / 2. */
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

/* 1 / (2 n + 1). */
static const double ODD[] = { 1.,      1. / 3,  1. / 5,  1. / 7,  1. / 9,
                              1. / 11, 1. / 13, 1. / 15, 1. / 17, 1. / 19,
                              1. / 21, 1. / 23, 1. / 25, 1. / 27, 1. / 29,
                              1. / 31, 1. / 33, 1. / 35, 1. / 37, 1. / 39,
                              1. / 41 };

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

/* Return a if d is negative, else b, without a branch. */
static inline __attribute__((always_inline)) double select_by_sign(double d, double a,
                                                                   double b)
{
    const uint64_t yes = 0 - (bits_of(d) >> 63);
    return of_bits((bits_of(a) & yes) | (bits_of(b) & ~yes));
}

/* Return the sum of y^k c[first + step k] up to c[last]. The loop is unrolled, because of more than 16 terms compilers
 * would make a loop, and then no vectors. */
static inline __attribute__((always_inline)) double
series(double y, const double *c, int first, int step, int last)
{
    double sum = c[last];
#pragma GCC unroll 16
    for (int n = last - step; n >= first; n -= step)
        sum = sum * y + c[n];
    return sum;
}

/* x = k ln 2 + rest with |rest| <= ln 2 / 2. *power becomes 2^k. */
static inline __attribute__((always_inline)) double
reduce_by_ln_2(double x, double *power)
{
    const double twos = x * (1 / 0x1.62e42fefa39efp-1) + ROUND,
                 k = twos - ROUND;
    *power = of_bits(bits_of(1) + (bits_of(twos) << 52));
    return x - k * LN2[0] - k * LN2[1];
}

/* y = l pi + rest with |rest| <= pi / 2. *sign becomes (-1)^l. */
static inline __attribute__((always_inline)) double reduce_by_pi(double y,
                                                                 double *sign)
{
    const double halves = y * (1 / 0x1.921fb54442d18p+1) + ROUND,
                 l = halves - ROUND;
    *sign = of_bits(bits_of(1) ^ (bits_of(halves) << 63));
    return y - l * PI[0] - l * PI[1];
}

FVI_VECTORS static void exponentials(size_t n, double *restrict re,
                                     double *restrict im)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double power, sign;
        const double x = reduce_by_ln_2(re[i], &power),
                     y = reduce_by_pi(im[i], &sign),
                     size = sign * power * series(x, FACTORIAL, 0, 1, 13);
        re[i] = size * series(-y * y, FACTORIAL, 0, 2, 20);
        im[i] = size * (y * series(-y * y, FACTORIAL, 1, 2, 21));
    }
}

/* With m = e^x - 1 and c = cos y - 1, (1 + m) (1 + c) - 1 = m (1 + c) + c. */
FVI_VECTORS static void exponentials_less_1(size_t n, double *restrict re,
                                            double *restrict im)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double power, sign;
        const double x = reduce_by_ln_2(re[i], &power),
                     y = reduce_by_pi(im[i], &sign),
                     m = power * (x * series(x, FACTORIAL, 1, 1, 13))
                         + (power - 1),
                     c = sign * (-y * y * series(-y * y, FACTORIAL, 2, 2, 20))
                         + (sign - 1);
        re[i] = m * (1 + c) + c;
        im[i] = sign * (1 + m) * (y * series(-y * y, FACTORIAL, 1, 2, 21));
    }
}

/* ln |z|^2 is computed by artanh of a number whose |z|^2 is between 1/sqrt 2 and sqrt 2, after a power of 2 is taken
 * out. The angle is reduced to the first eighth of a turn. Its difference from pi / 8 is the arctan of at most tan(pi /
 * 8). */
FVI_VECTORS static void logarithms(size_t n, double *restrict re,
                                   double *restrict im)
{
    const double eighth = M_SQRT2 - 1; /* tan(pi / 8) */
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        const double x = re[i], y = im[i], square = x * x + y * y;
        const uint64_t up = bits_of(square) + (bits_of(1) - bits_of(M_SQRT1_2));
        const double k = of_bits(bits_of(ROUND) + (up >> 52)) - ROUND - 1023,
                     f = of_bits((up & 0xfffffffffffff) + bits_of(M_SQRT1_2)),
                     s = (f - 1) / (f + 1);
        const double width = fabs(x), steep = width - y,
                     least = select_by_sign(steep, width, y),
                     most = select_by_sign(steep, y, width),
                     t = (least - eighth * most) / (most + eighth * least),
                     y1 = -t * t, y2 = y1 * y1, y5 = y2 * y2 * y1,
                     tail = y5 * y5 * series(y1, ODD, 10, 1, 20),
                     low = M_PI / 8 + t * (series(y1, ODD, 0, 1, 9) + tail),
                     right = select_by_sign(steep, M_PI_2 - low, low);
        re[i] = k * (LN2[0] / 2)
                + (s * series(s * s, ODD, 0, 1, 11) + k * (LN2[1] / 2));
        im[i] = select_by_sign(x, M_PI - right, right);
    }
}

void fvi_vector_exp(size_t n, double *re, double *im)
{
    exponentials(n, re, im);
}

void fvi_vector_expm1(size_t n, double *re, double *im)
{
    exponentials_less_1(n, re, im);
}

void fvi_vector_log(size_t n, double *re, double *im)
{
    logarithms(n, re, im);
}
