/* figures/course/course_mass.c -- Chapter 8: the mass that the integrator seems to move.
 *
 * alpha = 1/2. Prints h, and the largest distance for t <= 14 of a run from the exact motion of the mass m, and
 * from the exact motion of the mass m - rho h/2. */
#define main body_main
#pragma GCC diagnostic ignored "-Wreturn-type" /* main alone may end without a return */
#include "course/body_08.c"
#undef main

int main(void)
{
    alpha = 0.5;
    printf("# h, error for the mass m, error for the mass m - rho h/2\n");
    for (h = 0.4; h > 0.006; h /= 2)
        printf("%.17g %.17g %.17g\n", h, error(14, m), error(14, m - rho * h / 2));
    return 0;
}
