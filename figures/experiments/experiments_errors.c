/* figures/experiments/experiments_errors.c -- H 10: the global errors of the FVI for the paper's oscillator.
 *
 * m = c = 1, rho = 0.2, x0 = 1, p0 = 1/2, alpha = 1/2, up to T = 15.
 * - Block 0: h and the largest errors of x, p and E, for the steps to which lines are fitted.
 * - Block 1: the same for coarser steps, which are not fitted.
 * - Block 2, a row each for x, p and E: the slope and the factor of the line through all fitted points, the
 *   slope without the smallest h, and the limit of error / h of (10.7). */
#include <fvi/fvi.h>
#include <fvi/paper/experiments.h>

#include "../tests/experiments/experiments_ref.h"

#include <stdio.h>
#include <stdlib.h>

enum { FINE = 6, COARSE = 3 };

static const double steps[FINE + COARSE] = { 0.1,    0.05,    0.025,
                                             0.0125, 0.00625, 0.003125,
                                             0.5,    0.25,    0.2 };

int main(void)
{
    double error[3][FINE + COARSE];
    printf("# h, max |x_k - x|, max |p_k - p|, max |E_k - E|: fitted\n");
    for (size_t i = 0; i < FINE + COARSE; i++) {
        double e[3];
        size_t N = (size_t)(15 / steps[i] + 0.5);
        if (fvi_oscillator_errors(&fvi_fractional, 1, 0.2, 1, 1, 0.5, steps[i],
                                  N, e))
            return EXIT_FAILURE;
        if (i == FINE)
            printf("\n\n# the same, not fitted\n");
        printf("%.17g %.17g %.17g %.17g\n", steps[i], e[0], e[1], e[2]);
        for (size_t j = 0; j < 3; j++)
            error[j][i] = e[j];
    }
    printf("\n\n# slope, factor, slope of the first five, limit: x, p, E\n");
    for (size_t j = 0; j < 3; j++) {
        double slope, K, five;
        if (fvi_observed_order(FINE, steps, error[j], &slope, &K)
            || fvi_observed_order(FINE - 1, steps, error[j], &five, NULL))
            return EXIT_FAILURE;
        printf("%.17g %.17g %.17g %.17g\n", slope, K, five, ref_constants[j]);
    }
    return EXIT_SUCCESS;
}
