/* tests/balance/balance_runs.h -- Schemes and systems of the tests of H 21. */
#ifndef BALANCE_RUNS_H
#define BALANCE_RUNS_H

#include <fvi/fvi.h>
#include "run/whole_run.h"
#include <fvi/paper/balance.h>
#include "harness/ulp.h"

#include <gsl/gsl_rng.h>

enum { MOST = 82 };

static const fvi_method *const methods[] = { &fvi_fractional, &fvi_cq2_shifted,
                                             &fvi_cq_bdf2 };

static inline fvi_balance_scheme scheme_of(int method, const fvi_system *system,
                                           double alpha, double kappa, double h)
{
    return (fvi_balance_scheme){ system,
                                 alpha,
                                 kappa,
                                 h,
                                 method == 2 ? FVI_DELTA_BDF2
                                             : FVI_DELTA_EULER,
                                 method == 1 ? alpha : 0 };
}

/* Held at x0 until t = 0, its memory summed as it stands. */
static inline void trajectory(int method, const fvi_balance_scheme *s,
                              fvi_initial_history past, size_t N, const double *x0,
                              const double *p0, double *x, double *p)
{
    fvi_run run = fvi_run_default(s->system, x0, p0, s->h, N);
    run.alpha = s->alpha;
    run.kappa = s->kappa;
    run.past = past;
    run.memory = FVI_HISTORY_DIRECT;
    ck_assert_int_eq(fvi_trajectory(methods[method], &run, x, p, NULL),
                     FVI_SUCCESS);
}

/* t[n + 1] = h^(1 - 2 alpha) ((1 - theta) w_n + theta w_{n+1}), n = -1, ..., N:
 * T_{kj} = rho t[k - j + 1] for k - j >= -1. */
static inline void memory_of(const fvi_balance_scheme *s, size_t N, double *t)
{
    double w[MOST + 3];
    ck_assert_int_eq(fvi_cq_weights(s->weights, 2 * s->alpha, N + 2, w),
                     FVI_SUCCESS);
    for (size_t n = 0; n <= N + 1; n++)
        t[n] = pow(s->h, 1 - 2 * s->alpha)
               * ((n ? (1 - s->theta) * w[n - 1] : 0) + s->theta * w[n]);
}

/* U = |x|^2/2 + |x|^4/4 in R^2. */
static inline int central_value(size_t d, const double *x, void *params,
                                double *value)
{
    const double s = x[0] * x[0] + x[1] * x[1];
    (void)d, (void)params;
    *value = s / 2 + s * s / 4;
    return FVI_SUCCESS;
}

static inline int central_gradient(size_t d, const double *x, void *params,
                                   double *g)
{
    const double s = x[0] * x[0] + x[1] * x[1];
    (void)d, (void)params;
    g[0] = (1 + s) * x[0];
    g[1] = (1 + s) * x[1];
    return FVI_SUCCESS;
}

static inline int central_hessian(size_t d, const double *x, void *params,
                                  double *H)
{
    const double s = x[0] * x[0] + x[1] * x[1];
    (void)d, (void)params;
    H[0] = 1 + s + 2 * x[0] * x[0];
    H[1] = H[2] = 2 * x[0] * x[1];
    H[3] = 1 + s + 2 * x[1] * x[1];
    return FVI_SUCCESS;
}

static const fvi_potential central = { .value = central_value,
                                       .gradient = central_gradient,
                                       .hessian = central_hessian };

/* Two bodies in free space: U = r^2/2 + r^4/4, r = x_1 - x_0. */
static inline int pair_value(size_t d, const double *x, void *params,
                             double *value)
{
    const double r = x[1] - x[0];
    (void)d, (void)params;
    *value = r * r / 2 + r * r * r * r / 4;
    return FVI_SUCCESS;
}

static inline int pair_gradient(size_t d, const double *x, void *params,
                                double *g)
{
    const double r = x[1] - x[0];
    (void)d, (void)params;
    g[1] = r + r * r * r;
    g[0] = -g[1];
    return FVI_SUCCESS;
}

static inline int pair_hessian(size_t d, const double *x, void *params,
                               double *H)
{
    const double r = x[1] - x[0];
    (void)d, (void)params;
    H[0] = H[3] = 1 + 3 * r * r;
    H[1] = H[2] = -H[0];
    return FVI_SUCCESS;
}

static const fvi_potential two_bodies = { .value = pair_value,
                                          .gradient = pair_gradient,
                                          .hessian = pair_hessian };

/* A double in (a, b). */
static inline double between(gsl_rng *random, double a, double b)
{
    return a + (b - a) * gsl_rng_uniform_pos(random);
}

#endif
