/* tests/bench/peers/l21sigma.c -- The fast L2-1_sigma formula, order 2 on uniform steps. [H 18]
 *
 * For 0 < b < 1 and sigma = 1 - b/2, D^b u at t_{n + sigma} is the derivative of quadratics through three nodes
 * each, and of a line in the last piece (A. A. Alikhanov, J. Comput. Phys. 280 (2015)). The part of the integral
 * before t_n is a sum of exponentials (Y. Yan, Z.-Z. Sun, J. Zhang, Commun. Comput. Phys. 22 (2017)). Here u = x
 * and b = 2 alpha, or u = v and b = 2 alpha - 1. x' = v and m v' at t_{n + sigma} come from the slope of the
 * parabola through three nodes. */
#include "ends.h"
#include "memory/history_kinds.h" /* FVI_VECTORS */
#include "peers.h"
#include "system/larger.h"

#include <gsl/gsl_math.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
    const problem *p;
    size_t d, Q;
    int of_v, linear;
    double b, sigma, h, scale; /* 1 / Gamma(1 - b) */
    double *om, *decay, *near,
        *far;               /* the modes: weights, e^{-s h}, factors of two differences */
    double local, implicit; /* sum om near, of the line; sum om far */
    double *z, *x[3], *v[3], *F, *grad, *at, *r;
} solver;

/* t^{-b} = 1 / Gamma(b) int s^b e^{-s t} d ln s. z = int_0^{t_n} u' e^{-s (t_n - tau)}, where u' is linear in
 * each piece: its value is (u_{n+1} - u_n) / h at n + 1/2, and so on. */
static int modes(solver *o, double tolerance)
{
    const double digits = -log(larger(tolerance, 1e-15)), h = o->h,
                 L = 9.87 / (digits + 2),
                 first = exp(-L * APART * (ENDS - 1) / 2.0
                             - larger(0, digits - 6.6) / ENDS)
                         / o->p->T,
                 last = (digits + 4) / (o->sigma * h);
    double c[ENDS];
    o->Q = (size_t)larger(APART * ENDS, ceil(log(last / first) / L));
    o->om = calloc(o->Q * (4 + o->d), sizeof *o->om);
    if (!o->om)
        return FVI_ENOMEM;
    o->decay = o->om + o->Q;
    o->near = o->decay + o->Q;
    o->far = o->near + o->Q;
    o->z = o->far + o->Q;
    ends(L, o->b, c);
    for (size_t q = 0; q < o->Q; q++) {
        const double s = first * exp(L * (double)q), y = s * h;
        o->om[q] =
            L * pow(s, o->b) / tgamma(o->b) * o->scale * exp(-o->sigma * y);
        if (q % APART == 0 && q / APART < ENDS)
            o->om[q] += L * pow(first, o->b) / tgamma(o->b) * o->scale
                        * exp(-o->sigma * y) * c[q / APART];
        o->decay[q] = exp(-y);
        /* int_0^1 e^{-y (1 - th)} (3/2 - th) dth and (th - 1/2) */
        double whole = 1, half = 0, term = 1;
        if (y > 0.5) {
            whole = -expm1(-y) / y;
            half = (1 + o->decay[q]) / (2 * y) - whole / y;
        } else {
            for (int k = 1; k < 16; k++) {
                term *= -y / (k + 1);
                whole += term;
                half -= term * k / (2 * (k + 2.0));
            }
        }
        o->near[q] = whole - half;
        o->far[q] = half;
        o->implicit += o->om[q] * half;
    }
    o->local = o->scale * pow(o->sigma * h, 1 - o->b) / (h * (1 - o->b));
    return FVI_SUCCESS;
}

/* z <- e^{-s h} z + near * before. Return sum om z without its implicit part. */
FVI_VECTORS static double decayed(size_t Q, const double *restrict om,
                                  const double *restrict decay,
                                  const double *restrict near, double before,
                                  double *restrict z)
{
    double sum = 0;
#pragma omp simd reduction(+ : sum)
    for (size_t q = 0; q < Q; q++) {
        z[q] = decay[q] * z[q] + near[q] * before;
        sum += om[q] * z[q];
    }
    return sum;
}

FVI_VECTORS static void complete(size_t Q, const double *restrict far,
                                 double after, double *restrict z)
{
#pragma omp simd
    for (size_t q = 0; q < Q; q++)
        z[q] += far[q] * after;
}

/* Solve M w + grad U(a + e w) = r for w = v_{n+1}. M has one number for each coordinate. */
static int solve(solver *o, const double *M, const double *a, double e,
                 double *w)
{
    const fvi_system *s = &o->p->system;
    double before = GSL_POSINF;
    for (int i = 0; i < 60; i++) {
        double curvature = 0, moved = 0, largest = 1e-30;
        for (size_t j = 0; j < o->d; j++)
            o->at[j] = a[j] + e * w[j];
        int status = fvi_potential_gradient(s, o->at, o->grad);
        if (!status && o->d == 1 && s->potential.hessian)
            status =
                s->potential.hessian(1, o->at, s->potential.params, &curvature);
        if (status)
            return status;
        for (size_t j = 0; j < o->d; j++) {
            const double by =
                (o->r[j] - o->grad[j] - M[j] * w[j]) / (M[j] + e * curvature);
            w[j] += by;
            moved = larger(moved, fabs(by));
            largest = larger(largest, fabs(w[j]));
        }
        moved /= largest;
        if (o->linear || moved < 1e-15 || (moved < 1e-12 && moved >= before)
            || (o->d == 1 && moved < 1e-8))
            return FVI_SUCCESS;
        if (!(moved < 1e10) || (i > 5 && moved > 2 * before))
            break;
        before = moved;
    }
    return FVI_EMAXITER;
}

