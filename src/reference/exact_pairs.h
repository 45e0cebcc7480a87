/* src/reference/exact_pairs.h -- Complex numbers for loops that the compiler turns into vectors. [H 11]
 *
 * With double complex the compiler would check after each product whether it is NaN. */
#ifndef FVI_EXACT_PAIRS_H
#define FVI_EXACT_PAIRS_H

#include <stddef.h>

/* Complex numbers as two arrays. */
typedef struct {
    double *re, *im;
} fvi_parts;

typedef struct {
    double re, im;
} pair;

static inline pair product(pair a, pair b)
{
    return (pair){ a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re };
}

static inline pair sum(pair a, pair b)
{
    return (pair){ a.re + b.re, a.im + b.im };
}

static inline pair scaled(double a, pair b)
{
    return (pair){ a * b.re, a * b.im };
}

/* 1 / a, if the square of a is in range. */
static inline pair reciprocal(pair a)
{
    const double size = a.re * a.re + a.im * a.im;
    return (pair){ a.re / size, -a.im / size };
}

static inline pair pair_at(const fvi_parts *a, size_t i)
{
    return (pair){ a->re[i], a->im[i] };
}

static inline void store_pair(const fvi_parts *a, size_t i, pair z)
{
    a->re[i] = z.re;
    a->im[i] = z.im;
}

#endif
