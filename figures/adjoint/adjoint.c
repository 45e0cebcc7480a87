/* figures/adjoint/adjoint.c -- H 23: how much x(20) moves if the body is pushed at t, by an adjoint run and by
 * trial.
 *
 * Prints four blocks, two for a spring and then two for a Duffing spring (alpha = 0.3, rho = 0.3).
 * - Blocks 0 and 2: t, x, lambda, mirror. lambda is the derivative of x(20) with respect to an impulse at t,
 *   from one adjoint run. The mirror is the run that starts at rest in 0 with momentum 1, read from its end.
 * - Blocks 1 and 3: t and (x_N with a small push at t - x_N) / push, one run for each t. */
#include <fvi/fvi.h>
#include "run/whole_run.h"

#include <stdio.h>
#include <stdlib.h>

enum { N = 320, EVERY = 20 };
#define PUSH 1e-4

/* Return the force at[1] within half a step at[2] of the time at[0], and 0 elsewhere. */
static int push_value(double t, size_t d, void *params, double *F)
{
    const double *at = params;
    (void)d;
    F[0] = fabs(t - at[0]) < at[2] ? at[1] : 0;
    return 0;
}

static int last_position(size_t k, size_t d, const double *x, const double *p,
                         void *params, double *Jx, double *Jp)
{
    (void)d, (void)x, (void)p, (void)params, (void)Jp;
    Jx[0] = k == N;
    return 0;
}

static int draw(double g)
{
    static double x[N + 1], pushed[N + 1], mirror[N + 1], by_force[N + 1];
    const double cg[2] = { 1, g }, m = 1, rho = 0.3, x0 = 1.2, p0 = 0, zero = 0;
    fvi_system system = { .d = 1,
                          .mass = &m,
                          .damping = &rho,
                          .potential = fvi_potential_duffing(cg) };
    fvi_run run = fvi_run_default(&system, &x0, &p0, 1. / 16, N);
    run.alpha = 0.3;
    fvi_run kicked = run; /* x0 = 0, p0 = 1 */
    kicked.x0 = &zero;
    kicked.p0 = &m;
    const fvi_objective J = { .slopes = last_position, .params = NULL };
    const fvi_sensitivities want = { .force = by_force };
    if (fvi_trajectory(&fvi_fractional, &run, x, NULL, NULL)
        || fvi_trajectory(&fvi_fractional, &kicked, mirror, NULL, NULL)
        || fvi_adjoint(&fvi_fractional, &run, NULL, NULL, &J, &want))
        return 1;
    for (size_t k = 1; k <= N; k++)
        printf("%.6g %.6g %.6g %.6g\n", (double)k * run.h, x[k],
               by_force[k] / run.h, mirror[N - k]);
    printf("\n\n");
    for (size_t k = EVERY / 2; k < N; k += EVERY) {
        double at[3] = { (double)k * run.h, PUSH / run.h, run.h / 2 };
        system.force = (fvi_force){ .value = push_value, .params = at };
        if (fvi_trajectory(&fvi_fractional, &run, pushed, NULL, NULL))
            return 1;
        printf("%.6g %.6g\n", at[0], (pushed[N] - x[N]) / PUSH);
    }
    printf("\n\n");
    return 0;
}

int main(void)
{
    printf("# t x lambda mirror (alpha = 0.3, rho = 0.3); t, difference\n");
    return draw(0) || draw(1.5);
}
