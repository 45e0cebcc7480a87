/* figures/lagrangian/lagrangian.c -- H 29: an elastic pendulum without weight, with a springpot strut or with two
 * dampers along the axes.
 *
 * Computes everything with stage 13 of the Course. J is the angular momentum.
 * - Block 0: t, x1, x2 with the damper along the strut.
 * - Block 1: t, E, J - J(0) with the damper along the strut. J is conserved.
 * - Block 2: t, E, J - J(0) with two dampers along the axes. J is not conserved. */
#define main body_main
#pragma GCC diagnostic ignored "-Wreturn-type" /* main alone may end without a return */
#include "course/body_13.c"
#undef main

enum { LAST = 1200 };

static void print_energy_and_turning(void)
{
    for (int k = 0; k <= LAST; k++)
        printf("%.17g %.17g %.17g\n", k * h, energy(k), turning(k) - turning(0));
}

int main(void)
{
    run(LAST);
    printf("# t, x1, x2\n");
    for (int k = 0; k <= LAST; k++)
        printf("%.17g %.17g %.17g\n", k * h, x[k][0], x[k][1]);
    printf("\n\n# t, E, J - J(0): the strut\n");
    print_energy_and_turning();
    strut = 0;
    run(LAST);
    printf("\n\n# t, E, J - J(0): dampers along the axes\n");
    print_energy_and_turning();
    return 0;
}
