/* tests/bench/peers/product.c -- The equation of motion integrated twice, by methods of order 2. [H 18]
 *
 *     m (x - x0 - t v0) = J^2 (F - grad U(x)) - rho J^gamma (x - s),         (18.4)
 *
 * with gamma = 2 - 2 alpha. For Caputo's past s = x0, or x0 + t v0 if 2 alpha > 1; for Riemann and Liouville's
 * past with 2 alpha < 1 s = 0. The quadratures of order 2 on N steps are
 *
 *   product trapezoid: J^gamma of the piecewise linear function (K. Diethelm, N. J.
 *     Ford, A. D. Freed, Numer. Algorithms 36 (2004); R. Garrappa, Mathematics 6
 *     (2018)). Its weights for J^2 are two running sums;
 *   FLMM2: J^gamma by the fractional linear multistep methods of the trapezoidal rule,
 *     of Newton and Gregory, and of BDF2, with the starting weights that make them
 *     exact for 1 and t (Ch. Lubich, SIAM J. Math. Anal. 17 (1986); R. Garrappa, Math.
 *     Comput. Simul. 110 (2015), whose code is for one order at most 1), and J^2 as in the
 *     product trapezoid.
 *
 * Where F jumps it is the mean of both limits. One mass is solved by Newton's method, in product_one.c; more
 * masses by the fixed-point iteration, if it contracts. Both start from a guess by quadratic extrapolation. */
#include "blocks.h"
#include "peers.h"
#include "product_one.h"
#include "system/larger.h"

#include <gsl/gsl_math.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
    const problem *p;
    size_t d, N;
    double gamma, h, size;       /* size = h^gamma */
    double *w, *start0, *start1; /* w_n; the weights of u_0 and of u_1 in the sum for n */
    double *x[4];                /* the last three positions, and the new one */
    double *I1, *I2, *g, *F, *r, *sum, *u, *first, *one, *grad;
    blocks *past;
} solver;

/* ---- steps ---- */

static int force(solver *o, double t)
{
    const fvi_force *f = &o->p->system.force;
    if (!f->value)
        return FVI_SUCCESS;
    int status = f->value(t, o->d, f->params, o->F);
    if (status || fabs(t - o->p->jump) > 1e-9 * o->h || o->p->jump == 0)
        return status;
    status = f->value(t * (1 + 1e-9), o->d, f->params, o->grad);
    if (!status)
        status = f->value(t * (1 - 1e-9), o->d, f->params, o->F);
    for (size_t a = 0; a < o->d; a++)
        o->F[a] = (o->F[a] + o->grad[a]) / 2;
    return status;
}

/* Solve (m + rho A) x + B grad U(x) = r + B F, B = h^2/6. */
static int solve(solver *o, double A)
{
    const fvi_system *s = &o->p->system;
    const double B = o->h * o->h / 6;
    double *x = o->x[3], before = GSL_POSINF;
    for (int i = 0; i < 60; i++) {
        double moved = 0, largest = 1e-30;
        const int status = fvi_potential_gradient(s, x, o->grad);
        if (status)
            return status;
        for (size_t a = 0; a < o->d; a++) {
            const double M = s->mass[a] + s->damping[a] * A,
                         by = (o->r[a] + B * (o->F[a] - o->grad[a]) - M * x[a])
                              / M;
            x[a] += by;
            moved = larger(moved, fabs(by));
            largest = larger(largest, fabs(x[a]));
        }
        moved /= largest;
        if (moved < 1e-15 || (moved < 1e-13 && moved >= before))
            return FVI_SUCCESS;
        if (!(moved < 1e6) || (i > 5 && moved > 2 * before))
            break;
        before = moved;
    }
    return FVI_EMAXITER;
}

/* Return s at t. The memory is of u = x - s. */
static double line(const solver *o, size_t a, double t)
{
    if (o->p->past == FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE)
        return 0;
    return o->p->x0[a]
           + (o->p->alpha > 0.5 ? t * o->p->p0[a] / o->p->system.mass[a] : 0);
}

/* Add g = F - grad U(x) at the new position to the running sums, and u to the memory. */
static int update_history(solver *o, size_t n, double t)
{
    const double h = o->h;
    int status = fvi_potential_gradient(&o->p->system, o->x[3], o->grad);
    for (size_t a = 0; a < o->d && !status; a++) {
        const double g = o->F[a] - o->grad[a];
        if (n > 0) {
            o->I2[a] += h * h / 6 * g;
            o->I1[a] += h / 2 * (o->g[a] + g);
        }
        o->g[a] = g;
        o->u[a] = o->x[3][a] - line(o, a, t);
        if (n <= 1)
            (n ? o->one : o->first)[a] = o->u[a];
    }
    if (n > 0 && !status)
        blocks_push(o->past, n, o->u);
    double *oldest = o->x[0];
    o->x[0] = o->x[1];
    o->x[1] = o->x[2];
    o->x[2] = o->x[3];
    o->x[3] = oldest;
    return status;
}

