/* tests/adjoint/complex_run.h -- Chains of masses in complex numbers.
 *
 * The equations of Algorithm 3 and of (13.7), summed and solved as they stand, with
 * nothing of the library's. A number that carries an imaginary part of 1e-40 gives J an
 * imaginary part of 1e-40 dJ, without a difference that would cancel. */
#ifndef COMPLEX_RUN_H
#define COMPLEX_RUN_H

#include "adjoint_runs.h"
#include "system/larger.h"

#include <complex.h>
#include <gsl/gsl_sf_psi.h>

/* gcc's _Complex_I may be a float. */
#define TINY (1e-40 * (double complex)_Complex_I)

enum { LENGTH = 64 /* rows at most */ };

/* All that determines J, as one array of numbers may be changed. */
typedef struct {
    fvi_scheme scheme;
    fvi_initial_history past;
    size_t d, N;
    double h, kappa;
    double complex x0[MOST], p0[MOST], mass[MOST], rho[MOST], alpha, cg[2],
        F[LENGTH * MOST];
    const double *by_momenta; /* NULL, or J has the sum of these times all p_k,i, k < N */
} complex_run;

typedef struct {
    double complex x[LENGTH][MOST], p[MOST], momenta[LENGTH][MOST], z[LENGTH][MOST], w[LENGTH],
        impulses[LENGTH][2];
} complex_path;

/* (1 - z)^order, times ((3 - z)/2)^order for BDF2, or a factor of two terms. */
static inline void complex_weights(const complex_run *r, double complex *w)
{
    const double complex order = 2 * r->alpha;
    double complex v[LENGTH] = { 1 }, g[LENGTH] = { cexp(order * log(1.5)) };
    for (size_t n = 1; n <= r->N; n++) {
        v[n] = v[n - 1] * ((double)n - 1 - order) / (double)n;
        g[n] = g[n - 1] * ((double)n - 1 - order) / (double)n / 3;
    }
    for (size_t n = 0; n <= r->N; n++) {
        w[n] = v[n];
        if (r->scheme == FVI_SCHEME_CQ2_MIDPOINT)
            w[n] = (0.5 + r->alpha) * v[n]
                   + (n > 0 ? (0.5 - r->alpha) * v[n - 1] : 0);
        if (r->scheme != FVI_SCHEME_CQ_BDF2)
            continue;
        w[n] = 0;
        for (size_t j = 0; j <= n; j++)
            w[n] += g[j] * v[n - j];
    }
}

/* 1 / Gamma(z), z real but for a tiny part */
static inline double complex reciprocal_gamma(double complex z)
{
    const double x = creal(z);
    return (1 - (z - x) * gsl_sf_psi(x)) / tgamma(x);
}

/* (19.5) with two nodes, h^(1 + e) included; e > -1. */
static inline void complex_initial_impulses(const complex_run *r, double complex e,
                                            double complex impulses[LENGTH][2])
{
    const double complex unit =
        reciprocal_gamma(1 + e) * cexp((1 + e) * log(r->h));
    for (size_t k = 0; k < r->N; k++) {
        const double a = (double)k, b = a + 1;
        const double complex low = k ? cexp(e * log(a)) : 0,
                             high = cexp(e * log(b));
        const double complex whole = (b * high - a * low) / (1 + e),
                             moment = (b * b * high - a * a * low) / (2 + e);
        impulses[k][0] = unit * (whole - moment + a * whole);
        impulses[k][1] = unit * (moment - a * whole);
    }
}

/* Newton's matrix and the force of a chain at S. */
static inline void complex_chain(const complex_run *r, const double complex *S,
                                 double complex *grad,
                                 double complex H[MOST][MOST])
{
    memset(H, 0, sizeof(double complex[MOST][MOST]));
    for (size_t i = 0; i < r->d; i++)
        grad[i] = 0;
    for (size_t i = 0; i <= r->d; i++) {
        const double complex s = (i < r->d ? S[i] : 0) - (i > 0 ? S[i - 1] : 0);
        const double complex f = (r->cg[0] + r->cg[1] * s * s) * s,
                             k = r->cg[0] + 3 * r->cg[1] * s * s;
        if (i < r->d)
            grad[i] += f, H[i][i] += k;
        if (i > 0)
            grad[i - 1] -= f, H[i - 1][i - 1] += k;
        if (i > 0 && i < r->d)
            H[i][i - 1] -= k, H[i - 1][i] -= k;
    }
}

/* b becomes the inverse of A times b; A is nearly symmetric and definite. */
static inline void complex_solve(size_t n, double complex A[MOST][MOST],
                                 double complex *b)
{
    for (size_t k = 0; k < n; k++)
        for (size_t i = k + 1; i < n; i++) {
            const double complex f = A[i][k] / A[k][k];
            for (size_t j = k; j < n; j++)
                A[i][j] -= f * A[k][j];
            b[i] -= f * b[k];
        }
    for (size_t i = n; i-- > 0;) {
        for (size_t j = i + 1; j < n; j++)
            b[i] -= A[i][j] * b[j];
        b[i] /= A[i][i];
    }
}

