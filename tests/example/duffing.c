/* tests/example/duffing.c -- The example of README.md, from C. */
#include <fvi/fvi.h>

#include <stdio.h>

//> example
/* Duffing's oscillator with fractional damping, let go at 1 with momentum 1/2. */
int main(void)
{
    const double one = 1, spring[] = { 1, 0.5 }, rho = 0.4, p0 = 0.5;
    const fvi_system system = { .d = 1,
                                .mass = &one,
                                .damping = &rho,
                                .potential = fvi_potential_duffing(spring) };
    fvi_run run = fvi_run_default(&system, &one, &p0, 0.1, 200);
    run.alpha = 0.3; /* the rest is at rest until t = 0 */
    double x[201];
    const int status = fvi_trajectory(&fvi_lobatto_m3, &run, x, NULL, NULL);
    for (size_t k = 0; status == 0 && k <= 200; k++)
        printf("%.17g\t%.17g\n", (double)k * run.h, x[k]);
    return status;
}
//< example
