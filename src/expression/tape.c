/* src/expression/tape.c -- Values and derivatives along a tape.            [H 9] */
#include "tape.h"

#include <math.h>
#include <string.h>

const char *const fvi_tape_functions[] = { "sin",  "cos",  "tan",  "asin",
                                           "acos", "atan", "sinh", "cosh",
                                           "tanh", "exp",  "log",  "sqrt",
                                           "abs",  "sign", "min",  "max",
                                           NULL };

/* f, f' and f'' at u; a function that is not defined there has no derivative either. */
static inline void function(fvi_operation op, double u, const int order,
                            double f[3])
{
    switch (op) {
    case TAPE_SIN:
        f[0] = sin(u);
        f[1] = order > 0 ? cos(u) : 0;
        f[2] = -f[0];
        break;
    case TAPE_COS:
        f[0] = cos(u);
        f[1] = order > 0 ? -sin(u) : 0;
        f[2] = -f[0];
        break;
    case TAPE_TAN:
        f[0] = tan(u);
        f[1] = 1 + f[0] * f[0];
        f[2] = 2 * f[0] * f[1];
        break;
    case TAPE_ASIN:
    case TAPE_ACOS:
        f[0] = op == TAPE_ASIN ? asin(u) : acos(u);
        f[1] = (op == TAPE_ASIN ? 1 : -1) / sqrt((1 - u) * (1 + u));
        f[2] = u * f[1] / ((1 - u) * (1 + u));
        break;
    case TAPE_ATAN:
        f[0] = atan(u);
        f[1] = 1 / (1 + u * u);
        f[2] = -2 * u * f[1] * f[1];
        break;
    case TAPE_SINH:
        f[0] = f[2] = sinh(u);
        f[1] = order > 0 ? cosh(u) : 0;
        break;
    case TAPE_COSH:
        f[0] = f[2] = cosh(u);
        f[1] = order > 0 ? sinh(u) : 0;
        break;
    case TAPE_TANH: /* 1 - tanh^2 would lose the digits of a small slope */
        f[0] = tanh(u);
        f[1] = order > 0 ? 1 / (cosh(u) * cosh(u)) : 0;
        f[2] = -2 * f[0] * f[1];
        break;
    case TAPE_EXP:
        f[0] = f[1] = f[2] = exp(u);
        break;
    case TAPE_LOG:
        f[0] = log(u);
        f[1] = u >= 0 ? 1 / u : NAN;
        f[2] = -f[1] / u;
        break;
    case TAPE_SQRT:
        f[0] = sqrt(u);
        f[1] = 0.5 / f[0];
        f[2] = -0.5 * f[1] / u;
        break;
    case TAPE_SIGN:
        f[0] = isnan(u) ? u : (u > 0) - (u < 0);
        f[1] = f[2] = 0;
        break;
    default: /* TAPE_ABS */
        f[0] = fabs(u);
        f[1] = (u > 0) - (u < 0);
        f[2] = 0;
    }
}

static inline fvi_jet mean(fvi_jet u, fvi_jet w)
{
    return (fvi_jet){ (u.v + w.v) / 2, (u.a + w.a) / 2, (u.b + w.b) / 2,
                      (u.c + w.c) / 2 };
}

/* The smaller of two, or the larger. Where both are alike their derivatives are the mean, as
 * those of abs(u) = max(u, -u) are 0 at 0. NaN stays NaN. */
static inline fvi_jet extreme(fvi_operation op, fvi_jet u, fvi_jet w)
{
    if (u.v < w.v)
        return op == TAPE_MIN ? u : w;
    return u.v > w.v ? (op == TAPE_MIN ? w : u) : mean(u, w);
}

/* u to a whole power n >= 2, by multiplication. */
static inline void whole_power(double u, int n, double f[3])
{
    double rest = 1; /* u^(n - 2) */
    double square = u;
    for (int left = n - 2; left > 0; left >>= 1, square *= square)
        if (left & 1)
            rest *= square;
    f[0] = rest * u * u;
    f[1] = n * rest * u;
    f[2] = (double)n * (n - 1) * rest;
}

static inline fvi_jet chain(const double f[3], fvi_jet u)
{
    return (fvi_jet){ f[0], f[1] * u.a, f[1] * u.b,
                      f[2] * u.a * u.b + f[1] * u.c };
}

