/* src/system/enclosure.c -- What a function can be in an interval of t.  [Chapter 22]
 *
 * The derivatives follow the recursions of Taylor series, with absolute values in place of
 * the coefficients. */
#include "enclosure.h"

#include <fvi/error.h>

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef fvi_enclosure enclosure;

enum { FEW = 24 }; /* nodes of a tape for which no memory is asked */

static const double PI = 3.14159265358979323846;

/* ---- rounding outward ---- */

/* Sixteen units: more than any operation or function of one number loses. The least normal
 * number stands for all that underflows, the largest for the lower bound of what overflows. */
static double up(double v)
{
    return v == -INFINITY ? -DBL_MAX
                          : v + (16 * DBL_EPSILON * fabs(v) + DBL_MIN);
}

static double down(double v)
{
    return -up(-v);
}

/* A bound that was computed in fewer than sixty roundings. NaN, 0 times infinity, tells
 * nothing. */
static double bound(double v)
{
    return v <= DBL_MAX ? v * (1 + 64 * DBL_EPSILON) + DBL_MIN : INFINITY;
}

static double most_of(double a, double b)
{
    return a > b ? a : b;
}

static double least_of(double a, double b)
{
    return a < b ? a : b;
}

/* The smallest and the largest |f|. */
static double smallest(const enclosure *f)
{
    return f->low > 0 ? f->low : f->high < 0 ? -f->high : 0;
}

static double largest(const enclosure *f)
{
    return most_of(fabs(f->low), fabs(f->high));
}

/* ---- to begin and to end with ---- */

static void set_range(enclosure *f, double low, double high)
{
    const int known = low <= high;
    f->low = known ? low : -INFINITY;
    f->high = known ? high : INFINITY;
}

/* All derivatives up to the order, of which nothing is known yet. */
static void forget_derivatives(enclosure *f, int order)
{
    f->top = order;
    for (int k = 1; k <= order; k++)
        f->most[k] = f->part[k] = INFINITY;
}

static void set_unknown(enclosure *f, int order)
{
    set_range(f, -INFINITY, INFINITY);
    forget_derivatives(f, order);
    f->most[0] = INFINITY;
    f->part[0] = 1;
}

static void set_number(enclosure *f, double v)
{
    set_range(f, v, v);
    f->top = 0;
    f->most[0] = fabs(v);
    f->part[0] = 1;
}

static void set_time(enclosure *f, double from, double to)
{
    set_range(f, from, to);
    f->top = 1;
    f->most[0] = largest(f);
    f->part[0] = f->most[1] = 1;
    f->part[1] = smallest(f) > 0 ? bound(1 / smallest(f)) : INFINITY;
}

/* Let each kind of bound help the other. The derivatives are there, the range is too. */
static void tighten(enclosure *f)
{
    const double by_least = 1 / smallest(f);
    f->most[0] = largest(f);
    f->part[0] = 1;
    for (int k = 1; k <= f->top; k++) {
        f->most[k] = least_of(f->most[k], bound(f->part[k] * f->most[0]));
        f->part[k] = least_of(f->part[k], bound(f->most[k] * by_least));
    }
}

/* Coefficient k of a product of two series. */
static double product(const double *u, int u_top, const double *w, int w_top,
                      int k)
{
    double sum = 0;
    for (int j = k > w_top ? k - w_top : 0; j <= k && j <= u_top; j++)
        sum += u[j] * w[k - j];
    return bound(sum);
}

/* (1/k) sum_j j u_j w_{k-j}: coefficient k of the integral of u' w. */
static double of_slope(const double *u, int top, const double *w, int k)
{
    double sum = 0;
    for (int j = 1; j <= k && j <= top; j++)
        sum += j * u[j] * w[k - j];
    return bound(sum / k);
}

/* ---- the four operations ---- */

static void add(const enclosure *u, const enclosure *w, enclosure *f)
{
    const int alike = (u->low >= 0 && w->low >= 0)
                      || (u->high <= 0 && w->high <= 0);
    set_range(f, down(u->low + w->low), up(u->high + w->high));
    f->top = u->top > w->top ? u->top : w->top;
    for (int k = 1; k <= f->top; k++) {
        const int in_u = k <= u->top, in_w = k <= w->top;
        f->most[k] =
            bound((in_u ? u->most[k] : 0) + (in_w ? w->most[k] : 0));
        f->part[k] = alike ? most_of(in_u ? u->part[k] : 0,
                                     in_w ? w->part[k] : 0)
                           : INFINITY;
    }
    tighten(f);
}

