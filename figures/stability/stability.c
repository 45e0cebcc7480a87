/* figures/stability/stability.c -- H 14: the largest stable step of fvi, and the growth beyond it.
 *
 * W = c h^2 / m and R = rho h^(2 - 2 alpha) / m; h = m = 1.
 * - Block 0: alpha, then the measured and the predicted largest stable R for W = 1, with kappa = 1/2 and with
 *   kappa = 0. The measured R comes from bisection: a run of 4000 steps is unstable if its second half is
 *   larger than the first.
 * - Blocks 1 to 3, for alpha = 1/4, 1/2, 3/4 at kappa = 1/2, W = 1: R / (largest stable R), the measured growth
 *   factor of one step, and the predicted factor 1/|z|. */
#include <fvi/fvi.h>
#include "system/larger.h"

#include <math.h>
#include <stdio.h>

enum { STEPS = 4000 };

static double x[STEPS + 1];

/* Make a run with h = m = 1 into x, until it ends, fails or exceeds 10^200. Return the number of the last step. */
static size_t scalar_run(double alpha, double kappa, double W, double R)
{
    const double one = 1, zero = 0;
    const fvi_system system = { 1,     &one, &R, fvi_potential_harmonic(&W),
                                { 0 }, NULL, NULL };
    const fvi_run run = { .system = &system,
                          .x0 = &zero,
                          .p0 = &one,
                          .h = 1,
                          .steps = STEPS,
                          .kappa = kappa,
                          .alpha = alpha };
    fvi_stepper *s;
    if (fvi_stepper_start(&fvi_fractional, &run, &s, NULL))
        return 0;
    size_t reached = 0;
    x[0] = 0;
    while (reached < STEPS && fvi_stepper_step(s) == FVI_SUCCESS
           && fabs(s->x[0]) < 1e200)
        x[reached = s->k] = s->x[0];
    fvi_stepper_free(s);
    return reached;
}

static int grows(double alpha, double kappa, double W, double R)
{
    double half[2] = { 0, 0 };
    if (scalar_run(alpha, kappa, W, R) < STEPS)
        return 1;
    for (size_t k = 0; k <= STEPS; k++)
        half[k > STEPS / 2] = larger(half[k > STEPS / 2], fabs(x[k]));
    return half[1] > 1.01 * half[0]; /* with alpha = 0 a stable run keeps its size, so allow 1 % */
}

static double measured_bound(double alpha, double kappa, double W, double guess)
{
    double low = 0.8 * guess, high = 1.2 * guess;
    for (int i = 0; i < 14; i++) {
        double middle = (low + high) / 2;
        if (grows(alpha, kappa, W, middle))
            high = middle;
        else
            low = middle;
    }
    return low;
}

/* Return the growth factor of one step, from the last tenth of a run. */
static double measured_growth(double alpha, double W, double R)
{
    size_t n = scalar_run(alpha, 0.5, W, R);
    size_t tenth = n / 10;
    return exp(log(fabs(x[n] / x[n - tenth])) / (double)tenth);
}

int main(void)
{
    printf("# alpha  measured, predicted R for kappa = 1/2  "
           "measured, predicted R for kappa = 0, W = 1\n");
    for (int i = 0; i <= 20; i++) {
        double a = i / 20.0, half = pow(4, 1 - a), zero = 3 / pow(4, a);
        printf("%.17g", a);
        if (i % 2 == 0)
            printf(" %.17g %.17g %.17g %.17g\n",
                   measured_bound(a, 0.5, 1, half), half,
                   measured_bound(a, 0, 1, zero), zero);
        else
            printf(" NaN %.17g NaN %.17g\n", half, zero);
    }
    const double alphas[] = { 0.25, 0.5, 0.75 };
    for (size_t i = 0; i < 3; i++) {
        printf("\n\n# alpha = %g: R / bound, measured growth, 1/|z|\n",
               alphas[i]);
        for (int j = 1; j <= 10; j++) {
            double ratio = 1 + 0.02 * j, R = ratio * pow(4, 1 - alphas[i]),
                   growth;
            fvi_amplification(alphas[i], 0.5, 1, R, &growth);
            printf("%.17g %.17g %.17g\n", ratio,
                   measured_growth(alphas[i], 1, R), growth);
        }
    }
    return 0;
}
