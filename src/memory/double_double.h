/* src/memory/double_double.h -- Compute sums and products together with their rounding errors. [Ch. 4]
 *
 * coefficients.c and exact_pole.c use these functions. The compiler must neither contract nor reorder operations, so we
 * compile with -ffp-contract=off and without -ffast-math. */
#ifndef FVI_DOUBLE_DOUBLE_H
#define FVI_DOUBLE_DOUBLE_H

#include <float.h>
#include <math.h>

/* All files are compiled with the same options, so it is enough to test them here. */
#if defined(__FAST_MATH__) || defined(__ASSOCIATIVE_MATH__)                    \
    || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__)
#error "not with -ffast-math: the weights need their roundings as written"
#endif
#if FLT_EVAL_METHOD != 0 && FLT_EVAL_METHOD != 16 /* FLT_EVAL_METHOD 16 differs from 0 only for _Float16 */
#error "doubles must be computed as doubles; on x86: -msse2 -mfpmath=sse"
#endif

//> double-double
/* A double-double is an unevaluated sum hi + lo with lo at most some ulp(hi). It has about 106 bits. */
typedef struct {
    double hi, lo;
} dd;

/* Knuth's two-sum: a + b = hi + lo exactly. */
static inline dd two_sum(double a, double b)
{
    double hi = a + b, bb = hi - a;
    return (dd){ hi, (a - (hi - bb)) + (b - bb) };
}

/* Dekker's product with a fused multiply-add: a b = hi + lo exactly. */
static inline dd two_product(double a, double b)
{
    double hi = a * b;
    return (dd){ hi, fma(a, b, -hi) };
}

/* Multiply two double-doubles; the product a.lo b.lo is left out, because it is below the accuracy of the result. */
static inline dd times(dd a, dd b)
{
    dd p = two_product(a.hi, b.hi);
    return (dd){ p.hi, p.lo + (a.hi * b.lo + a.lo * b.hi) };
}
//< double-double

#endif
