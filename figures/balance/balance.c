/* figures/balance/balance.c -- H 21: the form that a damped system conserves, and the reciprocity of five masses.
 *
 * - Block 0: t, then three numbers of one damped spring, each divided by its first value: the area of two
 *   forward variations (without damping it is conserved), the form C_n of a forward and a backward variation,
 *   and C_n without its sum over the past, which one step alone could compute.
 * - Block 1: t, the position of mass 4 after a push of mass 1, of mass 1 after a push of mass 4, of mass 1
 *   after its own push, and of mass 4 after its own push. The first two agree. */
#include <fvi/fvi.h>
#include "run/whole_run.h"
#include <fvi/paper/balance.h>

#include <stdio.h>
#include <stdlib.h>

enum { N = 400, MASSES = 5, STEPS = 300 };

static int motion(const fvi_system *system, double alpha, fvi_initial_history past,
                  double h, size_t steps, const double *x0, const double *p0,
                  double *x)
{
    fvi_run run = fvi_run_default(system, x0, p0, h, steps);
    run.alpha = alpha;
    run.past = past;
    return fvi_trajectory(&fvi_fractional, &run, x, NULL, NULL);
}

static int pairs(void)
{
    static double u[N + 1], w[N + 1], v[N + 1], C[N], area[N], near[N];
    const double one = 1, zero = 0, rho = 0.25, h = 0.05, alpha = 0.3;
    const fvi_system system = { .d = 1,
                                .mass = &one,
                                .damping = &rho,
                                .potential = fvi_potential_harmonic(&one) };
    fvi_system undamped = system;
    undamped.damping = &zero;
    const fvi_balance_scheme scheme = {
        &system, alpha, 0.5, h, FVI_DELTA_EULER, 0
    };
    fvi_balance_scheme step = scheme;
    step.system = &undamped;
    if (motion(&system, alpha, FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE, h, N, &zero, &one, u)
        || motion(&system, alpha, FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE, h, N, &one, &zero,
                  w))
        return EXIT_FAILURE;
    for (size_t k = 0; k <= N; k++)
        v[k] = u[N - k];
    if (fvi_green_form(&scheme, N, NULL, u, v, C)
        || fvi_green_form(&step, N, NULL, u, w, area)
        || fvi_green_form(&step, N, NULL, u, v, near))
        return EXIT_FAILURE;
    printf("# t  area  C_n  its near part  (alpha = %g, rho = %g)\n", alpha,
           rho);
    for (size_t n = 0; n < N; n++)
        printf("%.17g %.17g %.17g %.17g\n", (double)n * h, area[n] / area[0],
               C[n] / C[0], near[n] / C[0]);
    printf("\n\n");
    return EXIT_SUCCESS;
}

static int masses(void)
{
    static double one[(STEPS + 1) * MASSES], four[(STEPS + 1) * MASSES];
    const double mass[] = { 1, 2, 0.5, 3, 1 }, spring[] = { 1, 0 };
    const double damping[] = { 0.1, 0, 1, 0.3, 0.5 }, rest[MASSES] = { 0 };
    const double push_one[] = { 1, 0, 0, 0, 0 },
                 push_four[] = { 0, 0, 0, 1, 0 };
    const fvi_system system = { .d = MASSES,
                                .mass = mass,
                                .damping = damping,
                                .potential = fvi_potential_chain(spring) };
    if (motion(&system, 0.3, FVI_INITIAL_HISTORY_HELD, 0.1, STEPS, rest, push_one, one)
        || motion(&system, 0.3, FVI_INITIAL_HISTORY_HELD, 0.1, STEPS, rest, push_four,
                  four))
        return EXIT_FAILURE;
    printf("# t  4 from 1  1 from 4  1 from 1  4 from 4\n");
    for (size_t k = 0; k <= STEPS; k++) {
        const double *a = one + k * MASSES, *b = four + k * MASSES;
        printf("%.17g %.17g %.17g %.17g %.17g\n", (double)k * 0.1, a[3], b[0],
               a[0], b[3]);
    }
    return EXIT_SUCCESS;
}

int main(void)
{
    int status = pairs();
    return status ? status : masses();
}
