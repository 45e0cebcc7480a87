/* src/expression/enclosure.c -- Enclose the values and derivatives of a function in an interval of t.  [H 22] */
#include "enclosure.h"

#include "enclosure_operations.h"
#include <fvi/error.h>

#include <stdlib.h>

enum { MOST_NODES_ON_STACK = 24 }; /* nodes of a tape for which no memory is allocated */

static const double PI = 3.14159265358979323846;

/* ---- functions ---- */

/* Return nonzero if a point offset + n period, n whole, lies in the interval or within a rounding error of it. */
static int contains_point(const enclosure *u, double offset, double period)
{
    const double off = 8 * DBL_EPSILON * (largest(u) + period);
    return floor((u->high + off - offset) / period)
           >= ceil((u->low - off - offset) / period);
}

/* Set the range of sine or cosine. Cosine has its extremes a quarter of a period earlier. */
static void range_of_sine(const enclosure *u, int is_sine, enclosure *f)
{
    const double top = is_sine ? PI / 2 : 0, bottom = top + PI;
    if (!(largest(u) < 1e9)) {
        set_range(f, -1, 1);
        return;
    }
    const double a = is_sine ? sin(u->low) : cos(u->low),
                 b = is_sine ? sin(u->high) : cos(u->high);
    set_range(f,
              contains_point(u, bottom, 2 * PI) ? -1 : most_of(-1, round_down(least_of(a, b))),
              contains_point(u, top, 2 * PI) ? 1 : least_of(1, round_up(most_of(a, b))));
}

/* Bound the derivatives of sine s and cosine c, whose ranges are known: |s'| = |c u'| and |c'| = |s u'|. */
static void bound_sine_derivatives(const enclosure *u, enclosure *s, enclosure *c, int order)
{
    s->top = c->top = u->top > 0 ? order : 0;
    s->most[0] = largest(s);
    c->most[0] = largest(c);
    for (int k = 1; k <= s->top; k++) {
        s->most[k] = fvi_enclosure_slope(u->most, u->top, c->most, k);
        c->most[k] = fvi_enclosure_slope(u->most, u->top, s->most, k);
        s->part[k] = c->part[k] = INFINITY;
    }
}

static void enclose_sine(const enclosure *u, int is_sine, int order, enclosure *f)
{
    enclosure other;
    range_of_sine(u, is_sine, f);
    range_of_sine(u, !is_sine, &other);
    bound_sine_derivatives(u, f, &other, order);
    tighten(f);
}

/* |sinh| < cosh, so the derivatives of both, as parts of cosh, follow from those of exp. */
static void enclose_hyperbolic_sine(const enclosure *u, int is_sine, int order, enclosure *f)
{
    const double most = round_up(cosh(largest(u)));
    fvi_enclosure_exponential(u, order, f);
    for (int k = 1; is_sine && k <= f->top; k++) {
        f->most[k] = bound(f->part[k] * most);
        f->part[k] = INFINITY;
    }
    for (int k = 1; !is_sine && k <= f->top; k++)
        f->most[k] = INFINITY;
    if (is_sine)
        set_range(f, round_down(sinh(u->low)), round_up(sinh(u->high)));
    else
        set_range(f, round_down(least_of(DBL_MAX, cosh(smallest(u)))), most);
    tighten(f);
}

/* f' = (1 + f^2) u' or (1 - f^2) u'. `factor` bounds the first factor. */
static void enclose_tangent(const enclosure *u, double factor, int order, enclosure *f)
{
    double more[FVI_ENCLOSURE_ORDER + 1] = { factor };
    clear_derivatives(f, u->top > 0 ? order : 0);
    f->most[0] = largest(f);
    for (int k = 1; k <= f->top; k++) {
        f->most[k] = fvi_enclosure_slope(u->most, u->top, more, k);
        more[k] = product_coefficient(f->most, k, f->most, k, k);
    }
    tighten(f);
}

static void circular_tangent(const enclosure *u, int order, enclosure *f)
{
    if (!(largest(u) < 1e9) || contains_point(u, PI / 2, PI)) {
        set_unknown(f, order);
        return;
    }
    set_range(f, round_down(tan(u->low)), round_up(tan(u->high)));
    enclose_tangent(u, round_up(1 + largest(f) * largest(f)), order, f);
}

static void hyperbolic_tangent(const enclosure *u, int order, enclosure *f)
{
    const double c = cosh(smallest(u));
    set_range(f, most_of(-1, round_down(tanh(u->low))),
              least_of(1, round_up(tanh(u->high))));
    enclose_tangent(u, round_up(1 / c / c), order, f);
}

/* f' = (1 + sign u^2)^p u'. The range of f is known. */
static void inverse_function(const enclosure *u, double sign, double p,
                             int order, enclosure *f)
{
    const double low = f->low, high = f->high;
    enclosure one, g, h, slope;
    set_number(&one, 1);
    fvi_enclosure_square(u, order, &g);
    if (sign < 0) {
        fvi_enclosure_negate(&g, &h);
        g = h;
    }
    fvi_enclosure_add(&one, &g, &h);
    fvi_enclosure_real_power(&h, p, order, &slope);
    for (int k = slope.top + 1; k <= order; k++)
        slope.most[k] = 0;
    clear_derivatives(f, u->top > 0 ? order : 0);
    for (int k = 1; k <= f->top; k++)
        f->most[k] = fvi_enclosure_slope(u->most, u->top, slope.most, k);
    set_range(f, low, high);
    tighten(f);
}

