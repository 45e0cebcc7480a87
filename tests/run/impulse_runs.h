/* tests/run/impulse_runs.h -- A spring that is hit, for the tests of impulses. */
#ifndef IMPULSE_RUNS_H
#define IMPULSE_RUNS_H

#include <fvi/fvi.h>
#include "run/whole_run.h"
#include "harness/ulp.h"

enum { MOST = 1280 };

/* A spring that is hit once. */
static const double one = 1, rho = 0.4, cg[2] = { 2, 0 }, x0 = 0.7, p0 = -0.3,
                    J = 1.3;
static fvi_impulse hit = { 0, &J };
static fvi_system spring;
static double x[MOST + 1], p[MOST + 1];

static inline fvi_run hit_at(double t, double alpha, size_t steps)
{
    hit.t = t;
    spring = (fvi_system){ .d = 1,
                           .mass = &one,
                           .damping = &rho,
                           .potential = fvi_potential_harmonic(cg),
                           .force = { .impulses = &hit, .impulse_count = 1 } };
    fvi_run run =
        fvi_run_default(&spring, &x0, &p0, 5.0 / (double)steps, steps);
    run.alpha = alpha;
    return run;
}

/* The linear problem from rest at 0 with the velocity J, J t later, is added. */
static inline double truth(const fvi_run *run, double t, double at, double *v)
{
    double more = 0, more_v = 0, y;
    fvi_linear_oscillator q = { .m = 1,
                     .c = cg[0],
                     .rho = rho,
                     .alpha = run->alpha,
                     .x0 = x0,
                     .v0 = p0 };
    ck_assert_int_eq(fvi_exact_at(&q, 1, &t, &y, v, NULL), FVI_SUCCESS);
    t -= at;
    q.x0 = 0;
    q.v0 = J;
    if (t > 0)
        ck_assert_int_eq(fvi_exact_at(&q, 1, &t, &more, &more_v,
                                      NULL), FVI_SUCCESS);
    *v += more_v;
    return y + more;
}

/* max |x_k - x(t_k)| over all nodes; of p where it does not jump, unless NULL. */
static inline double error(const fvi_method *method, const fvi_run *run, double at,
                    double *of_p)
{
    ck_assert_int_eq(fvi_trajectory(method, run, x, p, NULL), FVI_SUCCESS);
    double worst = 0, worst_p = 0, v;
    for (size_t k = 1; k <= run->steps; k++) {
        const double t = (double)k * run->h;
        worst = larger(worst, fabs(x[k] - truth(run, t, at, &v)));
        if (fabs(t - at) > 1e-9)
            worst_p = larger(worst_p, fabs(p[k] - v));
    }
    if (of_p)
        *of_p = worst_p;
    return worst;
}

#endif