static void negate(const enclosure *u, enclosure *f)
{
    *f = *u;
    f->low = -u->high;
    f->high = -u->low;
}

/* 0 times infinity: the infinity is a number that was too large. */
static double times(double a, double b)
{
    return a == 0 || b == 0 ? 0 : a * b;
}

static void multiply(const enclosure *u, const enclosure *w, int order,
                     enclosure *f)
{
    const double a = times(u->low, w->low), b = times(u->low, w->high),
                 c = times(u->high, w->low), d = times(u->high, w->high);
    const int degree = u->top + w->top;
    set_range(f, down(least_of(least_of(a, b), least_of(c, d))),
              up(most_of(most_of(a, b), most_of(c, d))));
    f->top = degree < order ? degree : order;
    for (int k = 1; k <= f->top; k++) {
        f->most[k] = product(u->most, u->top, w->most, w->top, k);
        f->part[k] = product(u->part, u->top, w->part, w->top, k);
    }
    tighten(f);
}

/* u^p where that is positive, or 1/u: p u' f = u f'. Of the range nothing is said. */
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

static void invert(const enclosure *u, int order, enclosure *f)
{
    if (u->low <= 0 && u->high >= 0) {
        set_unknown(f, order);
        return;
    }
    const double low = 1 / u->high, high = 1 / u->low;
    raise_parts(u, -1, order, f);
    set_range(f, u->low > 0 ? most_of(0, down(low)) : down(low),
              u->low > 0 ? up(high) : least_of(0, up(high)));
    tighten(f);
}

static void square(const enclosure *u, int order, enclosure *f)
{
    multiply(u, u, order, f);
    f->low = most_of(0, down(smallest(u) * smallest(u)));
    tighten(f);
}

/* ---- powers ---- */

/* u^n, n >= 1, by squares: u may be 0 and negative. */
static void whole_power(const enclosure *u, int n, int order, enclosure *f)
{
    enclosure rest = *u, other;
    int started = 0;
    for (;; n >>= 1) {
        if (n & 1 && started) {
            multiply(f, &rest, order, &other);
            *f = other;
        } else if (n & 1) {
            *f = rest;
            started = 1;
        }
        if (n == 1)
            return;
        square(&rest, order, &other);
        rest = other;
    }
}

static void real_power(const enclosure *u, double p, int order, enclosure *f)
{
    if (!(u->low >= 0) || (u->low == 0 && p < 0)) {
        set_unknown(f, order);
        return;
    }
    const double low = pow(u->low, p), high = pow(u->high, p);
    raise_parts(u, p, order, f);
    set_range(f, most_of(0, down(least_of(low, high))), up(most_of(low, high)));
    tighten(f);
}

static void exponential(const enclosure *u, int order, enclosure *f)
{
    f->top = u->top > 0 ? order : 0;
    f->part[0] = 1;
    for (int k = 1; k <= f->top; k++) {
        f->part[k] = of_slope(u->most, u->top, f->part, k);
        f->most[k] = INFINITY;
    }
    set_range(f, most_of(0, down(exp(u->low))), up(exp(u->high)));
    tighten(f);
}

/* log(u)_k = u_k / u - (1/k) sum_{j<k} j log(u)_j u_{k-j} / u */
static void logarithm(const enclosure *u, int order, enclosure *f)
{
    if (!(u->low > 0)) {
        set_unknown(f, order);
        return;
    }
    set_range(f, down(log(u->low)), up(log(u->high)));
    forget_derivatives(f, u->top > 0 ? order : 0);
    for (int k = 1; k <= f->top; k++) {
        double sum = k <= u->top ? u->part[k] : 0;
        for (int j = k > u->top ? k - u->top : 1; j < k; j++)
            sum += j * f->most[j] * u->part[k - j] / k;
        f->most[k] = bound(sum);
    }
    tighten(f);
}

static void power(const enclosure *u, const enclosure *w, int order,
                  enclosure *f)
{
    const double p = w->low;
    const int constant = w->top == 0 && w->high == p;
    enclosure g, h;
    if (constant && p == floor(p) && p != 0 && fabs(p) <= 64) {
        whole_power(u, (int)fabs(p), order, p > 0 ? f : &g);
        if (p < 0)
            invert(&g, order, f);
    } else if (constant) {
        real_power(u, p, order, f);
    } else if (!(u->low > 0)) { /* the C library knows (-2)^w where w is rounded to 1 */
        set_unknown(f, order);
    } else {
        logarithm(u, order, &g);
        multiply(w, &g, order, &h);
        exponential(&h, order, f);
    }
}