/* inertia dx + kappa h grad U(x + (1 - kappa) dx) = right; g: that gradient */
static inline void complex_step(const complex_run *r, const double complex *x,
                                const double complex *inertia,
                                const double complex *right, double complex *dx,
                                double complex *g)
{
    const double share = r->kappa * r->h;
    for (int left = 30; left > 0; left--) {
        double change = 0;
        double complex S[MOST], e[MOST], H[MOST][MOST];
        for (size_t i = 0; i < r->d; i++)
            S[i] = x[i] + (1 - r->kappa) * dx[i];
        complex_chain(r, S, g, H);
        for (size_t i = 0; i < r->d; i++) {
            e[i] = right[i] - inertia[i] * dx[i] - share * g[i];
            for (size_t j = 0; j < r->d; j++)
                H[i][j] *= share * (1 - r->kappa);
            H[i][i] += inertia[i];
        }
        complex_solve(r->d, H, e);
        for (size_t i = 0; i < r->d; i++) {
            dx[i] += e[i];
            change = larger(change, fabs(creal(e[i])));
        }
        if (change < 1e-9 && left > 3) /* twice more, for both parts */
            left = 3;
    }
}

static inline void complex_trajectory(const complex_run *r, complex_path *o)
{
    const double h = r->h;
    const int printed = r->scheme == FVI_SCHEME_FVI,
              above = creal(r->alpha) > 0.5,
              rl = r->past == FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE;
    const double complex theta = r->scheme == FVI_SCHEME_CQ2_SHIFTED ? r->alpha
                                 : r->scheme == FVI_SCHEME_CQ2_MIDPOINT ? 0.5
                                                                  : 0;
    const double complex unit = cexp((1 - 2 * r->alpha) * log(h));
    memset(o, 0, sizeof *o);
    complex_weights(r, o->w);
    if (!printed && creal(r->alpha) != 0.5 && (above || rl)
        && r->past != FVI_INITIAL_HISTORY_CAPUTO)
        complex_initial_impulses(r, above ? 1 - 2 * r->alpha : -2 * r->alpha, o->impulses);
    double complex H[MOST] = { 0 }, dx[MOST] = { 0 };
    for (size_t i = 0; i < r->d; i++) {
        o->x[0][i] = r->x0[i];
        o->p[i] = r->p0[i];
        o->z[0][i] = printed && rl ? r->x0[i] : 0;
    }
    for (size_t k = 0; k < r->N; k++) {
        double complex inertia[MOST], right[MOST], g[MOST], known[MOST];
        memcpy(o->momenta[k], o->p, sizeof o->p);
        for (size_t i = 0; i < r->d; i++) {
            const double complex c = r->rho[i] * unit,
                                 A = above ? r->p0[i] / r->mass[i] : r->x0[i],
                                 drift =
                                     above
                                             && (!printed
                                                 || r->past == FVI_INITIAL_HISTORY_CAPUTO)
                                         ? h * r->p0[i] / r->mass[i]
                                         : 0;
            const double complex origin = printed && rl ? 0 : r->x0[i];
            if (!printed)
                o->p[i] += h / 2 * r->F[k * r->d + i] - (0.5 - theta) * c * H[i]
                           - r->rho[i] * A * o->impulses[k][0];
            known[i] =
                o->w[0] * (o->x[k][i] - origin - (double)(k + 1) * drift);
            for (size_t n = 1; n <= k + 1; n++)
                known[i] += o->w[n] * o->z[k + 1 - n][i];
            right[i] = o->p[i] - theta * c * known[i];
            inertia[i] = r->mass[i] / h + theta * c * o->w[0];
            o->z[k + 1][i] = -origin - (double)(k + 1) * drift;
        }
        complex_step(r, o->x[k], inertia, right, dx, g);
        for (size_t i = 0; i < r->d; i++) {
            const double complex c = r->rho[i] * unit,
                                 A = above ? r->p0[i] / r->mass[i] : r->x0[i];
            o->x[k + 1][i] = o->x[k][i] + dx[i];
            o->z[k + 1][i] += o->x[k + 1][i];
            H[i] = known[i] + o->w[0] * dx[i];
            const double complex force = h * r->F[(k + 1) * r->d + i];
            o->p[i] += printed ? force - h * g[i] - c * H[i]
                               : force / 2 - h * g[i] - (0.5 + theta) * c * H[i]
                                     - r->rho[i] * A * o->impulses[k][1];
        }
    }
}

/* The J of to_sine. */
static inline double complex complex_objective(const complex_run *r)
{
    static complex_path o;
    double complex J = 0;
    complex_trajectory(r, &o);
    for (size_t i = 0; i < r->d; i++) {
        for (size_t k = 1; k <= r->N; k++) {
            const double complex away = o.x[k][i] - sin((double)k * r->h);
            J += r->h / 2 * away * away;
        }
        for (size_t k = 0; r->by_momenta && k < r->N; k++)
            J += r->by_momenta[k * r->d + i] * o.momenta[k][i];
        J += o.x[r->N][i] / 2 + o.x[r->N][i] * o.p[i] * o.p[i] / 4;
    }
    return J;
}

/* dJ by one number of the run. */
static inline double complex_slope(complex_run *r, double complex *number)
{
    const double complex was = *number;
    *number += TINY;
    const double slope = cimag(complex_objective(r)) / 1e-40;
    *number = was;
    return slope;
}

#endif
