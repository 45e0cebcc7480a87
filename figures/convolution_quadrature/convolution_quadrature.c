/* figures/convolution_quadrature/convolution_quadrature.c -- H 13: the error against h of fvi, fvi-shifted and
 * fvi-bdf2.
 *
 * kappa = 1/2. Each row has h and the largest error of x with fvi, with fvi-shifted and with fvi-bdf2.
 * - Block 0: x'' + x + D^{3/2} x = 8 for t <= 1, then 0, from rest, up to T = 20, compared with the exact
 *   solution.
 * - Block 1: x'' + x + x^3 + D^{1/2} x = F up to T = 1, where F is chosen so that x = t^4. */
#include <fvi/fvi.h>
#include "run/whole_run.h"
#include "system/larger.h"

#include <gsl/gsl_math.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { MOST = 12800 };

static double x[MOST + 1], t[MOST + 1], want[MOST + 1];

/* Compute the force for which the Duffing oscillator moves as x = t^4, by
 * D^{1/2} t^4 = Gamma(5)/Gamma(9/2) t^(7/2). */
static int drive(double time, size_t d, void *params, double *F)
{
    const double q = gsl_pow_4(time);
    (void)d, (void)params;
    F[0] = 12 * time * time + q + q * q * q
           + tgamma(5) / tgamma(4.5) * pow(time, 3.5);
    return 0;
}

static double error(const fvi_method *method, const fvi_system *system,
                    double alpha, double T, size_t N)
{
    const double zero = 0;
    const fvi_run run = { .system = system,
                          .x0 = &zero,
                          .p0 = &zero,
                          .h = T / (double)N,
                          .steps = N,
                          .kappa = 0.5,
                          .alpha = alpha };
    double most = 0;
    if (fvi_trajectory(method, &run, x, NULL, NULL) != FVI_SUCCESS)
        exit(EXIT_FAILURE);
    for (size_t k = 0; k <= N; k++)
        most = larger(most, fabs(x[k] - want[k]));
    return most;
}

static void row(const fvi_system *system, double alpha, double T, size_t N)
{
    printf("%.17g %.17g %.17g %.17g\n", T / (double)N,
           error(&fvi_fractional, system, alpha, T, N),
           error(&fvi_cq2_shifted, system, alpha, T, N),
           error(&fvi_cq_bdf2, system, alpha, T, N));
}

int main(void)
{
    const double one = 1, spring[] = { 1, 1 }, step[] = { 8, 1 };
    const fvi_system torvik = {
        1, &one, &one, fvi_potential_harmonic(&one), fvi_force_step(step), NULL, NULL
    };
    const fvi_system duffing = {
        1, &one, &one, fvi_potential_duffing(spring), { .value = drive }, NULL, NULL
    };
    const fvi_linear_oscillator problem = { .m = 1,
                                 .c = 1,
                                 .rho = 1,
                                 .alpha = 0.75,
                                 .forcing = FVI_FORCING_STEP,
                                 .A = 8,
                                 .T = 1 };
    printf("# h, max |error of x|: fvi, fvi-shifted, fvi-bdf2 (Bagley-Torvik, "
           "T = 20)\n");
    for (size_t N = 200; N <= MOST; N *= 2) {
        for (size_t k = 0; k <= N; k++)
            t[k] = (double)k * (20 / (double)N);
        if (fvi_exact_at(&problem, N + 1, t, want, NULL, NULL))
            return EXIT_FAILURE;
        row(&torvik, 0.75, 20, N);
    }
    printf("\n\n# the same for the driven Duffing oscillator, alpha = 1/4, "
           "T = 1\n");
    for (size_t N = 20; N <= 2560; N *= 2) {
        for (size_t k = 0; k <= N; k++)
            want[k] = gsl_pow_4((double)k / (double)N);
        row(&duffing, 0.25, 1, N);
    }
    return EXIT_SUCCESS;
}
