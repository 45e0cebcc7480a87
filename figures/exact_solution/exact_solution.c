/* figures/exact_solution/exact_solution.c -- H 11: a solution as the sum of an oscillation and a tail.
 *
 * m = c = 1, rho = 1/2, released at rest from x0 = 1, Caputo's past. Prints a block for alpha = 1/4 and one for
 * alpha = 3/4: t, x, the oscillation, the tail. */
#include <fvi/exact_solution.h>

#include <stdio.h>
#include <stdlib.h>

enum { COUNT = 601 };

static double t[COUNT], x[COUNT], wave[COUNT];

static int solve(double alpha)
{
    const fvi_linear_oscillator p = { .m = 1,
                           .c = 1,
                           .rho = 0.5,
                           .alpha = alpha,
                           .past = FVI_INITIAL_HISTORY_CAPUTO,
                           .x0 = 1 };
    double re, im;
    for (size_t i = 0; i < COUNT; i++)
        t[i] = 30.0 * (double)i / (COUNT - 1);
    if (fvi_exact_at(&p, COUNT, t, x, NULL, NULL)
        || fvi_exact_oscillation(&p, COUNT, t, wave, NULL, NULL)
        || fvi_exact_pole(&p, &re, &im, NULL))
        return 1;
    printf(
        "# alpha = %g, m = c = 1, rho = 1/2, Caputo, x0 = 1, v0 = 0; the pole "
        "is %.17g + %.17g i\n# t  x  oscillation  tail\n",
        alpha, re, im);
    for (size_t i = 0; i < COUNT; i++)
        printf("%.17g %.17g %.17g %.17g\n", t[i], x[i], wave[i],
               x[i] - wave[i]);
    printf("\n\n");
    return 0;
}

int main(void)
{
    return solve(0.25) || solve(0.75) ? EXIT_FAILURE : EXIT_SUCCESS;
}
