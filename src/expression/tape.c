/* src/expression/tape.c -- Compute values and derivatives along a tape.            [H 9] */
#include "tape.h"

#include "tape_lanes.h"
#include "system/vectors.h"

#include <math.h>
#include <string.h>

const char *const fvi_tape_functions[] = { "sin",  "cos",  "tan",  "asin",
                                           "acos", "atan", "sinh", "cosh",
                                           "tanh", "exp",  "log",  "sqrt",
                                           "abs",  "sign", "min",  "max",
                                           NULL };

/* Compute f, f' and f'' at u. Where a function is not defined, its derivatives are not defined either. */
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

/* Return the smaller or the larger of two. If both are equal, the derivatives are the mean: for example, those of
 * abs(u) = max(u, -u) are 0 at 0. NaN stays NaN. */
static inline fvi_jet minimum_or_maximum(fvi_operation op, fvi_jet u, fvi_jet w)
{
    if (u.v < w.v)
        return op == TAPE_MIN ? u : w;
    return u.v > w.v ? (op == TAPE_MIN ? w : u) : mean(u, w);
}

/* u^n for n >= 0 by repeated squaring. The lowest powers are written out, because the compiler would not unroll the
 * loop. */
static inline double power_by_squaring(double u, int n)
{
    double power = 1, square = u;
    if (n < 3)
        return n == 0 ? 1 : n == 1 ? u : u * u;
    for (int left = n; left > 0; left >>= 1, square *= square)
        if (left & 1)
            power *= square;
    return power;
}

/* Compute a whole power n >= 2 of u and its derivatives by multiplication. */
static inline void whole_power(double u, int n, double f[3])
{
    const double rest = power_by_squaring(u, n - 2);
    f[0] = rest * u * u;
    f[1] = n * rest * u;
    f[2] = (double)n * (n - 1) * rest;
}

static inline fvi_jet apply_chain_rule(const double f[3], fvi_jet u)
{
    return (fvi_jet){ f[0], f[1] * u.a, f[1] * u.b,
                      f[2] * u.a * u.b + f[1] * u.c };
}

/* Compute u^w. The derivatives by w are computed only if w varies, because log u needs u > 0. */
static inline fvi_jet power(fvi_jet u, fvi_jet w)
{
    const double v = pow(u.v, w.v), n = w.v;
    const double by_u = n != 0 ? n * pow(u.v, n - 1) : 0;
    const double f[3] = { v, by_u,
                          n != 0 && n != 1 ? n * (n - 1) * pow(u.v, n - 2)
                                           : 0 };
    fvi_jet r = apply_chain_rule(f, u);
    if (w.a != 0 || w.b != 0 || w.c != 0) {
        const double l = log(u.v), mixed = pow(u.v, n - 1) * (1 + n * l);
        r.a += v * l * w.a;
        r.b += v * l * w.b;
        r.c += mixed * (u.a * w.b + u.b * w.a) + v * l * l * w.a * w.b
               + v * l * w.c;
    }
    return r;
}

