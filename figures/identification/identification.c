/* figures/identification/identification.c -- H 24: noisy data, the fitted curve, and the residuals.
 *
 * The truth has m = c = 1, rho = 0.4, alpha = 0.3, x0 = 1, p0 = 1/4, held. The data are its exact motion at t =
 * 0.1, 0.2, ..., 20 with Gaussian noise of sigma = 0.02. Five parameters are fitted, from other initial values.
 * - Block 0: t, data, fit, residual / sigma.
 * - Block 1: the name of each parameter, its estimate, its standard deviation, its true value. */
#include <fvi/fvi.h>

#include <gsl/gsl_randist.h>
#include <gsl/gsl_rng.h>
#include <stdio.h>

enum { N = 200, P = 5 };

int main(void)
{
    const fvi_linear_oscillator truth = {
        .m = 1, .c = 1, .rho = 0.4, .alpha = 0.3, .x0 = 1, .v0 = 0.25
    };
    const fvi_free_parameter which[P] = { FVI_FREE_PARAMETER_ALPHA, FVI_FREE_PARAMETER_RHO,
                                     FVI_FREE_PARAMETER_CONSTANT, FVI_FREE_PARAMETER_X0,
                                     FVI_FREE_PARAMETER_P0 };
    const char *const name[P] = { "alpha", "rho", "c", "x0", "p0" };
    const double put_in[P] = { 0.3, 0.4, 1, 1, 0.25 }, sigma = 0.02, m = 1,
                 rho = 0.2, x0 = 0.9, p0 = 0.5;
    double c = 2, t[N], x[N], curve[N];
    gsl_rng *r = gsl_rng_alloc(gsl_rng_mt19937);
    for (int i = 0; i < N; i++)
        t[i] = 0.1 * (i + 1);
    if (fvi_exact_at(&truth, N, t, x, NULL, NULL))
        return 1;
    for (int i = 0; i < N; i++)
        x[i] += gsl_ran_gaussian(r, sigma);
    gsl_rng_free(r);

    const fvi_system system = { .d = 1,
                                .mass = &m,
                                .damping = &rho,
                                .potential = fvi_potential_harmonic(&c) };
    const fvi_run run = fvi_run_default(&system, &x0, &p0, 1, 1);
    const fvi_estimation fit = { .method = &fvi_lobatto_m4,
                          .run = &run,
                          .constants = &c,
                          .n = N,
                          .t = t,
                          .x = x,
                          .sigma = sigma,
                          .parameters = P,
                          .which = which,
                          .starts = 20 };
    fvi_estimate f;
    if (fvi_estimate_multistart(&fit, curve, &f))
        return 1;
    for (int i = 0; i < N; i++)
        printf("%g %.6f %.6f %.4f\n", t[i], x[i], curve[i],
               (x[i] - curve[i]) / sigma);
    printf("\n\n");
    for (int j = 0; j < P; j++)
        printf("%s %.4f %.4f %g\n", name[j], f.estimate[j], f.sd[j], put_in[j]);
    return 0;
}