static void enclose_absolute(const enclosure *u, int order, enclosure *f)
{
    if (u->high <= 0)
        fvi_enclosure_negate(u, f);
    else
        *f = *u;
    if (u->low >= 0 || u->high <= 0)
        return;
    clear_derivatives(f, u->top > 0 ? order : 0);
    if (f->top > 0)
        f->most[1] = u->most[1];
    set_range(f, 0, largest(u));
    tighten(f);
}

/* It jumps where u passes 0. */
static void sign_of(const enclosure *u, int order, enclosure *f)
{
    if (u->low > 0 || u->high < 0) {
        set_number(f, u->low > 0 ? 1 : -1);
        return;
    }
    clear_derivatives(f, u->top > 0 ? order : 0);
    set_range(f, -1, 1);
    tighten(f);
}

/* Enclose the larger of two functions. Where either may be the larger, its slope is at most that of the steeper one,
 * and the slope may jump, so higher derivatives are unknown. */
static void larger_of(const enclosure *u, const enclosure *w, int order,
                      enclosure *f)
{
    if (u->low >= w->high || w->low >= u->high) {
        *f = u->low >= w->high ? *u : *w;
        return;
    }
    clear_derivatives(f, u->top > 0 || w->top > 0 ? order : 0);
    if (f->top > 0)
        f->most[1] = most_of(u->top > 0 ? u->most[1] : 0,
                             w->top > 0 ? w->most[1] : 0);
    set_range(f, most_of(u->low, w->low), most_of(u->high, w->high));
    tighten(f);
}

/* min(u, w) = -max(-u, -w). */
static void smaller_of(const enclosure *u, const enclosure *w, int order,
                       enclosure *f)
{
    enclosure minus_u, minus_w, g;
    fvi_enclosure_negate(u, &minus_u);
    fvi_enclosure_negate(w, &minus_w);
    larger_of(&minus_u, &minus_w, order, &g);
    fvi_enclosure_negate(&g, f);
}

/* ---- along a tape ---- */

static void set_time(enclosure *f, double from, double to)
{
    set_range(f, from, to);
    f->top = 1;
    f->most[0] = largest(f);
    f->part[0] = f->most[1] = 1;
    f->part[1] = smallest(f) > 0 ? bound(1 / smallest(f)) : INFINITY;
}

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
        fvi_enclosure_add(u, w, f);
        break;
    case TAPE_SUBTRACT:
        fvi_enclosure_negate(w, &g);
        fvi_enclosure_add(u, &g, f);
        break;
    case TAPE_MULTIPLY:
        if (at->a == at->b)
            fvi_enclosure_square(u, order, f);
        else
            fvi_enclosure_multiply(u, w, order, f);
        break;
    case TAPE_DIVIDE:
        fvi_enclosure_invert(w, order, &g);
        fvi_enclosure_multiply(u, &g, order, f);
        break;
    case TAPE_NEGATE:
        fvi_enclosure_negate(u, f);
        break;
    case TAPE_WHOLE_POWER:
        fvi_enclosure_whole_power(u, (int)at->number, order, f);
        break;
    case TAPE_POWER:
        fvi_enclosure_power(u, w, order, f);
        break;
    case TAPE_SIN:
    case TAPE_COS:
        enclose_sine(u, at->op == TAPE_SIN, order, f);
        break;
    case TAPE_TAN:
        circular_tangent(u, order, f);
        break;
    case TAPE_ASIN:
        set_range(f, round_down(asin(u->low)), round_up(asin(u->high)));
        inverse_function(u, -1, -0.5, order, f);
        break;
    case TAPE_ACOS:
        set_range(f, round_down(acos(u->high)), round_up(acos(u->low)));
        inverse_function(u, -1, -0.5, order, f);
        break;
    case TAPE_ATAN:
        set_range(f, round_down(atan(u->low)), round_up(atan(u->high)));
        inverse_function(u, 1, -1, order, f);
        break;
    case TAPE_SINH:
    case TAPE_COSH:
        enclose_hyperbolic_sine(u, at->op == TAPE_SINH, order, f);
        break;
    case TAPE_TANH:
        hyperbolic_tangent(u, order, f);
        break;
    case TAPE_EXP:
        fvi_enclosure_exponential(u, order, f);
        break;
    case TAPE_LOG:
        fvi_enclosure_logarithm(u, order, f);
        break;
    case TAPE_SQRT:
        fvi_enclosure_real_power(u, 0.5, order, f);
        break;
    case TAPE_ABS:
        enclose_absolute(u, order, f);
        break;
    case TAPE_SIGN:
        sign_of(u, order, f);
        break;
    case TAPE_MIN:
        smaller_of(u, w, order, f);
        break;
    case TAPE_MAX:
        larger_of(u, w, order, f);
        break;
    }
}

/* Return the operand at node i. A leaf is made when it is needed, because several nodes may need it. Every other result
 * stands on a stack until the single node that needs it takes it. */
static const enclosure *operand(const fvi_node *node, int i,
                                const enclosure *time, const double *k,
                                enclosure *leaf, enclosure **free_place)
{
    if (node[i].op == TAPE_COORDINATE)
        return time;
    if (node[i].op == TAPE_NUMBER || node[i].op == TAPE_PARAMETER) {
        set_number(leaf,
                   node[i].op == TAPE_NUMBER ? node[i].number : k[node[i].a]);
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
    enclosure time, few[MOST_NODES_ON_STACK], *many = few;
    if (n > MOST_NODES_ON_STACK && !(many = malloc(n * sizeof *many)))
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
    return half > 0 ? round_up(half) : 0;
}