static int step(solver *o, size_t n)
{
    const fvi_system *s = &o->p->system;
    const double h = o->h, t = h * (double)n,
                 A = o->size * (o->w[0] + (n == 1 ? o->start1[1] : 0));
    int status = blocks_sum(o->past, n, o->sum) ? FVI_ENOMEM : force(o, t);
    for (size_t a = 0; a < o->d && !status; a++) {
        const double past = o->sum[a] + o->start0[n] * o->first[a]
                            + (n > 1 ? o->start1[n] * o->one[a] : 0);
        o->I2[a] += h * o->I1[a] + h * h / 3 * o->g[a];
        o->r[a] = s->mass[a] * o->p->x0[a] + t * o->p->p0[a] + o->I2[a]
                  + s->damping[a] * (A * line(o, a, t) - o->size * past);
        o->x[3][a] =
            n < 3 ? o->x[2][a] : 3 * (o->x[2][a] - o->x[1][a]) + o->x[0][a];
    }
    if (!status)
        status = solve(o, A);
    return status ? status : update_history(o, n, t);
}

static int run(const task *of, rule which, double *rows)
{
    const problem *p = of->p;
    const size_t d = p->system.d, N = of->N, n = 3 * (N + 1);
    if (d == 1)
        return product_one(of, which, 0, rows);
    solver o = { .p = p, .d = d, .N = N, .gamma = 2 - 2 * p->alpha };
    o.h = p->T / (double)N;
    o.size = pow(o.h, o.gamma);
    o.w = calloc(n + 14 * d, sizeof *o.w);
    if (!o.w)
        return FVI_ENOMEM;
    o.start0 = o.w + N + 1;
    o.start1 = o.start0 + N + 1;
    double **parts[] = { &o.x[0], &o.x[1],  &o.x[2], &o.x[3], &o.I1,
                         &o.I2,   &o.g,     &o.F,    &o.r,    &o.sum,
                         &o.u,    &o.first, &o.one,  &o.grad };
    for (size_t i = 0; i < 14; i++)
        *parts[i] = o.w + n + i * d;
    product_weights(which, o.gamma, N, o.w, o.start0, o.start1);
    o.past = blocks_alloc(o.w, N, d);
    int status = o.past ? force(&o, 0) : FVI_ENOMEM;
    memcpy(o.x[3], p->x0, d * sizeof *rows);
    memcpy(rows, p->x0, d * sizeof *rows);
    if (!status)
        status = update_history(&o, 0, 0);
    for (size_t k = 1; k <= N && !status; k++) {
        status = step(&o, k);
        if (k % (N / ROWS) == 0)
            memcpy(rows + k / (N / ROWS) * d, o.x[2], d * sizeof *rows);
    }
    blocks_free(o.past);
    free(o.w);
    return status;
}

static int any(const problem *p)
{
    (void)p;
    return 1;
}

#define RULE(name, words, rule, after)                                         \
    static int run_##name(const task *t, double *rows)                         \
    {                                                                          \
        return run(t, rule, rows);                                             \
    }                                                                          \
    const peer peer_##name = {                                                 \
        words,                                                                 \
        after,                                                                 \
        "a step is one short sum, as long as the steps are few",               \
        0,                                                                     \
        ROWS,                                                                  \
        0,                                                                     \
        any,                                                                   \
        run_##name                                                             \
    };
RULE(product, "product trapezoid", PRODUCT, "Diethelm, Ford, Freed 2004")
RULE(flmm_trapezoidal, "FLMM2 trapezoidal", TRAPEZOIDAL, "Garrappa 2015")
RULE(flmm_newton, "FLMM2 Newton-Gregory", NEWTON_GREGORY, "Garrappa 2015")
RULE(flmm_bdf2, "FLMM2 BDF2", BDF2, "Garrappa 2015")

static int run_flmm_modes(const task *t, double *rows)
{
    return product_one(t, TRAPEZOIDAL, 1, rows);
}

static int one_mass(const problem *p)
{
    return p->system.d == 1;
}

const peer peer_flmm_modes = { "FLMM2 trapezoidal, modes",
                               "Garrappa 2015; Lopez-Fernandez, Lubich, Schaedle 2008",
                               "a step is one short sum over modes",
                               1,
                               ROWS,
                               0,
                               one_mass,
                               run_flmm_modes };
