/* figures/exact_solution/exact_solution_plane.c -- H 11: the poles of X(s) in the plane of s.
 *
 * m = c = 1. Blocks 0 to 2, for alpha = 1/4, 1/2, 3/4: the real and the imaginary part of the zero of Q in the
 * upper half plane, for rho that grows from 0. Block 3: these three zeros at rho = 1/2. */
#include <fvi/fvi.h>

#include <stdio.h>
#include <stdlib.h>

static int pole(double alpha, double rho)
{
    const fvi_linear_oscillator linear = { .m = 1,
                                .c = 1,
                                .rho = rho,
                                .alpha = alpha,
                                .past = FVI_INITIAL_HISTORY_HELD,
                                .x0 = 1 };
    double re, im;
    if (fvi_exact_pole(&linear, &re, &im, NULL))
        return EXIT_FAILURE;
    printf("%.9g %.9g\n", re, im);
    return EXIT_SUCCESS;
}

int main(void)
{
    const double most[] = { 2.5, 1.999, 2.5 };
    printf("# Re s, Im s\n");
    for (int i = 0; i < 3; i++) {
        for (int n = 0; n <= 200; n++)
            if (pole((i + 1) / 4.0, most[i] * n / 200))
                return EXIT_FAILURE;
        printf("\n\n");
    }
    for (int i = 0; i < 3; i++)
        if (pole((i + 1) / 4.0, 0.5))
            return EXIT_FAILURE;
    return EXIT_SUCCESS;
}
