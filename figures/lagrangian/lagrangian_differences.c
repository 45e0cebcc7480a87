/* figures/lagrangian/lagrangian_differences.c -- A body on a strut, by an action and by differences.
 *
 * Prints t, then x1, x2, E, J of the integrator that comes from an action (stage 13 of the Course), then E, J,
 * x1, x2 of the scheme by differences (tests/lagrangian/strut_differences.h). E is the energy, J the angular
 * momentum. Both runs go up to t = 400.
 * - Block 0: steps of 0.2.
 * - Block 1: steps of 0.025, every 40 units of time. It serves as the reference. */
#define main body_main
#pragma GCC diagnostic ignored "-Wreturn-type" /* main alone may end without a return */
#include "course/body_13.c"
#undef main
#include "../tests/lagrangian/strut_differences.h"

static void print_run(double step_length, int steps, int every)
{
    h = step_length;
    run(steps);
    run_differences(steps);
    for (int k = 0; k <= steps; k += every)
        printf("%.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g\n", k * h, x[k][0], x[k][1], energy(k),
               turning(k), energy_differenced(k), turning_differenced(k), x_differenced[k][0], x_differenced[k][1]);
}

int main(void)
{
    printf("# t, x1, x2, E, J, and E, J, x1, x2 by differences: h = 0.2\n");
    print_run(0.2, 2000, 1);
    printf("\n\n# h = 0.025\n");
    print_run(0.025, 16000, 1600);
    return 0;
}
