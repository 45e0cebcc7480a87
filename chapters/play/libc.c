/* chapters/play/libc.c -- Small parts in place of large ones of the C library.
 *
 * The linker takes what is here instead of what wasi-libc and compiler-rt have: an
 * allocator, complex products and quotients, a logarithm without a table of 4 kB,
 * and the sine of huge numbers. All else of the mathematics is wasi-libc's own. */
#include <complex.h>
#include <gsl/gsl_math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* ---- memory: whatever a call of the page takes, it gives back ---- */

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

/* When the last block has come back, the heap is empty again. */
void free(void *block)
{
    if (block && --blocks == 0)
        top = 0;
}

/* ---- complex numbers ---- */

static double complex complex_of(double re, double im)
{
    union {
        double part[2];
        double complex z;
    } both = { { re, im } };
    return both.z;
}

/* A product of finite numbers. The compiler calls this where its own has given
 * NaN; that infinities might be saved from it is left out. */
__attribute__((always_inline)) double complex __muldc3(double a, double b,
                                                       double c, double d)
{
    return complex_of(a * c - b * d, b * c + a * d);
}

/* (a + i b) / (c + i d) by Smith's method: no square that could overflow. */
double complex __divdc3(double a, double b, double c, double d)
{
    if (fabs(c) < fabs(d)) {
        const double r = c / d, all = c * r + d;
        return complex_of((a * r + b) / all, (b * r - a) / all);
    }
    const double r = d / c, all = c + d * r;
    return complex_of((a + b * r) / all, (b - a * r) / all);
}

/* ---- the natural logarithm, without a table: to 0.55 ulp ---- */

/* ln x = k ln 2 + 2 (s + s^3/3 + s^5/5 + ...), s = (m - 1)/(m + 1), for x = 2^k m
 * and m in [1/sqrt(2), sqrt(2)). m - 1 and k times the upper part of ln 2 are exact;
 * low is what s lacks. Below s^29 all is less than 2^-75 s. */
double log(double x)
{
    int k;
    if (x == 0)
        return -INFINITY;
    double m = frexp(x, &k);
    if (m < M_SQRT1_2) {
        m *= 2;
        k--;
    }
    const double d = m + 1, d_low = m - (d - 1), s = (m - 1) / d,
                 low = (fma(-s, d, m - 1) - s * d_low) / d,
                 whole = k * 0x1.62e42feep-1, sum = whole + 2 * s;
    double series = 0;
    for (int n = 29; n > 1; n -= 2)
        series = series * (s * s) + 1. / n;
    return sum
           + ((whole - sum) + 2 * s
              + (2 * (low + s * (s * s) * series) + k * 0x1.a39ef35793c76p-33));
}

/* ---- sin and cos of |x| > 10^6: x modulo pi/2, exactly ---- */

/* 2/pi = 0.a2f98..., 32 bits at a time. */
static const uint32_t two_over_pi[] = {
    0xa2f9836e, 0x4e441529, 0xfc2757d1, 0xf534ddc0, 0xdb629599, 0x3c439041,
    0xfe5163ab, 0xdebbc561, 0xb7246e3a, 0x424dd2e0, 0x06492eea, 0x09d1921c,
    0xfe1deb1c, 0xb129a73e, 0xe88235f5, 0x2ebb4484, 0xe99c7026, 0xb45f7e41,
    0x3991d639, 0x835339f4, 0x9c845f8b, 0xbdf9283b, 0x1ff897ff, 0xde05980f,
    0xef2f118b, 0x5a0a6d1f, 0x6d367ecf, 0x27cb09b7, 0x4f463f66, 0x9e5fea2d,
    0x7527bac7, 0xebe5f17b, 0x3d0739f7, 0x8a5292ea, 0x6bfb5fb1, 0x1f8d5d08,
    0x56033046
};
enum { WORDS = 7 }; /* of them are enough: 53 bits of x, 62 that may cancel */

/* 64 bits of a long number, from that bit on. */
static uint64_t bits(const uint32_t *q, int from)
{
    const int word = from / 32, bit = from % 32;
    const uint64_t two = (uint64_t)q[word + 1] << 32 | q[word];
    return bit ? two >> bit | (uint64_t)q[word + 2] << (64 - bit) : two;
}

/* wasi-libc cuts |x| into nx pieces of 24 bits, the first an integer times 2^e0,
 * and asks for the number of quarter turns and for the rest, y[0] + y[1] in
 * [-pi/4, pi/4]. With |x| = m 2^e the words of 2/pi that would give whole turns
 * are left out, and those that are too small to matter. */
int __rem_pio2_large(double *x, double *y, int e0, int nx, int prec)
{
    const uint64_t m = (uint64_t)x[0] << 29 | (nx > 1 ? (uint64_t)x[1] << 5 : 0)
                       | (nx > 2 ? (uint64_t)x[2] >> 19 : 0);
    const int e = e0 - 29, first = e < 2 ? 0 : (e - 2) / 32,
              point = 32 * (WORDS + first) - e; /* the bit of 1 in q */
    (void)prec;
    uint32_t q[WORDS + 5] = { 0 }; /* m times those words */
    for (int i = 0; i < 2; i++) {
        uint64_t carry = 0;
        for (int j = 0; j < WORDS; j++) {
            carry +=
                (m >> 32 * i & 0xffffffff) * two_over_pi[first + WORDS - 1 - j]
                + q[i + j];
            q[i + j] = (uint32_t)carry;
            carry >>= 32;
        }
        q[i + WORDS] = (uint32_t)carry;
    }
    uint64_t high = bits(q, point - 64), low = bits(q, point - 128);
    int turns = (int)(bits(q, point) & 3);
    double quarter = 0x1.921fb54442d18p+0, quarter_low = 0x1.1a62633145c07p-54;
    if (high >> 63) { /* the next quarter is nearer */
        turns++;
        quarter = -quarter;
        quarter_low = -quarter_low;
        low = -low;
        high = ~high + (low == 0);
    }
    const double near = (double)(high >> 11) * 0x1p-53,
                 rest = (double)(high << 53 | low >> 11) * 0x1p-117,
                 product = near * quarter,
                 tail = fma(near, quarter, -product)
                        + (near * quarter_low + rest * quarter);
    y[0] = product + tail;
    y[1] = (product - y[0]) + tail;
    return turns;
}