/* u^w; by w only where w varies, as log u asks for u > 0. */
static fvi_jet power(fvi_jet u, fvi_jet w)
{
    const double v = pow(u.v, w.v), n = w.v;
    const double by_u = n != 0 ? n * pow(u.v, n - 1) : 0;
    const double f[3] = { v, by_u,
                          n != 0 && n != 1 ? n * (n - 1) * pow(u.v, n - 2)
                                           : 0 };
    fvi_jet r = chain(f, u);
    if (w.a != 0 || w.b != 0 || w.c != 0) {
        const double l = log(u.v), mixed = pow(u.v, n - 1) * (1 + n * l);
        r.a += v * l * w.a;
        r.b += v * l * w.b;
        r.c += mixed * (u.a * w.b + u.b * w.a) + v * l * l * w.a * w.b
               + v * l * w.c;
    }
    return r;
}

/* What is compiled into each walk: with a constant order (0: v; 1: v, a; 2: all) the
 * compiler leaves out what is not wanted. */
#define INTO_THE_WALK __attribute__((always_inline)) static inline

INTO_THE_WALK fvi_jet operate(const fvi_node *at, fvi_jet u, fvi_jet w,
                              const int order)
{
    double f[3];
    switch (at->op) {
    case TAPE_ADD:
        return (fvi_jet){ u.v + w.v, u.a + w.a, u.b + w.b, u.c + w.c };
    case TAPE_SUBTRACT:
        return (fvi_jet){ u.v - w.v, u.a - w.a, u.b - w.b, u.c - w.c };
    case TAPE_MULTIPLY:
        return (fvi_jet){ u.v * w.v, u.a * w.v + u.v * w.a,
                          u.b * w.v + u.v * w.b,
                          u.c * w.v + u.a * w.b + u.b * w.a + u.v * w.c };
    case TAPE_DIVIDE: { /* from u = q w */
        fvi_jet q = { .v = u.v / w.v };
        q.a = (u.a - q.v * w.a) / w.v;
        q.b = (u.b - q.v * w.b) / w.v;
        q.c = (u.c - q.a * w.b - q.b * w.a - q.v * w.c) / w.v;
        return q;
    }
    case TAPE_NEGATE:
        return (fvi_jet){ -u.v, -u.a, -u.b, -u.c };
    case TAPE_POWER:
        return order > 0 ? power(u, w) : (fvi_jet){ .v = pow(u.v, w.v) };
    case TAPE_WHOLE_POWER:
        whole_power(u.v, (int)at->number, f);
        return chain(f, u);
    case TAPE_MIN:
    case TAPE_MAX:
        return extreme(at->op, u, w);
    default:
        function(at->op, u.v, order, f);
        return chain(f, u);
    }
}

INTO_THE_WALK fvi_jet fetch(const double *v, const double *a, const double *b,
                            const double *c, int i, const int order)
{
    return (fvi_jet){ v[i], order > 0 ? a[i] : 0, order > 1 ? b[i] : 0,
                      order > 1 ? c[i] : 0 };
}

INTO_THE_WALK fvi_jet walk(const fvi_node *node, size_t n, const double *x,
                           const double *k, int i, int j, const int order)
{
    double v[n], a[order > 0 ? n : 1], b[order > 1 ? n : 1],
        c[order > 1 ? n : 1]; /* n <= FVI_TAPE_LONGEST */
    fvi_jet r = { 0, 0, 0, 0 };
    for (size_t m = 0; m < n; m++) {
        const fvi_node *at = &node[m];
        if (at->op == TAPE_NUMBER)
            r = (fvi_jet){ at->number, 0, 0, 0 };
        else if (at->op == TAPE_COORDINATE)
            r = (fvi_jet){ x[at->a], at->a == i, at->a == j, 0 };
        else if (at->op == TAPE_PARAMETER)
            r = (fvi_jet){ k[at->a], -1 - at->a == i, -1 - at->a == j, 0 };
        else
            r = operate(at, fetch(v, a, b, c, at->a, order),
                        fetch(v, a, b, c, at->b, order), order);
        v[m] = r.v;
        if (order > 0)
            a[m] = r.a;
        if (order > 1) {
            b[m] = r.b;
            c[m] = r.c;
        }
    }
    return r;
}

double fvi_tape_value(const fvi_node *node, size_t n, const double *x,
                      const double *k)
{
    return walk(node, n, x, k, 0, 0, 0).v;
}

fvi_jet fvi_tape_slope(const fvi_node *node, size_t n, const double *x,
                       const double *k, int i)
{
    return walk(node, n, x, k, i, i, 1);
}

fvi_jet fvi_tape_second_derivative(const fvi_node *node, size_t n, const double *x,
                      const double *k, int i, int j)
{
    return walk(node, n, x, k, i, j, 2);
}
