/* src/memory/double_double.h -- Sums and products with their rounding errors. [Ch. 4]
 *
 * What coefficients.c and exact_pole.c share. It needs a compiler that neither
 * contracts nor reorders: -ffp-contract=off, no -ffast-math. */
#ifndef FVI_DOUBLE_DOUBLE_H
#define FVI_DOUBLE_DOUBLE_H

#include <float.h>
#include <math.h>

/* Every module is compiled with the same options, so one of them may ask. */
#if defined(__FAST_MATH__) || defined(__ASSOCIATIVE_MATH__)                    \
    || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__)
#error "not with -ffast-math: the weights need their roundings as written"
#endif
#if FLT_EVAL_METHOD != 0 && FLT_EVAL_METHOD != 16 /* 16: but for _Float16 */
#error "doubles must be computed as doubles; on x86: -msse2 -mfpmath=sse"
#endif

//> double-double
/* An unevaluated sum hi + lo with lo at most some ulp(hi): about 106 bits. */
typedef struct {
    double hi, lo;
} dd;

/* Knuth's two-sum: a + b = hi + lo exactly. */
static inline dd two_sum(double a, double b)
{
    double hi = a + b, bb = hi - a;
    return (dd){ hi, (a - (hi - bb)) + (b - bb) };
}

/* Dekker's product, by a fused multiply-add: a b = hi + lo exactly. */
static inline dd two_product(double a, double b)
{
    double hi = a * b;
    return (dd){ hi, fma(a, b, -hi) };
}

/* The product of two sums, without a.lo b.lo. */
static inline dd times(dd a, dd b)
{
    dd p = two_product(a.hi, b.hi);
    return (dd){ p.hi, p.lo + (a.hi * b.lo + a.lo * b.hi) };
}
//< double-double

#endif
