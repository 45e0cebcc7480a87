/* figures/damping_laws/damping_laws_motion.c -- H 26: the motion of one mass and spring with four laws of damping.
 *
 * m = c = 1; the body is held at 1 and let go at rest. Prints a block for each law of laws.h: t and x of a run
 * of fvi-bdf2 with h = 1/32 up to t = 1000. Every fourth row is printed up to t = 32, then rows at equal
 * distances in ln t. */
#include <fvi/fvi.h>
#include "run/whole_run.h"
#include "laws.h"

#include <stdio.h>
#include <stdlib.h>

enum { N = 32000, FIRST = 1024 };

int main(void)
{
    const double one = 1, x0 = 1, p0 = 0;
    const fvi_system system = { .d = 1,
                                .mass = &one,
                                .damping = &one,
                                .potential = fvi_potential_harmonic(&one) };
    static double x[N + 1];
    printf("# t, x; fvi-bdf2, h = 1/32\n");
    for (int i = 0; i < LAWS; i++) {
        const fvi_kernel_term term = scaled(i);
        const fvi_kernel law = { 1, &term };
        fvi_run run = fvi_run_default(&system, &x0, &p0, 1.0 / 32, N);
        run.law = &law;
        if (fvi_trajectory(&fvi_cq_bdf2, &run, x, NULL, NULL))
            return EXIT_FAILURE;
        printf("%s# %s\n", i ? "\n\n" : "", laws[i].name);
        for (size_t k = 0; k <= N; k += k < FIRST ? 4 : k / 64)
            printf("%.17g %.17g\n", (double)k / 32, x[k]);
    }
    return EXIT_SUCCESS;
}
