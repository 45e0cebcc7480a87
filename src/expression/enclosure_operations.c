/* src/expression/enclosure_operations.c -- Enclose sums, products and powers.  [H 22] */
#include "enclosure_operations.h"

double fvi_enclosure_slope(const double *u, int top, const double *w, int k)
{
    double sum = 0;
    for (int j = 1; j <= k && j <= top; j++)
        sum += j * u[j] * w[k - j];
    return bound(sum / k);
}

/* ---- the four operations ---- */

void fvi_enclosure_add(const enclosure *u, const enclosure *w, enclosure *f)
{
    const int alike =
        (u->low >= 0 && w->low >= 0) || (u->high <= 0 && w->high <= 0);
    set_range(f, round_down(u->low + w->low), round_up(u->high + w->high));
    f->top = u->top > w->top ? u->top : w->top;
    for (int k = 1; k <= f->top; k++) {
        const int in_u = k <= u->top, in_w = k <= w->top;
        f->most[k] = bound((in_u ? u->most[k] : 0) + (in_w ? w->most[k] : 0));
        f->part[k] = alike
                         ? most_of(in_u ? u->part[k] : 0, in_w ? w->part[k] : 0)
                         : INFINITY;
    }
    tighten(f);
}

void fvi_enclosure_negate(const enclosure *u, enclosure *f)
{
    *f = *u;
    f->low = -u->high;
    f->high = -u->low;
}

/* 0 times infinity is 0, because the infinity stands for a number that was too large. */
static double multiply_bounds(double a, double b)
{
    return a == 0 || b == 0 ? 0 : a * b;
}

void fvi_enclosure_multiply(const enclosure *u, const enclosure *w, int order,
                            enclosure *f)
{
    const double a = multiply_bounds(u->low, w->low), b = multiply_bounds(u->low, w->high),
                 c = multiply_bounds(u->high, w->low), d = multiply_bounds(u->high, w->high);
    const int degree = u->top + w->top;
    set_range(f, round_down(least_of(least_of(a, b), least_of(c, d))),
              round_up(most_of(most_of(a, b), most_of(c, d))));
    f->top = degree < order ? degree : order;
    for (int k = 1; k <= f->top; k++) {
        f->most[k] = product_coefficient(u->most, u->top, w->most, w->top, k);
        f->part[k] = product_coefficient(u->part, u->top, w->part, w->top, k);
    }
    tighten(f);
}

/* Set the derivatives of u^p where u is positive, or of 1/u: p u' f = u f'. The range is not set. */
static void raise_parts(const enclosure *u, double p, int order, enclosure *f)
{
    f->top = u->top > 0 ? order : 0;
    f->part[0] = 1;
    for (int k = 1; k <= f->top; k++) {
        double sum = 0;
        for (int j = 1; j <= k && j <= u->top; j++)
            sum += fabs(p * j - (k - j)) * u->part[j] * f->part[k - j];
        f->part[k] = bound(sum / k);
        f->most[k] = INFINITY;
    }
}

void fvi_enclosure_invert(const enclosure *u, int order, enclosure *f)
{
    if (u->low <= 0 && u->high >= 0) {
        set_unknown(f, order);
        return;
    }
    const double low = 1 / u->high, high = 1 / u->low;
    raise_parts(u, -1, order, f);
    set_range(f, u->low > 0 ? most_of(0, round_down(low)) : round_down(low),
              u->low > 0 ? round_up(high) : least_of(0, round_up(high)));
    tighten(f);
}

void fvi_enclosure_square(const enclosure *u, int order, enclosure *f)
{
    fvi_enclosure_multiply(u, u, order, f);
    f->low = most_of(0, round_down(smallest(u) * smallest(u)));
    tighten(f);
}

/* ---- powers ---- */

/* u^n for n >= 1 by repeated squaring; u may be 0 or negative. */
void fvi_enclosure_whole_power(const enclosure *u, int n, int order,
                               enclosure *f)
{
    enclosure rest = *u, other;
    int started = 0;
    for (;; n >>= 1) {
        if (n & 1 && started) {
            fvi_enclosure_multiply(f, &rest, order, &other);
            *f = other;
        } else if (n & 1) {
            *f = rest;
            started = 1;
        }
        if (n == 1)
            return;
        fvi_enclosure_square(&rest, order, &other);
        rest = other;
    }
}

void fvi_enclosure_real_power(const enclosure *u, double p, int order,
                              enclosure *f)
{
    if (!(u->low >= 0) || (u->low == 0 && p < 0)) {
        set_unknown(f, order);
        return;
    }
    const double low = pow(u->low, p), high = pow(u->high, p);
    raise_parts(u, p, order, f);
    set_range(f, most_of(0, round_down(least_of(low, high))), round_up(most_of(low, high)));
    tighten(f);
}

void fvi_enclosure_exponential(const enclosure *u, int order, enclosure *f)
{
    f->top = u->top > 0 ? order : 0;
    f->part[0] = 1;
    for (int k = 1; k <= f->top; k++) {
        f->part[k] = fvi_enclosure_slope(u->most, u->top, f->part, k);
        f->most[k] = INFINITY;
    }
    set_range(f, most_of(0, round_down(exp(u->low))), round_up(exp(u->high)));
    tighten(f);
}

/* log(u)_k = u_k / u - (1/k) sum_{j<k} j log(u)_j u_{k-j} / u */
void fvi_enclosure_logarithm(const enclosure *u, int order, enclosure *f)
{
    if (!(u->low > 0)) {
        set_unknown(f, order);
        return;
    }
    set_range(f, round_down(log(u->low)), round_up(log(u->high)));
    clear_derivatives(f, u->top > 0 ? order : 0);
    for (int k = 1; k <= f->top; k++) {
        double sum = k <= u->top ? u->part[k] : 0;
        for (int j = k > u->top ? k - u->top : 1; j < k; j++)
            sum += j * f->most[j] * u->part[k - j] / k;
        f->most[k] = bound(sum);
    }
    tighten(f);
}

void fvi_enclosure_power(const enclosure *u, const enclosure *w, int order,
                         enclosure *f)
{
    const double p = w->low;
    const int constant = w->top == 0 && w->high == p;
    enclosure g, h;
    if (constant && p == floor(p) && p != 0 && fabs(p) <= 64) {
        fvi_enclosure_whole_power(u, (int)fabs(p), order, p > 0 ? f : &g);
        if (p < 0)
            fvi_enclosure_invert(&g, order, f);
    } else if (constant) {
        fvi_enclosure_real_power(u, p, order, f);
    } else if (
        !(u->low
          > 0)) { /* pow of the C library is defined for (-2)^w where w is rounded to 1 */
        set_unknown(f, order);
    } else {
        fvi_enclosure_logarithm(u, order, &g);
        fvi_enclosure_multiply(w, &g, order, &h);
        fvi_enclosure_exponential(&h, order, f);
    }
}
