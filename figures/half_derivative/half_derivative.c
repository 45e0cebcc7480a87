/* figures/half_derivative/half_derivative.c -- H 7: the weights of half a derivative, the weights of two half
 * derivatives in a row, and the rounding errors of an equality over 10000 steps.
 *
 * - Block 0, alpha = 1/2: n, |alpha_n|, |c_n|, and the bound of (7.6) on |c_n|. In exact arithmetic c_n = 0. A
 *   c_n that is 0 is printed as nan, because the axis is logarithmic.
 * - Block 1: t, |x| of the Lagrange-d'Alembert run, |x| of Algorithm 3 with its double sums, and their
 *   difference. Each number is the largest in a window of 20 steps. */
#include <fvi/fvi.h>
#include "run/whole_run.h"
#include <fvi/paper/algorithm_3.h>
#include <fvi/paper/half_derivative.h>
#include "system/larger.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { N = 10000, WINDOW = 20 };

static int weights(void)
{
    static double w[N + 1], c[N + 1];
    if (fvi_gl_weights(0.5, N + 1, w)
        || fvi_gl_weights_product(0.5, 0.5, N + 1, c))
        return EXIT_FAILURE;
    printf("# n  |alpha_n|  |c_n| = |sum alpha_j alpha_(n-j)|\n"
           "# (n + 14) u |alpha_n|  (alpha = 1/2)\n");
    for (size_t n = 1, next = 1; n <= N; n++) {
        if (n < next)
            continue;
        next = n < 100 ? n + 1 : n + n / 40;
        double bound = ((double)n + 14) * 0x1p-53 * fabs(w[n]);
        printf("%zu %.17g %.17g %.17g\n", n, fabs(w[n]),
               c[n] != 0 ? fabs(c[n]) : NAN, bound);
    }
    printf("\n\n");
    return EXIT_SUCCESS;
}

static int runs(void)
{
    static double forced[N + 1], printed[N + 1];
    const double one = 1, rho = 0.2, x0 = 1, p0 = 0.5, h = 0.2;
    const fvi_system system = { .d = 1,
                                .mass = &one,
                                .damping = &rho,
                                .potential = fvi_potential_harmonic(&one) };
    const fvi_run run = { .system = &system,
                          .x0 = &x0,
                          .p0 = &p0,
                          .h = h,
                          .steps = N,
                          .kappa = 0.5,
                          .alpha = 0.5 };
    if (fvi_trajectory(&fvi_lagrange_dalembert, &run, forced, NULL, NULL)
        || fvi_algorithm_3(&system, 0.5, 0.5, h, N, x0, p0, printed))
        return EXIT_FAILURE;
    printf("# t  |x| of lda  |x| of Algorithm 3 as printed  |difference|\n"
           "# each the largest of %d steps  (h = %g, rho = %g)\n",
           WINDOW, h, rho);
    for (size_t k = 0; k + WINDOW <= N; k += WINDOW) {
        double a = 0, b = 0, difference = 0;
        for (size_t j = k; j < k + WINDOW; j++) {
            a = larger(a, fabs(forced[j]));
            b = larger(b, fabs(printed[j]));
            difference = larger(difference, fabs(printed[j] - forced[j]));
        }
        printf("%.17g %.17g %.17g %.17g\n", (double)k * h, a, b, difference);
    }
    return EXIT_SUCCESS;
}

int main(void)
{
    int status = weights();
    return status ? status : runs();
}
