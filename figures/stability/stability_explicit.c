/* figures/stability/stability_explicit.c -- H 14: the stable steps of Euler's explicit method.
 *
 * A load above 1 (fvi_stability_number) means that the step is unstable.
 * - Block 0: h omega = sqrt(W), then the least and the largest R = rho h / m with load <= 1, by bisection of
 *   the load.
 * - Block 1: the same by bisection of runs of 4000 steps. A run is unstable if its second half is larger than
 *   the first. */
#include <fvi/fvi.h>
#include "run/whole_run.h"
#include "system/larger.h"

#include <math.h>
#include <stdio.h>

enum { STEPS = 4000 };

static double x[STEPS + 1];

static fvi_run scalar(const double *W, const double *R)
{
    static const double one = 1, zero = 0;
    static fvi_system system;
    system = (fvi_system){ 1, &one, R, fvi_potential_harmonic(W), { 0 }, NULL, NULL };
    return fvi_run_default(&system, &zero, &one, 1, STEPS);
}

static int has_load(double W, double R)
{
    const fvi_run run = scalar(&W, &R);
    double load = NAN;
    fvi_stability_number(&fvi_euler_explicit, &run, &load);
    return load > 1;
}

static int grows(double W, double R)
{
    const fvi_run run = scalar(&W, &R);
    double half[2] = { 0, 0 };
    if (fvi_trajectory(&fvi_euler_explicit, &run, x, NULL, NULL))
        return 1;
    for (size_t k = 0; k <= STEPS; k++)
        half[k > STEPS / 2] = larger(half[k > STEPS / 2], fabs(x[k]));
    return half[1] > half[0];
}

/* Return the last R between good, which is stable, and end for which the function bad returns 0, by bisection. */
static double edge(int (*bad)(double, double), double W, double good,
                   double end)
{
    for (int i = 0; i < 30; i++) {
        const double middle = (good + end) / 2;
        *(bad(W, middle) ? &end : &good) = middle;
    }
    return good;
}

static void block(int (*bad)(double, double), int points)
{
    for (int i = 1; i < points; i++) {
        const double w = 2. * i / points, W = w * w, inside = 1 + 0.75 * W;
        printf("%.10g %.10g %.10g\n", w, edge(bad, W, inside, 0),
               edge(bad, W, inside, 6));
    }
}

int main(void)
{
    printf("# h omega, least and largest R with load <= 1\n");
    block(has_load, 100);
    printf("\n\n# the same, by runs\n");
    block(grows, 16);
    return 0;
}
