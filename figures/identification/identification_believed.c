/* figures/identification/identification_believed.c -- H 24: three profiles of alpha from the same table.
 *
 * A profile is the least chi^2 at a fixed alpha over the other parameters, minus the least chi^2 of all. The
 * first two profiles use all 200 rows of measured.tsv, with rho and c free, and then with an offset of the
 * sensor free, too. The third one uses the first 25 rows with rho and c free. Prints a block for each profile:
 * alpha, the profile, and the parabola ((alpha - estimate) / standard deviation)^2. */
#include <fvi/fvi.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { GRID = 60 };

/* Return the least chi^2 at this alpha, over the other free parameters of the fit; NAN if the search fails. */
static double least(fvi_estimation fit, fvi_run run, double alpha, double sigma)
{
    fvi_estimate f;
    run.alpha = alpha;
    fit.run = &run;
    fit.sigma = sigma;
    fit.which++; /* skip alpha, which is the first free parameter */
    fit.parameters--;
    const int status = fvi_estimate_multistart(&fit, NULL, &f);
    return status && status != FVI_ETOL ? NAN : f.chi2;
}

static int print_profile(size_t n, const double *t, const double *x, size_t P, double low,
                         double high)
{
    static const fvi_free_parameter which[] = { FVI_FREE_PARAMETER_ALPHA,
                                                FVI_FREE_PARAMETER_RHO,
                                                FVI_FREE_PARAMETER_CONSTANT,
                                                FVI_FREE_PARAMETER_OFFSET };
    double m = 1, rho = 0.3, c = 1.1, x0 = 1, p0 = 0.25;
    const fvi_system system = { .d = 1,
                                .mass = &m,
                                .damping = &rho,
                                .potential = fvi_potential_harmonic(&c) };
    fvi_run run = fvi_run_default(&system, &x0, &p0, 1, 1);
    fvi_estimation fit = { .method = &fvi_lobatto_m4,
                           .run = &run,
                           .constants = &c,
                           .n = n,
                           .t = t,
                           .x = x,
                           .parameters = P,
                           .which = which,
                           .starts = 20 };
    fvi_estimate f;
    if (fvi_estimate_multistart(&fit, NULL, &f))
        return 1;
    fit.starts = 4;
    const double floor_of = least(fit, run, f.estimate[0], f.sigma);
    for (int i = 0; i <= GRID; i++) {
        const double alpha = low + (high - low) * i / GRID, away = (alpha - f.estimate[0]) / f.sd[0];
        printf("%.4f %.4f %.4f\n", alpha, least(fit, run, alpha, f.sigma) - floor_of, away * away);
    }
    printf("\n\n");
    return 0;
}

int main(void)
{
    const char *const names[] = { "t", "x" };
    size_t n;
    double *t, *x;
    fvi_error error;
    if (fvi_parse_table("DATA", "figures/identification/measured.tsv", names, &n, &t, &x, &error)) {
        fprintf(stderr, "%s\n", error.text);
        return 1;
    }
    const int failed = print_profile(n, t, x, 3, 0.27, 0.31) || print_profile(n, t, x, 4, 0.27, 0.32)
                       || print_profile(25, t, x, 3, 0.01, 0.5);
    free(t);
    return failed;
}
