/* figures/fvi/fvi_rounding.c -- H 9: the rounding errors of two forms of the same equation.
 *
 * The Bagley-Torvik problem x'' + x + D^{3/2} x = 8 for t <= 1, then 0, from rest, with kappa = 1/2, up to t =
 * 20 in N steps. Prints N and the largest difference of x from the same recurrence in long double, for
 * Algorithm 3 as printed in the paper and for the momentum form. */
#include <fvi/fvi.h>
#include "run/whole_run.h"
#include <fvi/paper/algorithm_3.h>
#include "system/larger.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { MOST = 10240 };
static const double T = 20;

/* Compute x by (9.4) in long double. The memory sums over the increments of x. */
static void in_long_double(size_t N, const double aT[2], long double *x)
{
    static long double w[MOST + 1], dx[MOST + 1];
    const long double h = T / (double)N;
    long double p = 0;
    w[0] = 1;
    x[0] = dx[0] = 0;
    for (size_t n = 1; n <= N; n++)
        w[n] = w[n - 1] * ((long double)n - 1.5L) / (long double)n;
    for (size_t k = 1; k <= N; k++) {
        long double H = 0;
        dx[k] = (p - h / 2 * x[k - 1]) / (1 / h + h / 4);
        x[k] = x[k - 1] + dx[k];
        for (size_t n = 0; n < k; n++)
            H += w[n] * dx[k - n];
        double F = (double)k * (double)h <= aT[1] ? aT[0] : 0;
        p += h * (F - (x[k] + x[k - 1]) / 2) - H / sqrtl(h);
    }
}

int main(void)
{
    static double x[MOST + 1], printed[MOST + 1];
    static long double want[MOST + 1];
    const double aT[] = { 8, 1 }, one = 1, zero = 0;
    const fvi_system system = {
        1, &one, &one, fvi_potential_harmonic(&one), fvi_force_step(aT), NULL, NULL
    };
    printf("# N, error as printed, error of the momentum form; Bagley-Torvik, "
           "t <= 20, alpha = 3/4\n");
    for (size_t N = 80; N <= MOST; N *= 2) {
        const double h = T / (double)N;
        const fvi_run run = { .system = &system,
                              .x0 = &zero,
                              .p0 = &zero,
                              .h = h,
                              .steps = N,
                              .kappa = 0.5,
                              .alpha = 0.75,
                              .memory = FVI_HISTORY_DIRECT };
        if (fvi_trajectory(&fvi_fractional, &run, x, NULL, NULL)
            || fvi_algorithm_3(&system, 0.75, 0.5, h, N, 0, 0, printed))
            return EXIT_FAILURE;
        in_long_double(N, aT, want);
        double off = 0, off_printed = 0;
        for (size_t k = 0; k <= N; k++) {
            off = larger(off, (double)fabsl(x[k] - want[k]));
            off_printed =
                larger(off_printed, (double)fabsl(printed[k] - want[k]));
        }
        printf("%zu %.17g %.17g\n", N, off_printed, off);
    }
    return EXIT_SUCCESS;
}
