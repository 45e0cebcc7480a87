/* figures/exact_solution/exact_solution_tail.c -- H 11: the algebraic tail of a solution, after the oscillation has
 * died out.
 *
 * m = c = 1, rho = 1/2. Prints |x| at logarithmically spaced times and the predicted tail (11.9), in a block
 * for each of four alpha: first for x0 = 0, v0 = 1, then for a body released at rest from x0 = 1 with Caputo's
 * past. "-" stands for the tail at t < 20, and at alpha = 1/2, which has none. */
#include <fvi/exact_solution.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { COUNT = 1000 };

static double t[COUNT], x[COUNT];

static int solve(double alpha, int caputo)
{
    const double b = 2 * alpha, rho = 0.5;
    const fvi_linear_oscillator p = { .m = 1,
                           .c = 1,
                           .rho = rho,
                           .alpha = alpha,
                           .past = caputo ? FVI_INITIAL_HISTORY_CAPUTO
                                          : FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE,
                           .x0 = caputo,
                           .v0 = !caputo };
    const double power = caputo ? -b : -1 - b;
    const double factor = rho / tgamma(power + 1); /* 0 at alpha = 1/2 */
    if (fvi_exact_at(&p, COUNT, t, x, NULL, NULL))
        return 1;
    printf("# alpha = %g, m = c = 1, rho = 1/2, %s\n# t  |x|  tail\n", alpha,
           caputo ? "Caputo, x0 = 1, v0 = 0" : "x0 = 0, v0 = 1");
    for (size_t i = 0; i < COUNT; i++) {
        printf("%.17g %.17g ", t[i], fabs(x[i]));
        if (alpha == 0.5 || t[i] < 20)
            printf("-\n");
        else
            printf("%.17g\n", fabs(factor) * pow(t[i], power));
    }
    printf("\n\n");
    return 0;
}

int main(void)
{
    const double alphas[] = { 0.25, 0.4, 0.5, 0.75 };
    for (size_t i = 0; i < COUNT; i++)
        t[i] = pow(10, -0.5 + 4.5 * (double)i / (COUNT - 1));
    for (size_t i = 0; i < 8; i++)
        if (solve(alphas[i % 4], i >= 4))
            return EXIT_FAILURE;
    return EXIT_SUCCESS;
}
