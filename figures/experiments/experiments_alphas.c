/* figures/experiments/experiments_alphas.c -- H 10: runs of the FVI for seven alpha.
 *
 * The system is the paper's oscillator, m = c = 1, rho = 0.2, x0 = 1, p0 = 1/2. Block 0: the exact solution for
 * alpha = 1/2. Then a block for each alpha: t and x of the run with h = 1/2, N = 30, kappa = 1/2. The first
 * line of a block is its title. */
#include <fvi/fvi.h>
#include "run/whole_run.h"
#include <fvi/paper/experiments.h>

#include <stdio.h>
#include <stdlib.h>

enum { N = 30, FINE = 300 };

int main(void)
{
    const double alphas[] = { 0, 0.25, 0.4, 0.5, 0.6, 0.75, 1 };
    printf("# t, x of the oscillator; h = 0.5, N = 30, kappa = 0.5\n");
    const double one = 1, rho = 0.2, x0 = 1, p0 = 0.5, h = 0.5;
    const fvi_system system = { .d = 1,
                                .mass = &one,
                                .damping = &rho,
                                .potential = fvi_potential_harmonic(&one) };
    printf("t \"exact, α = 0.5\"\n");
    for (size_t k = 0; k <= FINE; k++) {
        double x, t = (double)k * (N * h / FINE);
        if (fvi_damped_oscillator(1, rho, 1, x0, p0, t, &x, NULL))
            return EXIT_FAILURE;
        printf("%.17g %.17g\n", t, x);
    }
    for (size_t i = 0; i < sizeof alphas / sizeof *alphas; i++) {
        double x[N + 1];
        const fvi_run run = { &system,
                              &x0,
                              &p0,
                              h,
                              N,
                              .kappa = 0.5,
                              .alpha = alphas[i],
                              .past = FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE };
        if (fvi_trajectory(&fvi_fractional, &run, x, NULL, NULL))
            return EXIT_FAILURE;
        printf("\n\nt \"α = %g\"\n", alphas[i]);
        for (size_t k = 0; k <= N; k++)
            printf("%.17g %.17g\n", (double)k * h, x[k]);
    }
    return EXIT_SUCCESS;
}
