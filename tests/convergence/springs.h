/* tests/convergence/springs.h -- Springs, their transform, the stability function of Lobatto
 * IIIC, and runs of form D: what (20.16) to (20.20) are made of. */
#ifndef SPRINGS_H
#define SPRINGS_H

#include <fvi/fvi.h>
#include "run/whole_run.h"
#include "harness/ulp.h"
#include "system/larger.h"
#include "system/seeded.h"

#include "convergence_stages_ref.h"

#include <complex.h>
#include <math.h>

typedef struct {
    size_t s; /* stages */
    double P[8], Q[9]; /* R = P/Q, lowest power first */
    double C; /* (20.17) */
} stability_function;

/* P and Q are Pade's polynomials of the degrees s - 2 and s. */
static inline stability_function stability_of(size_t s)
{
    stability_function R = { .s = s, .P = { 1 }, .Q = { 1 }, .C = ref_stages[s - 2].C };
    for (size_t i = 0; i < s; i++) {
        const double left = (double)(2 * s - 2 - i) * (double)(i + 1);
        if (i + 2 < s)
            R.P[i + 1] = R.P[i] * (double)(s - 2 - i) / left;
        R.Q[i + 1] = -R.Q[i] * (double)(s - i) / left;
    }
    return R;
}

static inline double complex R_at(const stability_function *R, double complex z)
{
    double complex P = 0, Q = 0;
    for (size_t i = R->s + 1; i-- > 0;) {
        Q = Q * z + R->Q[i];
        if (i + 1 < R->s)
            P = P * z + R->P[i];
    }
    return P / Q;
}

/* |R(-nu) - e^(-nu)|; below 1/4 the difference is rounding, and its bound (20.17) is near it. */
static inline double step_misses(const stability_function *R, double nu)
{
    double power = nu;
    if (nu >= 0.25)
        return fabs(creal(R_at(R, -nu)) - exp(-nu));
    for (size_t i = 1; i < R->s; i++)
        power *= nu * nu;
    return R->C * power;
}

/* m x'' + rho D^{2 alpha} x + c x = A, Caputo's past. */
typedef struct {
    double m, c, rho, alpha, x0, v0, A;
} spring;

/* J of (20.16). */
static inline double complex source(const spring *q, double complex z)
{
    return (q->A - q->c * q->x0) / z
           + (q->alpha < 0.5 ? q->m * q->v0 : -q->c * q->v0 / (z * z));
}

/* k of (20.16), whose sign is that of 1 - 2 alpha. */
static inline double density(const spring *q, double sigma)
{
    const double order = 2 * q->alpha, damping = q->rho * pow(sigma, order);
    const double complex P = q->m * sigma * sigma + q->c + damping * cexp(I * M_PI * order);
    return damping * sin(M_PI * order) / (M_PI * creal(P * conj(P)));
}

static inline fvi_linear_oscillator oscillator(const spring *q)
{
    return (fvi_linear_oscillator){ .m = q->m, .c = q->c, .rho = q->rho, .alpha = q->alpha,
                                    .past = FVI_INITIAL_HISTORY_CAPUTO, .x0 = q->x0,
                                    .v0 = q->v0, .forcing = FVI_FORCING_STEP, .A = q->A,
                                    .T = 1e9 };
}

static inline double complex pole_of(const spring *q)
{
    const fvi_linear_oscillator problem = oscillator(q);
    double re, im;
    OK(fvi_exact_pole(&problem, &re, &im, NULL));
    return re + I * im;
}

/* 1/P' at the pole. */
static inline double complex residue(const spring *q, double complex pole)
{
    return 1 / (2 * q->m * pole + 2 * q->alpha * q->rho * cpow(pole, 2 * q->alpha - 1));
}

/* The integral over the rates of k times f, by the trapezoidal rule in ln sigma. The pole
 * is beside the path, so steps are a sixth of its distance. */
static inline double over_rates(const spring *q, double complex pole,
                                double (*f)(double sigma, const void *of), const void *of)
{
    const double L = smaller(1, M_PI - carg(pole)) / 6;
    double sum = 0;
    for (double u = -36; u <= 72; u += L) {
        const double sigma = exp(u);
        sum += L * sigma * density(q, sigma) * f(sigma, of);
    }
    return sum;
}

typedef struct {
    const spring *q;
    const stability_function *R;
    size_t n;
    const double *h; /* n steps */
    double t; /* their sum */
    int order; /* 0: of x, 1: of v */
} mesh_gap;

/* J(z) (prod R(z h_k) - exp(z t)), and z times as much of v. */
static inline double complex gap(const mesh_gap *g, double complex z)
{
    double complex product = 1;
    for (size_t k = 0; k < g->n; k++)
        product *= R_at(g->R, z * g->h[k]);
    return source(g->q, z) * (g->order ? z : 1) * (product - cexp(z * g->t));
}

static const fvi_method *const form_d[] = { NULL, NULL, &fvi_lobatto_d2, &fvi_lobatto_d3, &fvi_lobatto_d4,
                                            &fvi_lobatto_d5, &fvi_lobatto_d6, &fvi_lobatto_d7, &fvi_lobatto_d8 };

enum { MOST = 8192 };
static double x[MOST + 1], p[MOST + 1], want_x[MOST + 1], want_v[MOST + 1], lengths[MOST];

/* ---- seeded springs ---- */

static uint64_t state;

static inline double between(double low, double high)
{
    return fvi_seeded_uniform(&state, low, high);
}

/* Springs with any damping from a tenth of the critical one to ten times as much. */
static inline spring some_spring(size_t seed)
{
    state = 39 + seed;
    for (int i = 0; i < 8; i++)
        between(0, 1);
    spring q = { .m = between(0.5, 2), .c = between(0.5, 2), .rho = exp(between(-2.3, 1)),
                 .alpha = seed % 2 ? between(0.05, 0.45) : between(0.55, 0.95),
                 .x0 = between(-1, 1), .v0 = between(-1, 1), .A = between(-1, 1) };
    return q;
}

/* A constant force A, and what errors of the modes would add to it: as large at all times, of one sign or
 * of both. */
typedef struct {
    double A, more;
    int swings;
} push;

static inline int force(double t, size_t d, void *params, double *F)
{
    const push *of = params;
    for (size_t i = 0; i < d; i++)
        F[i] = of->A + (of->swings && sin(1e4 * t * t) < 0 ? -of->more : of->more);
    return FVI_SUCCESS;
}

/* A run of N equal steps, and what it has to be compared with. */
static inline void solve(const spring *q, size_t s, double T, size_t N, double more, int swings)
{
    const double p0 = q->m * q->v0;
    const push of = { q->A, more, swings };
    const fvi_system system = { .d = 1, .mass = &q->m, .damping = &q->rho,
                                .potential = fvi_potential_harmonic(&q->c),
                                .force = { .value = force, .params = (void *)&of } };
    fvi_run run = fvi_run_default(&system, &q->x0, &p0, T / (double)N, N);
    run.alpha = q->alpha;
    run.past = FVI_INITIAL_HISTORY_CAPUTO;
    OK(fvi_trajectory(form_d[s], &run, x, p, NULL));
    const fvi_linear_oscillator problem = oscillator(q);
    OK(fvi_exact_grid(&problem, run.h, N, 0, want_x, want_v, NULL));
    for (size_t k = 0; k < N; k++)
        lengths[k] = run.h;
}

static inline double largest_of(const double *v, size_t N)
{
    double most = 0;
    for (size_t k = 0; k <= N; k++)
        most = larger(most, fabs(v[k]));
    return most;
}

#endif
