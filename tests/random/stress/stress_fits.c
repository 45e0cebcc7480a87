/* tests/random/stress/stress_fits.c -- Are the errors of a fit as large as it says, and does it find the truth? */
#include "identification/identification_ref.h"
#include "stress.h"
#include "system/larger.h"

#include <gsl/gsl_math.h>
#include <gsl/gsl_randist.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

enum { P = 3, SETS = 500, MANY = 100 };
static const double SIGMA = 0.02;

/* Fit alpha, rho and c to noisy data. All other parameters are known. */
static int fit_of(const double *t, const double *x, const fvi_linear_oscillator *begin,
                  size_t starts, fvi_estimate *f)
{
    static const fvi_free_parameter which[P] = { FVI_FREE_PARAMETER_ALPHA,
                                            FVI_FREE_PARAMETER_RHO,
                                            FVI_FREE_PARAMETER_CONSTANT };
    double c = begin->c;
    const double p0 = begin->m * begin->v0;
    const fvi_system system = { .d = 1,
                                .mass = &begin->m,
                                .damping = &begin->rho,
                                .potential = fvi_potential_harmonic(&c) };
    fvi_run run = fvi_run_default(&system, &begin->x0, &p0, 1, 1);
    run.alpha = begin->alpha;
    const fvi_estimation fit = { .method = &fvi_lobatto_m4,
                          .run = &run,
                          .constants = &c,
                          .n = REF_POINTS,
                          .t = t,
                          .x = x,
                          .sigma = SIGMA,
                          .parameters = P,
                          .which = which,
                          .starts = starts };
    return fvi_estimate_multistart(&fit, NULL, f);
}

static void noisy(gsl_rng *random, const double *exact, double *x)
{
    for (size_t i = 0; i < REF_POINTS; i++)
        x[i] = exact[i] + gsl_ran_gaussian(random, SIGMA);
}

/* Compare the scatter of 500 estimates with (24.3) at the truth, and count how many of 500 intervals hold the
 * truth. Four standard deviations of both are allowed: 4 / sqrt(2 * 500) of the scatter, 4 sqrt(0.95 * 0.05 /
 * 500) of the share. The start is 50 % off. */
double stress_scatter(gsl_rng *random, char *describe, size_t size)
{
    const double *truth = ref_errors[0].truth;
    const fvi_linear_oscillator begin = { .m = 1,
                               .c = 1.5,
                               .rho = 0.2,
                               .alpha = 0.45,
                               .x0 = truth[3],
                               .v0 = truth[4] };
    double t[REF_POINTS], x[REF_POINTS], square[P] = { 0 }, used = 0;
    int held[P] = { 0 }, written = 0;
    for (size_t i = 0; i < REF_POINTS; i++)
        t[i] = 0.1 * (double)(i + 1);
    for (int set = 0; set < SETS; set++) {
        fvi_estimate f;
        noisy(random, ref_low, x);
        if (fit_of(t, x, &begin, 4, &f))
            return GSL_POSINF;
        for (int j = 0; j < P; j++) {
            const double off = f.estimate[j] - truth[j];
            square[j] += off * off / SETS;
            held[j] += fabs(off) <= f.quantile * f.sd[j];
        }
    }
    for (int j = 0; j < P; j++) {
        const double scatter = sqrt(square[j]) / (SIGMA * ref_errors[0].sd[j]),
                     share = (double)held[j] / SETS;
        used = larger(used, fabs(scatter - 1) / (4 / sqrt(2. * SETS)));
        used =
            larger(used, fabs(share - 0.95) / (4 * sqrt(0.95 * 0.05 / SETS)));
        written += snprintf(describe + written, size - (size_t)written,
                            "%sscatter %.3f, %.1f %% held", j ? "; " : "",
                            scatter, 100 * share);
    }
    return used;
}

/* Fit 100 data sets of the two motions of an independent program, each from 20 starts that do not depend on
 * them. At most 5 fits may fail. A fit succeeds if alpha, rho and c are within 3 standard deviations. A fit may
 * take a second. */
double stress_found(gsl_rng *random, char *describe, size_t size)
{
    double t[REF_POINTS], x[REF_POINTS], longest = 0;
    int missed = 0;
    for (size_t i = 0; i < REF_POINTS; i++)
        t[i] = 0.1 * (double)(i + 1);
    for (int set = 0; set < MANY; set++) {
        const double *truth = ref_errors[set % 2 ? 2 : 0].truth;
        const fvi_linear_oscillator begin = { .m = 1,
                                   .c = 2.5,
                                   .rho = 0.2,
                                   .alpha = 0.5,
                                   .x0 = truth[3],
                                   .v0 = truth[4] };
        fvi_estimate f;
        noisy(random, set % 2 ? ref_high : ref_low, x);
        const clock_t began = clock();
        int near = fit_of(t, x, &begin, 20, &f) == 0;
        longest = larger(longest, (double)(clock() - began) / CLOCKS_PER_SEC);
        for (int j = 0; j < P && near; j++)
            near = fabs(f.estimate[j] - truth[j]) <= 3 * f.sd[j];
        missed += !near;
    }
    snprintf(describe, size, "%d of %d missed, %.2f s at most", missed, MANY,
             longest);
    return larger(missed / 5., longest);
}
