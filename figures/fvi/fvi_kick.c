/* figures/fvi/fvi_kick.c -- H 9: one run with finer and finer steps, as printed in the paper and for a held body.
 *
 * The problem is x'' + x + D^{9/5} x / 5 = 0, x_0 = 1, p_0 = 1/2, kappa = 1/2, so alpha = 0.9, up to t = 15.
 * Prints a block for each h with at most 150 steps shown. */
#include <fvi/fvi.h>
#include "run/whole_run.h"

#include <stdio.h>
#include <stdlib.h>

enum { MOST = 3750, ROWS = 150 };

static void run(size_t N, int held, double *x)
{
    const double one = 1, rho = 0.2, x0 = 1, p0 = 0.5;
    const fvi_system system = { .d = 1,
                                .mass = &one,
                                .damping = &rho,
                                .potential = fvi_potential_harmonic(&one) };
    const fvi_run r = { .system = &system,
                        .x0 = &x0,
                        .p0 = &p0,
                        .h = 15 / (double)N,
                        .steps = N,
                        .kappa = 0.5,
                        .alpha = 0.9,
                        .past =
                            held ? FVI_INITIAL_HISTORY_HELD : FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE };
    if (fvi_trajectory(&fvi_fractional, &r, x, NULL, NULL) != FVI_SUCCESS)
        exit(EXIT_FAILURE);
}

int main(void)
{
    static double printed[MOST + 1], held[MOST + 1];
    for (size_t N = 30; N <= MOST; N *= 5) {
        const double h = 15 / (double)N;
        run(N, 0, printed);
        run(N, 1, held);
        printf("# h, t, x as printed, x of a held body; alpha = 0.9, "
               "rho = 1/5, x0 = 1, p0 = 1/2\n");
        for (size_t k = 0; k <= N; k += N > ROWS ? N / ROWS : 1)
            printf("%.17g %.17g %.17g %.17g\n", h, (double)k * h, printed[k],
                   held[k]);
        printf("\n\n");
    }
    return EXIT_SUCCESS;
}