/* ---- functions ---- */

/* Does a point offset + n period, n whole, lie in the interval, or near it? */
static int meets(const enclosure *u, double offset, double period)
{
    const double off = 8 * DBL_EPSILON * (largest(u) + period);
    return floor((u->high + off - offset) / period)
           >= ceil((u->low - off - offset) / period);
}

/* The range of sine, or of cosine, which is the same from a quarter earlier on. */
static void wave_range(const enclosure *u, int is_sine, enclosure *f)
{
    const double top = is_sine ? PI / 2 : 0, bottom = top + PI;
    if (!(largest(u) < 1e9)) {
        set_range(f, -1, 1);
        return;
    }
    const double a = is_sine ? sin(u->low) : cos(u->low),
                 b = is_sine ? sin(u->high) : cos(u->high);
    set_range(f,
              meets(u, bottom, 2 * PI) ? -1 : most_of(-1, down(least_of(a, b))),
              meets(u, top, 2 * PI) ? 1 : least_of(1, up(most_of(a, b))));
}

/* s' = c u', |c'| = |s u'|, and both are bounded at first. */
static void pair(const enclosure *u, enclosure *s, enclosure *c, int order)
{
    s->top = c->top = u->top > 0 ? order : 0;
    s->most[0] = largest(s);
    c->most[0] = largest(c);
    for (int k = 1; k <= s->top; k++) {
        s->most[k] = of_slope(u->most, u->top, c->most, k);
        c->most[k] = of_slope(u->most, u->top, s->most, k);
        s->part[k] = c->part[k] = INFINITY;
    }
}

static void wave(const enclosure *u, int is_sine, int order, enclosure *f)
{
    enclosure other;
    wave_range(u, is_sine, f);
    wave_range(u, !is_sine, &other);
    pair(u, f, &other, order);
    tighten(f);
}

/* |sinh| < cosh, so that both follow exp, in parts of cosh. */
static void hyperbolic(const enclosure *u, int is_sine, int order, enclosure *f)
{
    const double most = up(cosh(largest(u)));
    exponential(u, order, f);
    for (int k = 1; is_sine && k <= f->top; k++) {
        f->most[k] = bound(f->part[k] * most);
        f->part[k] = INFINITY;
    }
    for (int k = 1; !is_sine && k <= f->top; k++)
        f->most[k] = INFINITY;
    if (is_sine)
        set_range(f, down(sinh(u->low)), up(sinh(u->high)));
    else
        set_range(f, down(least_of(DBL_MAX, cosh(smallest(u)))), most);
    tighten(f);
}

/* f' = (1 + f^2) u' or (1 - f^2) u'. The first factor at most is given. */
static void tangent(const enclosure *u, double factor, int order, enclosure *f)
{
    double more[FVI_ENCLOSURE_ORDER + 1] = { factor };
    forget_derivatives(f, u->top > 0 ? order : 0);
    f->most[0] = largest(f);
    for (int k = 1; k <= f->top; k++) {
        f->most[k] = of_slope(u->most, u->top, more, k);
        more[k] = product(f->most, k, f->most, k, k);
    }
    tighten(f);
}

static void circular_tangent(const enclosure *u, int order, enclosure *f)
{
    if (!(largest(u) < 1e9) || meets(u, PI / 2, PI)) {
        set_unknown(f, order);
        return;
    }
    set_range(f, down(tan(u->low)), up(tan(u->high)));
    tangent(u, up(1 + largest(f) * largest(f)), order, f);
}

static void hyperbolic_tangent(const enclosure *u, int order, enclosure *f)
{
    const double c = cosh(smallest(u));
    set_range(f, most_of(-1, down(tanh(u->low))),
              least_of(1, up(tanh(u->high))));
    tangent(u, up(1 / c / c), order, f);
}

/* f' = (1 + sign u^2)^p u', the range of f being there. */
static void inverse_function(const enclosure *u, double sign, double p,
                             int order, enclosure *f)
{
    const double low = f->low, high = f->high;
    enclosure one, g, h, slope;
    set_number(&one, 1);
    square(u, order, &g);
    if (sign < 0) {
        negate(&g, &h);
        g = h;
    }
    add(&one, &g, &h);
    real_power(&h, p, order, &slope);
    for (int k = slope.top + 1; k <= order; k++)
        slope.most[k] = 0;
    forget_derivatives(f, u->top > 0 ? order : 0);
    for (int k = 1; k <= f->top; k++)
        f->most[k] = of_slope(u->most, u->top, slope.most, k);
    set_range(f, low, high);
    tighten(f);
}

