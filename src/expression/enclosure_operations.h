/* src/expression/enclosure_operations.h -- Enclose sums, products and powers. [H 22]
 *
 * Internal to src/expression. The derivatives follow the recursions of Taylor series, with absolute values in place of
 * the coefficients. */
#ifndef FVI_ENCLOSURE_OPERATIONS_H
#define FVI_ENCLOSURE_OPERATIONS_H

#include "enclosure.h"

#include <float.h>
#include <math.h>

typedef fvi_enclosure enclosure;

/* ---- rounding outward ---- */

/* Round by sixteen units, which is more than any operation or function of one number loses. The smallest normal number
 * covers everything that underflows. The largest finite number is the lower bound of what overflows. */
static inline double round_up(double v)
{
    return v == -INFINITY ? -DBL_MAX
                          : v + (16 * DBL_EPSILON * fabs(v) + DBL_MIN);
}

static inline double round_down(double v)
{
    return -round_up(-v);
}

/* Round up a bound that was computed with fewer than sixty rounding errors. NaN, which is 0 times infinity, becomes
 * INFINITY. */
static inline double bound(double v)
{
    return v <= DBL_MAX ? v * (1 + 64 * DBL_EPSILON) + DBL_MIN : INFINITY;
}

static inline double most_of(double a, double b)
{
    return a > b ? a : b;
}

static inline double least_of(double a, double b)
{
    return a < b ? a : b;
}

/* Return the smallest and the largest |f|. */
static inline double smallest(const enclosure *f)
{
    return f->low > 0 ? f->low : f->high < 0 ? -f->high : 0;
}

static inline double largest(const enclosure *f)
{
    return most_of(fabs(f->low), fabs(f->high));
}

/* ---- to begin and to end with ---- */

static inline void set_range(enclosure *f, double low, double high)
{
    const int known = low <= high;
    f->low = known ? low : -INFINITY;
    f->high = known ? high : INFINITY;
}

/* Set all derivatives up to the order to unknown. */
static inline void clear_derivatives(enclosure *f, int order)
{
    f->top = order;
    for (int k = 1; k <= order; k++)
        f->most[k] = f->part[k] = INFINITY;
}

static inline void set_unknown(enclosure *f, int order)
{
    set_range(f, -INFINITY, INFINITY);
    clear_derivatives(f, order);
    f->most[0] = INFINITY;
    f->part[0] = 1;
}

static inline void set_number(enclosure *f, double v)
{
    set_range(f, v, v);
    f->top = 0;
    f->most[0] = fabs(v);
    f->part[0] = 1;
}

/* Improve each kind of bound with the other. Range and derivatives must be set. */
static inline void tighten(enclosure *f)
{
    const double by_least = 1 / smallest(f);
    f->most[0] = largest(f);
    f->part[0] = 1;
    for (int k = 1; k <= f->top; k++) {
        f->most[k] = least_of(f->most[k], bound(f->part[k] * f->most[0]));
        f->part[k] = least_of(f->part[k], bound(f->most[k] * by_least));
    }
}

/* Return coefficient k of the product of two series. */
static inline double product_coefficient(const double *u, int u_top, const double *w,
                                         int w_top, int k)
{
    double sum = 0;
    for (int j = k > w_top ? k - w_top : 0; j <= k && j <= u_top; j++)
        sum += u[j] * w[k - j];
    return bound(sum);
}

/* ---- operations ---- */

/* Each function computes f from u and w, with derivatives up to the order. f must not be u or w. */
void fvi_enclosure_add(const enclosure *u, const enclosure *w, enclosure *f);
void fvi_enclosure_negate(const enclosure *u, enclosure *f);
void fvi_enclosure_multiply(const enclosure *u, const enclosure *w, int order,
                            enclosure *f);
void fvi_enclosure_invert(const enclosure *u, int order, enclosure *f);
void fvi_enclosure_square(const enclosure *u, int order, enclosure *f);
void fvi_enclosure_whole_power(const enclosure *u, int n, int order,
                               enclosure *f);
void fvi_enclosure_real_power(const enclosure *u, double p, int order,
                              enclosure *f);
void fvi_enclosure_exponential(const enclosure *u, int order, enclosure *f);
void fvi_enclosure_logarithm(const enclosure *u, int order, enclosure *f);
void fvi_enclosure_power(const enclosure *u, const enclosure *w, int order,
                         enclosure *f);

/* fvi_enclosure_slope -- Return (1/k) sum_j j u_j w_{k-j}, coefficient k of the integral of u' w. */
double fvi_enclosure_slope(const double *u, int top, const double *w, int k);

#endif
