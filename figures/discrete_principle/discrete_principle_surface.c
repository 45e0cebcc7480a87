/* figures/discrete_principle/discrete_principle_surface.c -- H 6: the action as a function of two variations.
 *
 * x is a solution of (6.6a) and y its mirror image, for a spring with m = c = 1, rho = 1/2, alpha = 0.3 and 40
 * steps of 0.1. x varies by epsilon delta and y by eta delta, with the same bump delta.
 * - Block 0: epsilon, eta, S_d - S_d(0, 0) on a grid.
 * - Block 1: epsilon, then S_d - S_d(0, 0) along eta = epsilon and along eta = 0. */
#include <fvi/fvi.h>
#include "run/whole_run.h"
#include <fvi/paper/discrete_principle.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { N = 40, HALF = 30 };

static const double h = 0.1, alpha = 0.3, one = 1, rho = 0.5;

/* Return S_d of x + epsilon delta and y + eta delta, 0 on error. delta is sin^2 times a factor that moves its maximum
 * to an earlier time. */
static double action(const double *x, const double *y, double epsilon,
                     double eta)
{
    const fvi_system system = { .d = 1,
                                .mass = &one,
                                .damping = &rho,
                                .potential = fvi_potential_harmonic(&one) };
    double X[N + 1], Y[N + 1], S = 0;
    for (int k = 0; k <= N; k++) {
        const double t = (double)k / N,
                     delta = pow(sin(3.14159265358979 * t), 2) * (1 - t) * 2;
        X[k] = x[k] + epsilon * delta;
        Y[k] = y[k] + eta * delta;
    }
    fvi_discrete_action(&system, alpha, 0.5, h, N, 0, N, X, Y, &S);
    return S;
}

int main(void)
{
    const double x0 = 1, p0 = 0;
    double x[N + 1], y[N + 1];
    const fvi_system system = { .d = 1,
                                .mass = &one,
                                .damping = &rho,
                                .potential = fvi_potential_harmonic(&one) };
    fvi_run run = fvi_run_default(&system, &x0, &p0, h, N);
    run.alpha = alpha;
    run.past = FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE;
    if (fvi_trajectory(&fvi_fractional, &run, x, NULL, NULL))
        return EXIT_FAILURE;
    for (int k = 0; k <= N; k++)
        y[k] = x[N - k];
    const double S = action(x, y, 0, 0);
    printf("# epsilon, eta, S - S(0, 0)\n");
    for (int i = -HALF; i <= HALF; i++, printf("\n"))
        for (int j = -HALF; j <= HALF; j++)
            printf("%g %g %.9g\n", 0.5 * i / HALF, 0.5 * j / HALF,
                   action(x, y, 0.5 * i / HALF, 0.5 * j / HALF) - S);
    printf("\n\n# epsilon, both, x alone\n");
    for (int i = -HALF; i <= HALF; i++)
        printf("%g %.9g %.9g\n", 0.5 * i / HALF,
               action(x, y, 0.5 * i / HALF, 0.5 * i / HALF) - S,
               action(x, y, 0.5 * i / HALF, 0) - S);
    return EXIT_SUCCESS;
}
