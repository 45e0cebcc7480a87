/* src/memory/coefficients.c -- Compute the Grünwald-Letnikov weights and their derivative by the order. [H 4] */
#include <fvi/coefficients.h>

#include "double_double.h"
#include "history_kinds.h" /* FVI_VECTORS */
#include "system/fail.h"

#include <math.h>

static int check(double alpha, size_t count, const double *w)
{
    if (!w)
        FVI_FAIL("w is a null pointer", FVI_EFAULT);
    if (count == 0)
        FVI_FAIL("count must be at least 1", FVI_EINVAL);
    if (!(alpha >= 0 && alpha <= 2))
        FVI_FAIL("alpha must be in [0, 2]", FVI_EDOM);
    return FVI_SUCCESS;
}

int fvi_gl_weights_simple(double alpha, size_t count, double *w)
{
    int status = check(alpha, count, w);
    if (status)
        return status;
    //> textbook
    w[0] = 1;
    for (size_t n = 1; n < count; n++)
        w[n] = w[n - 1] * ((double)n - 1 - alpha) / (double)n; /* (4.2) */
    //< textbook
    return FVI_SUCCESS;
}

//> over
/* Compute a / n for a positive integer n below 2^53. The result again has |lo| <= ulp(hi) / 2. */
static dd over(dd a, double n)
{
    double hi = a.hi / n;
    double lo = (fma(-hi, n, a.hi) + a.lo) / n; /* the remainder of the division, divided by n */
    return (dd){ hi + lo, lo - ((hi + lo) - hi) };
}
//< over

/* This loop has no vectors. It is marked because the wide versions have fma as an instruction, and a
 * call of fma takes longer. */
FVI_VECTORS static void make_weights(double alpha, size_t count, double *w)
{
    //> weights
    w[0] = 1;
    dd s = { -1, 0 }; /* s = w[n] / alpha is about -1/n even if alpha is 1e-310 */
    for (size_t n = 1; n < count; n++) {
        double x = (double)n;
        if (n > 1)
            s = over(times(s, two_sum(x - 1, -alpha)), x); /* (4.2) */
        dd product = times(s, (dd){ alpha, 0 });
        w[n] = product.hi + product.lo; /* a zero comes out as +0 */
    }
    //< weights
}

int fvi_gl_weights(double alpha, size_t count, double *w)
{
    int status = check(alpha, count, w);
    if (!status)
        make_weights(alpha, count, w);
    return status;
}

/* Add two double-doubles. The low part is right to about 106 bits. */
static dd plus(dd a, dd b)
{
    dd s = two_sum(a.hi, b.hi);
    return two_sum(s.hi, s.lo + (a.lo + b.lo));
}

int fvi_gl_weights_by_order(double alpha, size_t count, double *rate)
{
    int status = check(alpha, count, rate);
    if (status)
        return status;
    //> rate
    rate[0] = 0;
    dd s = { -1, 0 }, r = { 0, 0 }; /* w[n] / alpha, and its derivative by alpha */
    for (size_t n = 1; n < count; n++) {
        const double x = (double)n;
        if (n >= 2) {
            const dd factor = two_sum(x - 1, -alpha);
            r = over(plus(times(r, factor), (dd){ -s.hi, -s.lo }), x);
            s = over(times(s, factor), x);
        }
        const dd sum = plus(s, times(r, (dd){ alpha, 0 })); /* (23.9) */
        rate[n] = sum.hi;
    }
    //< rate
    return FVI_SUCCESS;
}
