/* figures/course/course_errors.c -- Chapter 10: the error against the step, and runs with steps that are too long.
 *
 * - Blocks 0 to 4, for alpha = 0, 1/4, 1/2, 3/4, 1: h and the error of x(2) of the running body.
 * - Blocks 5 to 7, for h = 3.1, 3.2, 3.4 and alpha = 1/4: k and |x_k| of the running body. */
#include <fvi/exact_solution.h>

#define main body_main
#pragma GCC diagnostic ignored "-Wreturn-type" /* main alone may end without a return */
#include "course/body_10.c"
#undef main

int main(void)
{
    const double two = 2, steps[] = { 3.1, 3.2, 3.4 };
    for (alpha = 0; alpha <= 1; alpha += 0.25) {
        const fvi_linear_oscillator motion = { .m = m, .c = c, .rho = rho, .alpha = alpha, .x0 = x0, .v0 = p0 / m };
        double exact;
        if (fvi_exact_at(&motion, 1, &two, &exact, NULL, NULL))
            return 1;
        printf("%s# h, error of x(2); alpha = %g\n", alpha > 0 ? "\n\n" : "", alpha);
        for (int N = 10; N <= 2560; N *= 2) {
            double found = at(2, N);
            printf("%.17g %.17g\n", h, fabs(found - exact));
        }
    }
    alpha = 0.25;
    for (int i = 0; i < 3; i++) {
        h = steps[i];
        run(60);
        printf("\n\n# k, size of x_k; h = %g\n", h);
        for (int k = 0; k <= 60; k++)
            printf("%d %.17g\n", k, fabs(x[k]));
    }
    return 0;
}