static void absolute(const enclosure *u, int order, enclosure *f)
{
    if (u->high <= 0)
        negate(u, f);
    else
        *f = *u;
    if (u->low >= 0 || u->high <= 0)
        return;
    forget_derivatives(f, u->top > 0 ? order : 0);
    if (f->top > 0)
        f->most[1] = u->most[1];
    set_range(f, 0, largest(u));
    tighten(f);
}

/* ---- along a tape ---- */

static void operate(const fvi_node *at, const enclosure *u, const enclosure *w,
                    int order, enclosure *f)
{
    enclosure g;
    switch (at->op) {
    case TAPE_NUMBER:
    case TAPE_COORDINATE:
    case TAPE_PARAMETER:
        break;
    case TAPE_ADD:
        add(u, w, f);
        break;
    case TAPE_SUBTRACT:
        negate(w, &g);
        add(u, &g, f);
        break;
    case TAPE_MULTIPLY:
        if (at->a == at->b)
            square(u, order, f);
        else
            multiply(u, w, order, f);
        break;
    case TAPE_DIVIDE:
        invert(w, order, &g);
        multiply(u, &g, order, f);
        break;
    case TAPE_NEGATE:
        negate(u, f);
        break;
    case TAPE_WHOLE_POWER:
        whole_power(u, (int)at->number, order, f);
        break;
    case TAPE_POWER:
        power(u, w, order, f);
        break;
    case TAPE_SIN:
    case TAPE_COS:
        wave(u, at->op == TAPE_SIN, order, f);
        break;
    case TAPE_TAN:
        circular_tangent(u, order, f);
        break;
    case TAPE_ASIN:
        set_range(f, down(asin(u->low)), up(asin(u->high)));
        inverse_function(u, -1, -0.5, order, f);
        break;
    case TAPE_ACOS:
        set_range(f, down(acos(u->high)), up(acos(u->low)));
        inverse_function(u, -1, -0.5, order, f);
        break;
    case TAPE_ATAN:
        set_range(f, down(atan(u->low)), up(atan(u->high)));
        inverse_function(u, 1, -1, order, f);
        break;
    case TAPE_SINH:
    case TAPE_COSH:
        hyperbolic(u, at->op == TAPE_SINH, order, f);
        break;
    case TAPE_TANH:
        hyperbolic_tangent(u, order, f);
        break;
    case TAPE_EXP:
        exponential(u, order, f);
        break;
    case TAPE_LOG:
        logarithm(u, order, f);
        break;
    case TAPE_SQRT:
        real_power(u, 0.5, order, f);
        break;
    case TAPE_ABS:
        absolute(u, order, f);
        break;
    }
}

/* A leaf is made where it is wanted, because several nodes may want it; all else stands on
 * a stack until the one node takes it that wants it. */
static const enclosure *operand(const fvi_node *node, int i,
                                const enclosure *time, const double *k,
                                enclosure *leaf, enclosure **free_place)
{
    if (node[i].op == TAPE_COORDINATE)
        return time;
    if (node[i].op == TAPE_NUMBER || node[i].op == TAPE_PARAMETER) {
        set_number(leaf, node[i].op == TAPE_NUMBER ? node[i].number
                                                   : k[node[i].a]);
        return leaf;
    }
    return --*free_place;
}

static enclosure walk(const fvi_node *node, size_t n, const enclosure *time,
                      const double *k, int order, enclosure *place)
{
    enclosure left, right, f;
    for (size_t m = 0; m < n; m++) {
        const fvi_node *at = &node[m];
        if (at->op < TAPE_ADD)
            continue;
        const enclosure *w = operand(node, at->b, time, k, &right, &place),
                        *u = at->a == at->b
                                 ? w
                                 : operand(node, at->a, time, k, &left, &place);
        operate(at, u, w, order, &f);
        *place++ = f;
    }
    return *operand(node, (int)n - 1, time, k, &left, &place);
}

int fvi_tape_enclose(const fvi_node *node, size_t n, double from, double to,
                     const double *k, int order, fvi_enclosure *f)
{
    enclosure time, few[FEW], *many = few;
    if (n > FEW && !(many = malloc(n * sizeof *many)))
        return FVI_ENOMEM;
    set_time(&time, from, to);
    *f = walk(node, n, &time, k, order, many);
    if (many != few)
        free(many);
    return FVI_SUCCESS;
}

double fvi_enclosure_half(const fvi_enclosure *f)
{
    const double half = f->high / 2 - f->low / 2;
    return half > 0 ? up(half) : 0;
}