static int step(solver *o, size_t n, double *M, double *a)
{
    const fvi_system *s = &o->p->system;
    const double h = o->h, g = o->sigma;
    const int three = n > 0 /* no parabola over a jump of v' */
                      && fabs(h * (double)n - o->p->jump) > 1e-6 * h;
    const double top = three ? (2 * g + 1) / (2 * h) : 1 / h;
    double **x = o->x, **v = o->v;
    int status = FVI_SUCCESS;
    if (s->force.value)
        status =
            s->force.value(h * ((double)n + g), o->d, s->force.params, o->F);
    for (size_t j = 0; j < o->d && !status; j++) {
        /* x_{n+1} = base + h' v_{n+1}; the known parts of m v' and of D^b u */
        const double xs = three ? (4 * g * x[1][j] - (2 * g - 1) * x[0][j])
                                      / (2 * h)
                                : x[1][j] / h,
                     vs = three ? (4 * g * v[1][j] - (2 * g - 1) * v[0][j])
                                      / (2 * h)
                                : v[1][j] / h,
                     base = (xs + (1 - g) * v[1][j]) / top, slope = g / top,
                     rho = s->damping[j], last = o->of_v ? v[1][j] : x[1][j],
                     before = n ? last - (o->of_v ? v[0][j] : x[0][j]) : 0,
                     take = o->local + (n ? o->implicit : 0);
        const double past =
            n ? decayed(o->Q, o->om, o->decay, o->near, before, o->z + j * o->Q)
              : 0;
        M[j] = s->mass[j] * top + rho * take * (o->of_v ? 1 : slope);
        o->r[j] = s->mass[j] * vs + o->F[j]
                  - rho * (past + take * ((o->of_v ? 0 : base) - last));
        a[j] = g * base + (1 - g) * x[1][j];
        x[2][j] = base; /* plus slope v_{n+1} */
        v[2][j] = n ? 2 * v[1][j] - v[0][j] : v[1][j];
    }
    if (!status)
        status = solve(o, M, a, g * g / top, v[2]);
    for (size_t j = 0; j < o->d && !status; j++) {
        x[2][j] += g / top * v[2][j];
        if (n)
            complete(o->Q, o->far,
                     o->of_v ? v[2][j] - v[1][j] : x[2][j] - x[1][j],
                     o->z + j * o->Q);
    }
    double *oldest[] = { x[0], v[0] };
    x[0] = x[1], x[1] = x[2], x[2] = oldest[0];
    v[0] = v[1], v[1] = v[2], v[2] = oldest[1];
    return status;
}

static int run(const task *of, double *rows)
{
    const problem *p = of->p;
    const fvi_potential *U = &p->system.potential;
    const size_t d = p->system.d;
    solver o = { .p = p, .d = d, .h = p->T / (double)of->N };
    o.of_v = p->alpha > 0.5;
    o.b = 2 * p->alpha - o.of_v;
    o.sigma = 1 - o.b / 2;
    o.scale = 1 / tgamma(1 - o.b);
    o.linear = d == 1 && U->quadratic && U->quadratic(U->params);
    double *block = calloc(12 * d, sizeof *block), *M = block + 10 * d,
           *a = block + 11 * d;
    int status = block ? modes(&o, of->tolerance) : FVI_ENOMEM;
    double **parts[] = { o.x,     o.x + 1, o.x + 2, o.v,   o.v + 1,
                         o.v + 2, &o.F,    &o.grad, &o.at, &o.r };
    for (size_t i = 0; i < 10 && block; i++)
        *parts[i] = block + i * d;
    for (size_t j = 0; j < d && !status; j++) {
        o.x[1][j] = rows[j] = p->x0[j];
        o.v[1][j] = p->p0[j] / p->system.mass[j];
    }
    for (size_t n = 0; n < of->N && !status; n++) {
        status = step(&o, n, M, a);
        if ((n + 1) % (of->N / ROWS) == 0)
            memcpy(rows + (n + 1) / (of->N / ROWS) * d, o.x[1],
                   d * sizeof *rows);
    }
    free(o.om);
    free(block);
    return status;
}

static int fractional(const problem *p)
{
    return p->alpha != 0.5 && p->past == FVI_INITIAL_HISTORY_CAPUTO;
}

const peer peer_l21sigma = { "fast L2-1_sigma",
                             "Yan, Sun, Zhang 2017",
                             "a step is one sum over few modes",
                             1,
                             ROWS,
                             0,
                             fractional,
                             run };