/* These functions are compiled into each walk. With a constant order (0: v; 1: v and a; 2: all) the compiler leaves out
 * what is not needed. */
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
    case TAPE_DIVIDE: { /* the derivatives follow from u = q w */
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
        return apply_chain_rule(f, u);
    case TAPE_MIN:
    case TAPE_MAX:
        return minimum_or_maximum(at->op, u, w);
    default:
        function(at->op, u.v, order, f);
        return apply_chain_rule(f, u);
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

/* ---- several places at once ---- */

enum { L = FVI_MOST_LANES };

/* A node in each lane: its value, and its first and second derivative by the coordinate. */
typedef struct {
    double v[L], a[L], c[L];
} lanes_of_node;

INTO_THE_WALK fvi_jet jet_of(const lanes_of_node *u, size_t l, const int order)
{
    return (fvi_jet){ u->v[l], order > 0 ? u->a[l] : 0, order > 1 ? u->a[l] : 0,
                      order > 1 ? u->c[l] : 0 };
}

INTO_THE_WALK void store_jet(lanes_of_node *to, size_t l, fvi_jet r, const int order)
{
    to->v[l] = r.v;
    if (order > 0) {
        to->a[l] = r.a;
        to->c[l] = r.c;
    }
}

/* Do one operation in all lanes. It becomes a vector operation if it consists of + - * /. */
INTO_THE_WALK void operate_in_a_vector(const fvi_node *at, const lanes_of_node *u,
                                       const lanes_of_node *w, lanes_of_node *to, const int order)
{
#pragma omp simd
    for (size_t l = 0; l < L; l++)
        store_jet(to, l, operate(at, jet_of(u, l, order), jet_of(w, l, order), order), order);
}

INTO_THE_WALK int is_same_number(const double *u, size_t l)
{
    return memcmp(u + l, u + l - 1, sizeof *u) == 0;
}

/* Return nonzero if lane l is equal to the lane before it. */
INTO_THE_WALK int is_same(const lanes_of_node *u, size_t l, const int order)
{
    return is_same_number(u->v, l)
           && (order == 0 || (is_same_number(u->a, l) && is_same_number(u->c, l)));
}

/* Call a function of the C library for each lane, except if the lane before had the same argument. For example, cos(w
 * t) is a single call for all lanes. */
INTO_THE_WALK void operate_one_by_one(const fvi_node *at, const lanes_of_node *u,
                                      const lanes_of_node *w, lanes_of_node *to, const int order)
{
    for (size_t l = 0; l < L; l++) {
        const int is_known = l > 0 && is_same(u, l, order) && is_same(w, l, order);
        store_jet(to, l,
                  is_known ? jet_of(to, l - 1, order)
                          : operate(at, jet_of(u, l, order), jet_of(w, l, order), order),
                  order);
    }
}

/* In each case the compiler knows the operation and the exponent. */
#define IN_A_VECTOR(OP, NUMBER)                                                                    \
    do {                                                                                           \
        const fvi_node is = { .op = (OP), .number = (NUMBER) };                                    \
        operate_in_a_vector(&is, u, w, to, order);                                                 \
        return;                                                                                    \
    } while (0)

INTO_THE_WALK void operate_lanes(const fvi_node *at, const lanes_of_node *u, const lanes_of_node *w,
                                 lanes_of_node *to, const int order)
{
    switch (at->op) {
    case TAPE_ADD:
        IN_A_VECTOR(TAPE_ADD, 0);
    case TAPE_SUBTRACT:
        IN_A_VECTOR(TAPE_SUBTRACT, 0);
    case TAPE_MULTIPLY:
        IN_A_VECTOR(TAPE_MULTIPLY, 0);
    case TAPE_DIVIDE:
        IN_A_VECTOR(TAPE_DIVIDE, 0);
    case TAPE_NEGATE:
        IN_A_VECTOR(TAPE_NEGATE, 0);
    case TAPE_WHOLE_POWER:
        if (at->number == 2)
            IN_A_VECTOR(TAPE_WHOLE_POWER, 2);
        if (at->number == 3)
            IN_A_VECTOR(TAPE_WHOLE_POWER, 3);
        if (at->number == 4)
            IN_A_VECTOR(TAPE_WHOLE_POWER, 4);
        break;
    default:
        break;
    }
    operate_one_by_one(at, u, w, to, order);
}

/* Fill in v of each lane; the first derivative is the same in all lanes, and the second is 0. */
INTO_THE_WALK void fill(lanes_of_node *to, const double *v, double a, const int order)
{
#pragma omp simd
    for (size_t l = 0; l < L; l++)
        store_jet(to, l, (fvi_jet){ v[l], a, a, 0 }, order);
}

INTO_THE_WALK void fill_with_number(lanes_of_node *to, double v, const int order)
{
#pragma omp simd
    for (size_t l = 0; l < L; l++)
        store_jet(to, l, (fvi_jet){ v, 0, 0, 0 }, order);
}

INTO_THE_WALK void walk_lanes(const fvi_node *node, size_t n, const double *x, const double *k,
                              lanes_of_node *at, const int order)
{
    for (size_t m = 0; m < n; m++) {
        if (node[m].op == TAPE_NUMBER)
            fill_with_number(at + m, node[m].number, order);
        else if (node[m].op == TAPE_COORDINATE)
            fill(at + m, x, 1, order);
        else if (node[m].op == TAPE_PARAMETER)
            fill(at + m, k + (size_t)node[m].a * L, 0, order);
        else
            operate_lanes(node + m, at + node[m].a, at + node[m].b, at + m, order);
    }
}

FVI_VECTORS static void walk_lane_values(const fvi_node *node, size_t n, const double *x,
                                         const double *k, lanes_of_node *at)
{
    walk_lanes(node, n, x, k, at, 0);
}

FVI_VECTORS static void walk_lane_jets(const fvi_node *node, size_t n, const double *x,
                                       const double *k, lanes_of_node *at)
{
    walk_lanes(node, n, x, k, at, 2);
}

void fvi_tape_lanes(const fvi_node *node, size_t n, const double *x, const double *k, double *v,
                    double *a, double *c)
{
    lanes_of_node at[n]; /* n <= FVI_TAPE_LANES_LONGEST */
    if (a)
        walk_lane_jets(node, n, x, k, at);
    else
        walk_lane_values(node, n, x, k, at);
    memcpy(v, at[n - 1].v, sizeof at->v);
    if (!a)
        return;
    memcpy(a, at[n - 1].a, sizeof at->a);
    memcpy(c, at[n - 1].c, sizeof at->c);
}
