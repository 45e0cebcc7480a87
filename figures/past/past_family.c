/* figures/past/past_family.c -- H 19: a body that is held and let go, for seven alpha.
 *
 * The system and the start are the defaults of `fvi run`: m = c = 1, rho = 0.2, x0 = 1, p0 = 1/2, held before t
 * = 0. Prints a block for each alpha: t, x of a run of fvi-lobatto4 with h = 0.05 up to t = 15, and at every
 * tenth node the exact x (elsewhere "-"). The last line of a block also has the name of the curve. */
#include <fvi/exact_solution.h>
#include "run/whole_run.h"
#include <fvi/lobatto.h>

#include <stdio.h>
#include <stdlib.h>

enum { N = 300, EVERY = 10 };

int main(void)
{
    const double alphas[] = { 0, 0.125, 0.25, 0.5, 0.75, 0.875, 1 };
    const double one = 1, rho = 0.2, x0 = 1, p0 = 0.5, h = 15.0 / N;
    const fvi_system system = { .d = 1,
                                .mass = &one,
                                .damping = &rho,
                                .potential = fvi_potential_harmonic(&one) };
    printf("# t, x of the run, exact x; fvi-lobatto4, h = %g\n", h);
    for (size_t i = 0; i < sizeof alphas / sizeof *alphas; i++) {
        double x[N + 1];
        const fvi_linear_oscillator problem = { .m = one,
                                     .c = one,
                                     .rho = rho,
                                     .alpha = alphas[i],
                                     .x0 = x0,
                                     .v0 = p0 };
        fvi_run run = fvi_run_default(&system, &x0, &p0, h, N);
        run.alpha = alphas[i];
        if (fvi_trajectory(&fvi_lobatto_m4, &run, x, NULL, NULL))
            return EXIT_FAILURE;
        printf("%s", i ? "\n\n" : "");
        for (size_t k = 0; k <= N; k++) {
            const double t = (double)k * h;
            double exact;
            if (fvi_exact_at(&problem, 1, &t, &exact, NULL, NULL))
                return EXIT_FAILURE;
            printf("%.17g %.17g ", t, x[k]);
            if (k % EVERY)
                printf("-\n");
            else
                printf("%.17g\n", exact);
        }
        printf("%.17g %.17g - \"α = %g\"\n", N * h, x[N], alphas[i]);
    }
    return EXIT_SUCCESS;
}
