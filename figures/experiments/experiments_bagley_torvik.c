/* figures/experiments/experiments_bagley_torvik.c -- H 10: the problem of Bagley and Torvik, by the FVI and by the
 * matrix method.
 *
 * The problem is x'' + x + D^(3/2) x = F, F = 8 up to t = 1, then 0; x(0) = x'(0) = 0; 0 <= t <= 20.
 * - Block 0: t and the exact x.
 * - Block 1: t and x of the FVI with h = 0.1.
 * - Block 2: t and x of the matrix method with h = 0.005, the benchmark.
 * - Block 3: h, then three largest differences at the multiples of 0.1: the FVI from the exact x, the FVI from
 *   the benchmark, and the matrix method with this h from the exact x.
 * - Block 4: the slopes that are fitted to these errors. */
#include <fvi/fvi.h>
#include "run/whole_run.h"
#include <fvi/paper/experiments.h>

#include "../tests/experiments/experiments_bagley_torvik_ref.h"
#include "system/larger.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { T = 20, TENTHS = 10 * T, BENCHMARK = 200, MOST = 200 * T };

static const double one = 1, zero = 0, step[] = { 8, 1 };

static int solve(size_t per_unit, int matrix_method, double *x)
{
    const double h = 1 / (double)per_unit;
    const fvi_system system = { .d = 1,
                                .mass = &one,
                                .damping = &one,
                                .potential = fvi_potential_harmonic(&one),
                                .force = fvi_force_step(step) };
    const fvi_run run = { &system,      &zero,        &zero,        h,
                          T * per_unit, .kappa = 0.5, .alpha = 0.75 };
    return matrix_method ? fvi_matrix_method(1, 1, 1, 0.75, system.force, h,
                                             T * per_unit, x)
                         : fvi_trajectory(&fvi_fractional, &run, x, NULL, NULL);
}

static void print(const char *title, size_t per_unit, size_t every,
                  const double *x)
{
    printf("# %s: t x\n", title);
    for (size_t k = 0; k <= T * per_unit; k += every)
        printf("%.17g %.17g\n", (double)k / (double)per_unit, x[k]);
    printf("\n\n");
}

/* Return the largest difference at t = 0, 0.1, ..., T. x has n nodes per unit of time, y has m. */
static double largest(const double *x, size_t n, const double *y, size_t m)
{
    double worst = 0;
    for (size_t j = 0; j <= TENTHS; j++)
        worst = larger(worst, fabs(x[j * n / 10] - y[j * m / 10]));
    return worst;
}

int main(void)
{
    static double x[MOST + 1], own[MOST + 1], benchmark[MOST + 1];
    const size_t per_unit[] = { 10, 20, 40, 50, 80, 100, 160, 200 };
    enum { ROWS = sizeof per_unit / sizeof *per_unit };
    double h[ROWS], error[ROWS], against[ROWS], slope, K, two, four;
    if (solve(10, 0, x) || solve(BENCHMARK, 1, benchmark))
        return EXIT_FAILURE;
    print("exact", 10, 5, ref_bagley_torvik);
    print("FVI, h = 0.1", 10, 1, x);
    print("matrix method, h = 0.005", BENCHMARK, 10, benchmark);
    printf("# h, error of the FVI, from the benchmark, error of the matrix "
           "method\n");
    for (size_t i = 0; i < ROWS; i++) {
        const size_t n = per_unit[i];
        if (solve(n, 0, x) || solve(n, 1, own))
            return EXIT_FAILURE;
        h[i] = 1 / (double)n;
        error[i] = largest(x, n, ref_bagley_torvik, 10);
        against[i] = largest(x, n, benchmark, BENCHMARK);
        printf("%.17g %.17g %.17g %.17g\n", h[i], error[i], against[i],
               largest(own, n, ref_bagley_torvik, 10));
    }
    if (fvi_observed_order(ROWS, h, error, &slope, &K)
        || fvi_observed_order(2, h, error, &two, NULL)
        || fvi_observed_order(4, h, against, &four, NULL))
        return EXIT_FAILURE;
    printf(
        "\n\n# against the exact solution: slope, factor, slope of the first "
        "two;\n# against the benchmark: slope of the first four\n"
        "%.17g %.17g %.17g %.17g\n",
        slope, K, two, four);
    return EXIT_SUCCESS;
}
