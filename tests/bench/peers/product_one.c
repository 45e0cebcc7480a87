/* tests/bench/peers/product_one.c -- The methods of product.c for one mass. [H 18]
 *
 * All numbers of a step stay in registers, F is evaluated once in a step, and Newton's method makes only the
 * iterations that order 2 needs. FLMM2's trapezoid is also available with its past as exponentials. */
#include "product_one.h"
#include "blocks.h"
#include "flmm_modes.h"

#include <math.h>
#include <stdlib.h>

PEER_SCALAR

typedef struct {
    const problem *p;
    double h, A0, A1; /* h^gamma w_0; the same including the weight of u_1 in its own step */
    double *w, *start0, *start1;
    blocks *past;
    flmm_modes *modes; /* replaces blocks if it is not NULL */
    int linear;
} solver;

/* Compute F, the mean of both limits where it jumps. */
static int force(const solver *o, double t, double *F)
{
    const fvi_force *f = &o->p->system.force;
    *F = 0;
    if (!f->value)
        return FVI_SUCCESS;
    if (o->p->jump == 0 || fabs(t - o->p->jump) > 1e-9 * o->h)
        return f->value(t, 1, f->params, F);
    double after;
    const int status = f->value(t * (1 + 1e-9), 1, f->params, &after)
                       | f->value(t * (1 - 1e-9), 1, f->params, F);
    *F = (*F + after) / 2;
    return status;
}

/* Solve M x + B U'(x) = r by Newton's method. *g: U'(x) of the last iteration. After a correction below 1e-6
 * the error is 1e-12. */
static int solve(const solver *o, double M, double B, double r, double *x,
                 double *g)
{
    const fvi_potential *U = &o->p->system.potential;
    for (int i = 0; i < 60; i++) {
        double curvature;
        const int status = U->gradient(1, x, U->params, g)
                           | U->hessian(1, x, U->params, &curvature);
        const double by = (r - B * *g - M * *x) / (M + B * curvature);
        *x += by;
        *g += curvature * by;
        if (status || !(fabs(by) < 1e100))
            return FVI_EMAXITER;
        if (o->linear || fabs(by) < 1e-6 * fabs(*x) || fabs(by) < 1e-15)
            return FVI_SUCCESS;
    }
    return FVI_EMAXITER;
}

static int past(const solver *o, size_t n, double *sum)
{
    if (!o->modes)
        return blocks_sum(o->past, n, sum) ? FVI_ENOMEM : FVI_SUCCESS;
    *sum = flmm_modes_sum(o->modes);
    return FVI_SUCCESS;
}

static int walk(const solver *o, size_t N, double size, double *rows)
{
    const problem *p = o->p;
    const int rl = p->past == FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE;
    const double h = o->h, m = p->system.mass[0], rho = p->system.damping[0],
                 B = h * h / 6, x0 = p->x0[0], p0 = p->p0[0], u0 = rl ? x0 : 0,
                 line = rl ? 0 : x0, slope = !rl && p->alpha > 0.5 ? p0 / m : 0;
    const size_t every = N / ROWS;
    double x = x0, before = x0, oldest = x0, I1 = 0, I2 = 0, F, g, u1 = 0;
    int status = force(o, 0, &F)
                 | p->system.potential.gradient(1, &x, p->system.potential.params, &g);
    g = F - g;
    rows[0] = x0;
    for (size_t n = 1; n <= N && !status; n++) {
        const double t = h * (double)n, A = n == 1 ? o->A1 : o->A0,
                     s = line + slope * t;
        double sum, spring_force, new = n < 3 ? x : 3 * (x - before) + oldest;
        status = force(o, t, &F) | past(o, n, &sum);
        sum += o->start0[n] * u0 + (n > 1 ? o->start1[n] * u1 : 0);
        I2 += h * I1 + 2 * B * g;
        status |= solve(o, m + rho * A, B,
                        m * x0 + t * p0 + I2 + rho * (A * s - size * sum) + B * F,
                        &new, &spring_force);
        oldest = before;
        before = x;
        x = new;
        const double u = x - s;
        I2 += B * (F - spring_force);
        I1 += h / 2 * (g + F - spring_force);
        g = F - spring_force;
        u1 = n == 1 ? u : u1;
        if (o->modes)
            flmm_modes_push(o->modes, u);
        else
            blocks_push(o->past, n, &u);
        if (n % every == 0)
            rows[n / every] = x;
    }
    return status ? FVI_EMAXITER : FVI_SUCCESS;
}

int product_one(const task *of, rule which, int by_modes, double *rows)
{
    const problem *p = of->p;
    const fvi_potential *U = &p->system.potential;
    const size_t N = of->N;
    const double gamma = 2 - 2 * p->alpha, h = p->T / (double)N,
                 size = pow(h, gamma);
    solver o = { .p = p, .h = h };
    o.linear = U->quadratic && U->quadratic(U->params);
    o.w = malloc(3 * (N + 1) * sizeof *o.w);
    if (!o.w)
        return FVI_ENOMEM;
    o.start0 = o.w + N + 1;
    o.start1 = o.start0 + N + 1;
    for (size_t n = 0; n <= N; n++)
        o.start0[n] = o.start1[n] = 0;
    product_weights(which, gamma, N, o.w, o.start0, o.start1);
    o.A0 = size * o.w[0];
    o.A1 = size * (o.w[0] + o.start1[1]);
    if (by_modes)
        o.modes = flmm_modes_alloc(gamma, N, of->tolerance);
    else
        o.past = blocks_alloc(o.w, N, 1);
    const int status = o.modes || o.past ? walk(&o, N, size, rows) : FVI_ENOMEM;
    flmm_modes_free(o.modes);
    blocks_free(o.past);
    free(o.w);
    return status;
}
