/* tests/bench/peers/taylor.c -- The Taylor series of the motion from step to step, for alpha = 1/2. [H 18]
 *
 * The coefficients come from automatic differentiation (A. Jorba, M. Zou, Experiment. Math. 14 (2005); heyoka: F.
 * Biscani, D. Izzo, Mon. Not. R. Astron. Soc. 504 (2021)).
 *
 *     (n + 1) (n + 2) m x_{n+2} = -g_n - rho (n + 1) x_{n+1},   g_n of U'(x(t)).
 *
 * As in heyoka a tolerance decides the order, and the last two coefficients decide the step. With steps of one
 * length the order is fixed. Rows are values of the series. */
#include "series.h"
#include "memory/history_kinds.h" /* FVI_VECTORS */
#include "system/larger.h"

#include <math.h>

typedef struct {
    series_term term;
    const double *params;
    double a[SERIES_MOST + 1], b[SERIES_MOST + 1]; /* 1/(m n (n - 1)), rho/(m n) */
    double x[SERIES_MOST + 1], room[2 * (SERIES_MOST + 1)];
    int order;
} taylor;

/* Compute the coefficients x_2, ..., x_order from x_0 and x_1. */
static void find_series(taylor *o)
{
    const series_term term = o->term;
    for (size_t n = 2; n <= (size_t)o->order; n++)
        o->x[n] = -o->a[n] * term(n - 2, o->x, o->room, o->params)
                  - o->b[n] * o->x[n - 1];
}

/* Compute sum_n x_n z^n for all z, a vector of them at a time. */
FVI_VECTORS static void evaluate_series(int order, const double *x, size_t count,
                                 const double *restrict z,
                                 double *restrict sum)
{
    for (int n = order; n >= 0; n--) {
        const double next = x[n];
#pragma omp simd
        for (size_t k = 0; k < count; k++)
            sum[k] = sum[k] * z[k] + next;
    }
}

/* Write the rows from t to t + h. r is the next row. Return the next row after them. */
static size_t write_rows(const taylor *o, const problem *p, double t, double h,
                         size_t r, double *rows)
{
    const double row = p->T / ROWS, slack = 1e-12 * p->T;
    double z[ROWS + 1];
    size_t count = 0;
    for (; r + count <= ROWS && row * (double)(r + count) <= t + h + slack; count++) {
        z[count] = row * (double)(r + count) - t;
        rows[r + count] = 0;
    }
    evaluate_series(o->order, o->x, count, z, rows + r);
    return r + count;
}

/* Compute x and x' at the end of a step of length h. */
static void advance(taylor *o, double h)
{
    double x = 0, v = 0;
    for (int n = o->order; n >= 1; n--) {
        x = (x + o->x[n]) * h;
        v = v * h + n * o->x[n];
    }
    o->x[0] += x;
    o->x[1] = v;
}

/* Return e^-2 times the radius that the last two coefficients indicate, with heyoka's safety factor. */
static double step_of(const taylor *o)
{
    const int n = o->order;
    const double size = larger(1, fabs(o->x[0])),
                 last = log(size / fabs(o->x[n])) / n,
                 before = log(size / fabs(o->x[n - 1])) / (n - 1);
    return exp(smaller(last, before) - 2 - 0.7 / (n - 1));
}

/* Make N steps of one length; N = 0: the series decides the steps. x' has the order `asked`, x one more. */
static int run(const task *of, int asked, size_t N, double *rows)
{
    const problem *p = of->p;
    const int order = asked + 1;
    const double m = p->system.mass[0];
    taylor o;
    o.term = series_of(p);
    o.params = p->system.potential.params;
    o.order = order;
    o.x[0] = rows[0] = p->x0[0];
    o.x[1] = p->p0[0] / m;
    for (int n = 2; n <= order; n++) {
        o.a[n] = 1 / (m * n * (n - 1));
        o.b[n] = p->system.damping[0] / (m * n);
    }
    size_t r = 1;
    double t = 0;
    for (size_t k = 0; r <= ROWS; k++) {
        find_series(&o);
        const double h = N ? p->T / (double)N : step_of(&o);
        if (!(h > 1e-12 * p->T))
            return FVI_EMAXITER;
        r = write_rows(&o, p, t, h, r, rows);
        advance(&o, h);
        t = N ? p->T * (double)(k + 1) / (double)N : t + h;
    }
    return FVI_SUCCESS;
}

static int run_controlled(const task *of, double *rows)
{
    const double least = larger(of->tolerance, 1e-16);
    return run(of, (int)ceil(1 - log(least) / 2), 0, rows);
}

static int takes(const problem *p)
{
    return p->alpha == 0.5 && !p->system.force.value && series_of(p);
}

#define WHY "its steps are long, as the derivatives of U are given to it"
const peer peer_taylor = {
    "Taylor series", "Biscani, Izzo 2021; heyoka", WHY, 1, 0, 0, takes,
    run_controlled
};
#define TAYLOR(order)                                                          \
    static int run_##order(const task *of, double *rows)                       \
    {                                                                          \
        return run(of, order, of->N, rows);                                    \
    }                                                                          \
    const peer peer_taylor_##order = {                                         \
        "Taylor series, order " #order,                                        \
        "Jorba, Zou 2005",                                                     \
        WHY ", and all are of one length",                                     \
        0,                                                                     \
        4,                                                                     \
        1,                                                                     \
        takes,                                                                 \
        run_##order                                                            \
    };
TAYLOR(4)
TAYLOR(6)
TAYLOR(8)
TAYLOR(12)
TAYLOR(16)
TAYLOR(24)
