/* figures/identification/identification_landscape.c -- H 24: the false minima of chi^2.
 *
 * The truth has m = c = 1, rho = 0.05, alpha = 0.3, x0 = 1, p0 = 1/4, held. The data are its exact motion at
 * 200 times up to 60 with Gaussian noise of sigma = 0.02. The mean is the mean square of the residuals divided
 * by sigma^2.
 * - Block 0: alpha, c and the mean, with the true rho.
 * - Block 1: alpha, c and the mean where those searches end that begin in the local
 *   minima of this grid.
 * - Block 2: c, then the least mean over alpha, and the least mean over alpha and rho. */
#include <fvi/fvi.h>
#include "run/whole_run.h"

#include <gsl/gsl_math.h>
#include <gsl/gsl_randist.h>
#include <gsl/gsl_rng.h>
#include <stdio.h>

enum { N = 200, PARTS = 2, ALPHAS = 49, SPRINGS = 141, SLICES = 70 };
static double t[N], data[N];
static const double sigma = 0.02;

/* Return the mean of (x(t_i) - x_i)^2 / sigma^2, infinity if the run fails. */
static double cost(double alpha, double rho, double c)
{
    static double x[N * PARTS + 1];
    const double m = 1, x0 = 1, p0 = 0.25;
    const fvi_system system = { .d = 1,
                                .mass = &m,
                                .damping = &rho,
                                .potential = fvi_potential_harmonic(&c) };
    fvi_run run =
        fvi_run_default(&system, &x0, &p0, t[N - 1] / (N * PARTS), N * PARTS);
    double sum = 0;
    run.alpha = alpha;
    if (fvi_trajectory(&fvi_lobatto_m3, &run, x, NULL, NULL))
        return GSL_POSINF;
    for (int i = 0; i < N; i++)
        sum += gsl_pow_2((x[(i + 1) * PARTS] - data[i]) / sigma) / N;
    return sum;
}

static double alpha_at(int i)
{
    return 0.02 + 0.96 * i / (ALPHAS - 1);
}

static double c_at(int j)
{
    return 0.2 * pow(25, (double)j / (SPRINGS - 1));
}

/* Return the least mean over the P parameters `which` in the box from low to high, by searches from `starts` places.
 * Parameters that are not free keep rho = 0.05 and the given c. theta: P numbers, where the least mean is. */
static double least(size_t P, const fvi_free_parameter *which, const double *low,
                    const double *high, size_t starts, double c, double *theta)
{
    const double m = 1, rho = 0.05, x0 = 1, p0 = 0.25;
    const fvi_system system = { .d = 1,
                                .mass = &m,
                                .damping = &rho,
                                .potential = fvi_potential_harmonic(&c) };
    fvi_run run = fvi_run_default(&system, &x0, &p0, 1, 1);
    run.alpha = low[0];
    const fvi_estimation fit = { .method = &fvi_lobatto_m3,
                          .run = &run,
                          .constants = &c,
                          .n = N,
                          .t = t,
                          .x = data,
                          .sigma = sigma,
                          .parameters = P,
                          .which = which,
                          .low = low,
                          .high = high,
                          .starts = starts,
                          .h = 0.15 };
    fvi_estimate f;
    fvi_estimate_multistart(&fit, NULL, &f);
    for (size_t j = 0; j < P; j++)
        theta[j] = f.estimate[j];
    return f.chi2 / N;
}

static double map[ALPHAS][SPRINGS];

static int is_minimum(int i, int j)
{
    for (int a = i - 1; a <= i + 1; a++)
        for (int b = j - 1; b <= j + 1; b++)
            if (a >= 0 && b >= 0 && a < ALPHAS && b < SPRINGS
                && map[a][b] < map[i][j])
                return 0;
    return 1;
}

int main(void)
{
    const fvi_linear_oscillator truth = {
        .m = 1, .c = 1, .rho = 0.05, .alpha = 0.3, .x0 = 1, .v0 = 0.25
    };
    gsl_rng *r = gsl_rng_alloc(gsl_rng_mt19937);
    for (int i = 0; i < N; i++)
        t[i] = 0.3 * (i + 1);
    if (fvi_exact_at(&truth, N, t, data, NULL, NULL))
        return 1;
    for (int i = 0; i < N; i++)
        data[i] += gsl_ran_gaussian(r, sigma);
    gsl_rng_free(r);

    for (int i = 0; i < ALPHAS; i++, printf("\n"))
        for (int j = 0; j < SPRINGS; j++) {
            map[i][j] = cost(alpha_at(i), 0.05, c_at(j));
            printf("%.3f %.4f %.4g\n", alpha_at(i), c_at(j), map[i][j]);
        }
    printf("\n");
    const fvi_free_parameter with_c[] = { FVI_FREE_PARAMETER_ALPHA,
                                     FVI_FREE_PARAMETER_CONSTANT },
                        with_rho[] = { FVI_FREE_PARAMETER_ALPHA, FVI_FREE_PARAMETER_RHO };
    double theta[2];
    for (int i = 0; i < ALPHAS; i++)
        for (int j = 0; j < SPRINGS; j++)
            if (is_minimum(i, j)) {
                const double low[] = { alpha_at(i), c_at(j) },
                             high[] = { low[0] + 1e-6, low[1] + 1e-6 };
                const double mean =
                    least(2, with_c, low, high, 2, low[1], theta);
                printf("%.3f %.3f %.4g\n", theta[0], theta[1], mean);
            }
    printf("\n\n");
    for (int j = 0; j < SLICES; j++) {
        const double c = 0.2 * pow(25, (double)j / (SLICES - 1)),
                     low[] = { 0.05, 0.01 }, high[] = { 0.95, 3 };
        const double known = least(1, with_rho, low, high, 6, c, theta);
        printf("%.4f %.4g %.4g\n", c, known,
               least(2, with_rho, low, high, 12, c, theta));
    }
    return 0;
}
