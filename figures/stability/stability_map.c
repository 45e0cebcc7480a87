/* figures/stability/stability_map.c -- H 14: the largest stable damping of eight methods, on one map.
 *
 * - Block 0: alpha, then for each method of the list the least unstable R = rho h^(2 - 2 alpha) / m, that is,
 *   with a load above 1; W = 0.001, kappa = 1/2. NaN if there is none up to 2000.
 * - Block 1: h omega = sqrt(W), then the same for alpha = 1/4. */
#include <fvi/fvi.h>

#include <math.h>
#include <stdio.h>

static const fvi_method *const list[] = { &fvi_fractional, &fvi_cq2_shifted,
                                          &fvi_cq_bdf2,       &fvi_lobatto_m2,
                                          &fvi_lobatto_m3,   &fvi_lobatto_m4,
                                          &fvi_lobatto_m6,   &fvi_lobatto_m8 };
enum { COUNT = sizeof list / sizeof *list };

static double load(const fvi_method *method, double alpha, double W, double R)
{
    const double one = 1, zero = 0;
    const fvi_system system = { 1,     &one, &R, fvi_potential_harmonic(&W),
                                { 0 }, NULL, NULL };
    fvi_run run = fvi_run_default(&system, &zero, &zero, 1, 1);
    double load = NAN;
    run.alpha = alpha;
    fvi_stability_number(method, &run, &load);
    return load;
}

/* Return the least unstable R, NAN if there is none up to 2000. Search upwards in steps of 5 per cent, then bisect. */
static double least(const fvi_method *method, double alpha, double W)
{
    double low = 1e-3, high = low;
    if (load(method, alpha, W, low) > 1)
        return low;
    while (load(method, alpha, W, high) <= 1) {
        low = high;
        high *= 1.05;
        if (high > 2000)
            return NAN;
    }
    for (int i = 0; i < 12; i++) {
        const double middle = (low + high) / 2;
        *(load(method, alpha, W, middle) > 1 ? &high : &low) = middle;
    }
    return high;
}

int main(void)
{
    printf("# alpha, least unstable R:");
    for (int m = 0; m < COUNT; m++)
        printf(" %s", list[m]->name);
    for (int i = 1; i <= 49; i++) {
        printf("\n%.2f", i / 50.);
        for (int m = 0; m < COUNT; m++)
            printf(" %.10g", least(list[m], i / 50., 1e-3));
    }
    printf("\n\n\n# h omega, the same, alpha = 1/4");
    for (int i = 1; i <= 160; i++) {
        const double w = i / 20.;
        printf("\n%.4f", w);
        for (int m = 0; m < COUNT; m++)
            printf(" %.10g", least(list[m], 0.25, w * w));
    }
    putchar('\n');
    return 0;
}
