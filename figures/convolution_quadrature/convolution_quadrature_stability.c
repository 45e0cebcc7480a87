/* figures/convolution_quadrature/convolution_quadrature_stability.c -- H 13: the steps for which fvi, fvi-shifted
 * and fvi-bdf2 are stable, and the growth with trapezoidal weights.
 *
 * kappa = 1/2 and m = h = 1, so W = c and R = rho.
 * - Block 0: alpha, then the largest stable R for W = 1, measured and predicted, for fvi, fvi-shifted and
 *   fvi-bdf2. The measured R comes from bisection: a run of 1000 steps is unstable if its alternating part is
 *   larger in the second half.
 * - Blocks 1 to 4, for alpha = 1/4 and W = 1, one each for fvi, fvi-shifted, fvi-bdf2 and trapezoidal weights:
 *   R, the predicted growth factor of one step minus 1, and the measured one, from runs of up to 1500 steps. */
#include <fvi/fvi.h>
#include "run/whole_run.h"
#include "system/larger.h"

#include <math.h>
#include <stdio.h>

enum { STEPS = 1000, LONG = 1500 };

static double x[LONG + 1], w[LONG + 1];

/* Return 1 if the alternating part of a run grows. The body starts at rest in 0 and is pushed by a force until t = 1.
 * Its history is zero at the start, so the three methods can be compared. */
static int grows(const fvi_method *method, double alpha, double R)
{
    const double one = 1, zero = 0, push[] = { 1, 1 };
    const fvi_system system = {
        1, &one, &R, fvi_potential_harmonic(&one), fvi_force_step(push), NULL, NULL
    };
    const fvi_run run = { .system = &system,
                          .x0 = &zero,
                          .p0 = &zero,
                          .h = 1,
                          .steps = STEPS,
                          .kappa = 0.5,
                          .alpha = alpha,
                          .memory = FVI_HISTORY_DIRECT };
    double half[2] = { 0, 0 };
    if (fvi_trajectory(method, &run, x, NULL, NULL))
        return 1;
    for (size_t k = 1; k < STEPS; k++) {
        double *most = &half[k > STEPS / 2];
        *most = larger(*most, fabs(x[k + 1] - 2 * x[k] + x[k - 1]));
    }
    return half[1] > half[0];
}

static double measured(const fvi_method *method, double alpha, double guess)
{
    double low = 0.8 * guess, high = 1.25 * guess;
    for (int i = 0; i < 11; i++) {
        double middle = (low + high) / 2;
        if (grows(method, alpha, middle))
            high = middle;
        else
            low = middle;
    }
    return low;
}

static void boundaries(void)
{
    printf("# alpha  measured, predicted largest R: fvi  fvi-shifted  "
           "fvi-bdf2\n");
    for (int i = 1; i <= 200; i++) {
        const double a = i / 200.0, euler = pow(4, 1 - a),
                     shifted = i < 100 ? euler / (1 - 2 * a) : NAN,
                     bdf2 = pow(4, 1 - 2 * a);
        if (i % 20)
            printf("%.17g NaN %.17g NaN %.17g NaN %.17g\n", a, euler, shifted,
                   bdf2);
        else
            printf("%.17g %.17g %.17g %.17g %.17g %.17g %.17g\n", a,
                   measured(&fvi_fractional, a, euler), euler,
                   isnan(shifted) ? NAN : measured(&fvi_cq2_shifted, a, shifted),
                   shifted, measured(&fvi_cq_bdf2, a, bdf2), bdf2);
    }
}

static void growths(fvi_delta kind, double theta, const char *name)
{
    const double alpha = 0.25;
    printf("\n\n# %s, alpha = 1/4: R, growth - 1 predicted, measured\n", name);
    fvi_cq_weights(kind, 2 * alpha, LONG + 1, w);
    for (int i = 0; i <= 160; i++) {
        const double R = pow(10, -2 + 0.025 * i);
        double growth;
        fvi_cq_amplification(kind, theta, alpha, 0.5, 1, R, &growth);
        if (growth == 1)
            continue;
        /* Stop when the growing part has reached 10^100. Measure only if it grows by 10^6: then it dominates. */
        const double enough = smaller(LONG, 230 / log(growth));
        if (i % 10 || pow(growth, enough) < 1e6) {
            printf("%.17g %.17g NaN\n", R, growth - 1);
            continue;
        }
        const size_t n = (size_t)enough, half = n / 2;
        fvi_cq_oscillator(w, theta, 0.5, 1, R, n, x);
        printf("%.17g %.17g %.17g\n", R, growth - 1,
               pow(fabs(x[n] / x[half]), 1 / (double)(n - half)) - 1);
    }
}

int main(void)
{
    boundaries();
    growths(FVI_DELTA_EULER, 0, "fvi");
    growths(FVI_DELTA_EULER, 0.25, "fvi-shifted");
    growths(FVI_DELTA_BDF2, 0, "fvi-bdf2");
    growths(FVI_DELTA_TRAPEZOID, 0, "trapezoidal weights");
    return 0;
}
