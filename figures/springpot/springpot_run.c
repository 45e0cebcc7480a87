/* figures/springpot/springpot_run.c -- H 0: the first run, by the library and by a ladder.
 *
 * m = c = 1, rho = 1/2, alpha = 1/4; the body is held at 1 and let go.
 * - Block 0: t, x of a run of the library.
 * - Block 1: t, x_0, x_30, x_100, x_300 of a ladder whose node 0 carries the mass.
 * - Block 2: t, x of a second run. It starts at t = 2.8 with the x and p that the first run has then, but it
 *   was held there before.
 * - Block 3: t, x_0 of a second ladder, which starts at t = 2.8 with all its nodes at that x. */
#include <fvi/fvi.h>
#include "first_run.h"

#include <stdio.h>
#include <stdlib.h>

int main(void)
{
    static double x[ROWS + 1], p[ROWS + 1], other[ROWS + 1];
    ladder l = first_ladder(1, 0), fresh = l;
    if (first_run(1, 0, x, p) || first_run(x[FORK], p[FORK], other, p))
        return EXIT_FAILURE;
    printf("# t, x\n");
    for (int n = 0; n <= ROWS; n += 5)
        printf("%.9g %.9g\n", STEP * n, x[n]);
    printf("\n\n# t, x_0, x_30, x_100, x_300 of the ladder\n");
    for (int n = 0; n <= ROWS; n++) {
        if (n == FORK)
            fresh = first_ladder(l.x[0], l.v);
        if (n % 10 == 0)
            printf("%.9g %.9g %.9g %.9g %.9g\n", STEP * n, l.x[0], l.x[30],
                   l.x[100], l.x[300]);
        ladder_step(&l, STEP, 0);
    }
    printf("\n\n# t, x of the run that starts at t = 2.8\n");
    for (int n = 0; n <= ROWS - FORK; n += 5)
        printf("%.9g %.9g\n", STEP * (FORK + n), other[n]);
    printf("\n\n# t, x_0 of the ladder that starts at t = 2.8\n");
    for (int n = FORK; n <= ROWS; n++) {
        if (n % 10 == 0)
            printf("%.9g %.9g\n", STEP * n, fresh.x[0]);
        ladder_step(&fresh, STEP, 0);
    }
    return EXIT_SUCCESS;
}
