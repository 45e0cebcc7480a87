/* figures/stability/stability_stages.c -- H 14: the stable steps of fvi-lobatto3 with friction, alpha = 1/2.
 *
 * m = h = 1.
 * - Block 0: h omega = sqrt(W) with W from 8 to 12, and the R on the ellipse (W - 8)(W - 12) + 8 R^2 = 0.
 * - Block 1: the same R by bisection of runs of 20000 steps. A run is unstable if its second half is larger
 *   than the first.
 * - Block 2: the h omega near sqrt(24) at which runs begin to grow, and R. */
#include <fvi/fvi.h>
#include "run/whole_run.h"
#include "system/larger.h"

#include <math.h>
#include <stdio.h>

enum { STEPS = 20000, POINTS = 24 };

static double x[STEPS + 1];

static int grows(double W, double R)
{
    const double one = 1, zero = 0;
    const fvi_system system = { 1,     &one, &R, fvi_potential_harmonic(&W),
                                { 0 }, NULL, NULL };
    fvi_run run = fvi_run_default(&system, &zero, &one, 1, STEPS);
    run.alpha = 0.5;
    double half[2] = { 0, 0 };
    if (fvi_trajectory(&fvi_lobatto_m3, &run, x, NULL, NULL))
        return 1;
    for (size_t k = 0; k <= STEPS; k++)
        half[k > STEPS / 2] = larger(half[k > STEPS / 2], fabs(x[k]));
    return half[1] > half[0];
}

int main(void)
{
    for (int i = 0; i <= 200; i++) {
        const double W = 8 + 4 * (0.5 - 0.5 * cos(M_PI * i / 200));
        printf("%.9g %.9g\n", sqrt(W), sqrt(larger(0, (W - 8) * (12 - W) / 8)));
    }
    printf("\n\n");
    for (int i = 1; i < POINTS; i++) {
        const double W = 8 + 4. * i / POINTS;
        double low = 0.01, high = 1;
        for (int j = 0; j < 30; j++) {
            const double middle = (low + high) / 2;
            *(grows(W, middle) ? &low : &high) = middle;
        }
        printf("%.9g %.9g\n", sqrt(W), low);
    }
    printf("\n\n");
    for (int i = 1; i <= 10; i++) {
        double low = 4, high = 5.2;
        for (int j = 0; j < 30; j++) {
            const double middle = (low + high) / 2;
            *(grows(middle * middle, i / 10.) ? &high : &low) = middle;
        }
        printf("%.9g %.9g\n", low, i / 10.);
    }
    return 0;
}
