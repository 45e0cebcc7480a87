/* tests/harness/fvi_runs.h -- Runs of one line each, for the tests of H 9. */
#ifndef FVI_RUNS_H
#define FVI_RUNS_H

#include <fvi/fvi.h>
#include "run/whole_run.h"
#include <fvi/paper/algorithm_3.h>
#include "ulp.h"

/* The potential U = c x^2/2 + g x^3/3 in one dimension. */
static inline int cubic_value(size_t d, const double *x, void *params,
                              double *value)
{
    const double *cg = params;
    *value = (double)d * (cg[0] / 2 + cg[1] / 3 * x[0]) * x[0] * x[0];
    return 0;
}

static inline int cubic_gradient(size_t d, const double *x, void *params,
                                 double *g)
{
    const double *cg = params;
    g[0] = (double)d * (cg[0] + cg[1] * x[0]) * x[0];
    return 0;
}

static inline int cubic_hessian(size_t d, const double *x, void *params,
                                double *H)
{
    const double *cg = params;
    H[0] = (double)d * (cg[0] + 2 * cg[1] * x[0]);
    return 0;
}

enum { HARMONIC, CUBIC, CHAIN, DUFFING, PENDULUM };

static inline fvi_potential potential(int kind, const double cg[2])
{
    switch (kind) {
    case HARMONIC:
        return fvi_potential_harmonic(cg);
    case CHAIN:
        return fvi_potential_chain(cg);
    case DUFFING:
        return fvi_potential_duffing(cg);
    case PENDULUM:
        return fvi_potential_pendulum(cg);
    default:
        return (fvi_potential){ .value = cubic_value,
                                .gradient = cubic_gradient,
                                .hessian = cubic_hessian,
                                .params = (void *)cg };
    }
}

/* The parameters of a run, and a system in one dimension. */
typedef struct {
    double alpha, kappa, h;
    size_t steps;
    fvi_initial_history past;
    double mass, rho, x0, p0;
    int potential;
    double cg[2];
    fvi_force force;
} setup;

/* Run any system with the parameters `a`. x and p may be NULL. */
static inline void run(const fvi_method *method, const setup *a,
                       const fvi_system *system, const double *x0,
                       const double *p0, double *x, double *p)
{
    const fvi_run r = { .system = system,
                        .x0 = x0,
                        .p0 = p0,
                        .h = a->h,
                        .steps = a->steps,
                        .kappa = a->kappa,
                        .alpha = a->alpha,
                        .past = a->past,
                        .memory = FVI_HISTORY_DIRECT };
    ck_assert_int_eq(fvi_trajectory(method, &r, x, p, NULL), FVI_SUCCESS);
}

static inline void solve(const fvi_method *method, const setup *a, double *x,
                         double *p)
{
    const fvi_system system = { 1,        &a->mass,
                                &a->rho,  potential(a->potential, a->cg),
                                a->force, NULL, NULL };
    run(method, a, &system, &a->x0, &a->p0, x, p);
}

static inline void solve_as_printed(const setup *a, double *x)
{
    const fvi_system system = { 1,        &a->mass,
                                &a->rho,  potential(a->potential, a->cg),
                                a->force, NULL, NULL };
    ck_assert_int_eq(fvi_algorithm_3(&system, a->alpha, a->kappa, a->h,
                                     a->steps, a->x0, a->p0, x),
                     FVI_SUCCESS);
}

/* Return max |v_i - w_i|. w may be NULL, which stands for zeros. */
static inline double farthest(size_t n, const double *v, const double *w)
{
    double max = 0;
    for (size_t i = 0; i < n; i++)
        max = larger(max, fabs(v[i] - (w ? w[i] : 0)));
    return max;
}

#endif
