/* figures/experiments/experiments_difference.c -- H 10: x of the FVI minus x of the Lagrange-d'Alembert integrator.
 *
 * The system is the paper's oscillator, m = c = 1, rho = 0.2, x0 = 1, p0 = 1/2, alpha = 1/2, with h = 0.2 up to
 * T = 30. Prints t and the difference in units of 2^-53, once for the momentum form of the FVI and once for
 * Algorithm 3 as the paper prints it, with its double sum. */
#include <fvi/fvi.h>
#include "run/whole_run.h"
#include <fvi/paper/algorithm_3.h>

#include <stdio.h>
#include <stdlib.h>

enum { N = 150 };

int main(void)
{
    const double one = 1, rho = 0.2, x0 = 1, p0 = 0.5, h = 0.2;
    const fvi_system system = { .d = 1,
                                .mass = &one,
                                .damping = &rho,
                                .potential = fvi_potential_harmonic(&one) };
    const fvi_run run = { &system, &x0, &p0, h, N, .kappa = 0.5, .alpha = 0.5 };
    double lda[N + 1], fvi[N + 1], printed[N + 1];
    if (fvi_trajectory(&fvi_lagrange_dalembert, &run, lda, NULL, NULL)
        || fvi_trajectory(&fvi_fractional, &run, fvi, NULL, NULL)
        || fvi_algorithm_3(&system, 0.5, 0.5, h, N, x0, p0, printed))
        return EXIT_FAILURE;
    printf(
        "# t, then x - x^LdA in units of 2^-53: momentum form, as printed\n");
    for (size_t k = 0; k <= N; k++)
        printf("%.17g %.17g %.17g\n", (double)k * h, (fvi[k] - lda[k]) * 0x1p53,
               (printed[k] - lda[k]) * 0x1p53);
    return EXIT_SUCCESS;
}
