/* tests/convergence/motions.h -- Nonlinear motions, and what the theorem asks of them. */
#ifndef MOTIONS_H
#define MOTIONS_H

#include <fvi/fvi.h>
#include "run/whole_run.h"
#include "harness/ulp.h"
#include "system/seeded.h"

#include <gsl/gsl_math.h>

/* F = sum of a_i for t > t_i, a_i / 2 at t_i, and b cos(w t). */
typedef struct {
    double t[3], a[3], b, w;
} jumps;

static inline int jumping(double t, size_t d, void *params, double *F)
{
    const jumps *q = params;
    for (size_t i = 0; i < d; i++) {
        F[i] = q->b * cos(q->w * t);
        for (size_t j = 0; j < LEN(q->t); j++)
            F[i] += t > q->t[j] ? q->a[j] : t == q->t[j] ? q->a[j] / 2 : 0;
    }
    return FVI_SUCCESS;
}

typedef struct {
    double alpha, kappa, mass, rho, x0, p0, T;
    int pendulum; /* U = g (1 - cos x), g = cg[0]; else Duffing's */
    double cg[2];
    fvi_initial_history past;
    jumps force;
} motion;

static inline fvi_potential potential(const motion *q)
{
    return q->pendulum ? fvi_potential_pendulum(q->cg)
                       : fvi_potential_duffing(q->cg);
}

static inline double gradient(const motion *q, double x)
{
    double g;
    const fvi_potential u = potential(q);
    ck_assert_int_eq(u.gradient(1, &x, u.params, &g), FVI_SUCCESS);
    return g;
}

static inline void solve(const fvi_method *method, const motion *q,
                         size_t steps, double *x, double *p)
{
    const fvi_system system = { .d = 1,
                                .mass = &q->mass,
                                .damping = &q->rho,
                                .potential = potential(q),
                                .force = { .value = jumping,
                                           .params = (void *)&q->force } };
    fvi_run run =
        fvi_run_default(&system, &q->x0, &q->p0, q->T / (double)steps, steps);
    run.alpha = q->alpha;
    run.kappa = q->kappa;
    run.past = q->past;
    ck_assert_int_eq(fvi_trajectory(method, &run, x, p, NULL), FVI_SUCCESS);
}

/* The hypotheses, from a fine run: A from eight steps at once, as the fine p is not
 * that smooth in its first steps, and five in a hundred more. */
static inline fvi_smoothness know(const motion *q, size_t fine, const double *x,
                              const double *p)
{
    const double h = q->T / (double)fine, m = q->mass, room = 0.5;
    fvi_smoothness k = { .alpha = q->alpha,
                     .kappa = q->kappa,
                     .T = q->T,
                     .damping = q->rho / m,
                     .start = fabs(q->p0 / m),
                     .room = room };
    double far = 0;
    for (size_t i = 0; i <= fine; i++) {
        far = larger(far, fabs(x[i]));
        k.speed = larger(k.speed, 1.01 * fabs(p[i] / m));
        if (i > 0)
            k.velocity_variation += 1.01 * fabs(p[i] - p[i - 1]) / m;
        if (i >= 8)
            k.acceleration = larger(k.acceleration,
                                    1.05 * fabs(p[i] - p[i - 8]) / (8 * h * m));
    }
    k.variation = fabs(q->force.b) * q->force.w * q->T / m;
    for (size_t j = 0; j < LEN(q->force.t); j++)
        k.variation += fabs(q->force.a[j]) / m;
    if (q->pendulum) {
        k.room = GSL_POSINF;
        k.lipschitz = k.gradient = q->cg[0] / m;
    } else {
        far += room;
        k.lipschitz = (q->cg[0] + 3 * q->cg[1] * far * far) / m;
        k.gradient = (q->cg[0] + q->cg[1] * far * far) * far / m;
        if (q->cg[1] == 0 && q->kappa == 0)
            k.room = GSL_POSINF;
    }
    return k;
}

/* b_0, ..., b_{count - 1}, the coefficients of (1 - z)^-gamma. */
static inline void integral_weights(double gamma, size_t count, double *b)
{
    b[0] = 1;
    for (size_t n = 1; n < count; n++)
        b[n] = b[n - 1] * (((double)n - 1 + gamma) / (double)n);
}

/* ---- seeded motions ---- */

enum { COARSE = 128, FINE = 8192 }; /* steps */

static uint64_t state;

static inline double between(double low, double high)
{
    return fvi_seeded_uniform(&state, low, high);
}

/* Jumps at odd nodes of the fine run, so between those of the coarse one. */
static inline motion some_motion(size_t seed)
{
    state = 20 + seed;
    for (int i = 0; i < 8; i++)
        between(0, 1);
    const double T = seed % 4 < 2 ? 0.25 : seed % 4 == 2 ? 1 : 2;
    motion q = { .alpha = between(0, 0.95),
                 .kappa = between(0, 1),
                 .mass = between(0.5, 2),
                 .rho = between(0, 0.4),
                 .x0 = between(-1, 1),
                 .p0 = between(-1, 1),
                 .T = T,
                 .pendulum = seed % 2,
                 .cg = { between(0, 1), between(0, 1) },
                 .force = { .b = between(-1, 1), .w = between(0, 3) } };
    q.past = q.alpha <= 0.5 && seed % 3 == 0 ? FVI_INITIAL_HISTORY_HELD : FVI_INITIAL_HISTORY_CAPUTO;
    for (size_t j = 0; j < LEN(q.force.t); j++) {
        q.force.t[j] = (2 * floor(between(0, FINE / 2)) + 1) * T / FINE;
        q.force.a[j] = between(-3, 3);
    }
    return q;
}

#endif
