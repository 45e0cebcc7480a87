/* figures/course/course_seven.c -- Chapter 6: the running body for seven orders of its damping.
 *
 * Prints a block for each alpha: t, the exact x at steps of h = 0.1, and at every tenth node the x of a run of
 * stage 6 (elsewhere "-"). */
#include <fvi/exact_solution.h>

/* course_front.c includes this file with a later stage. */
#ifndef STAGE
#define STAGE "course/body_06.c"
#define SET_UP_STAGE (void)0
#endif
#define main body_main
#pragma GCC diagnostic ignored "-Wreturn-type" /* main alone may end without a return */
#include STAGE
#undef main

enum { LAST = 140, EVERY = 10 };

int main(void)
{
    const double alphas[] = { 0, 0.25, 0.4, 0.5, 0.6, 0.75, 1 };
    SET_UP_STAGE;
    for (int i = 0; i < 7; i++) {
        alpha = alphas[i];
        run(LAST);
        printf("%s# t, exact x, x of the run; alpha = %g\n", i ? "\n\n" : "", alpha);
        const fvi_linear_oscillator motion = { .m = m, .c = c, .rho = rho, .alpha = alpha, .x0 = x0, .v0 = p0 / m };
        for (int k = 0; k <= LAST; k++) {
            const double t = k * h;
            double exact;
            if (fvi_exact_at(&motion, 1, &t, &exact, NULL, NULL))
                return 1;
            printf("%.17g %.17g ", t, exact);
            if (k % EVERY)
                printf("-\n");
            else
                printf("%.17g\n", x[k]);
        }
    }
    return 0;
}
