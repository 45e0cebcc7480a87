/* figures/past/past.c -- H 19: pasts and their futures.
 *
 * m = c = 1, rho = 1, x0 = 1, p0 = 1/2; t and x from t = -4 to 12, the past as the
 * damping sees it and the exact motion that follows: for alpha = 1/4 at 0 and then
 * put at x0 (Riemann-Liouville), and held (as Caputo has it); for alpha = 3/4 held,
 * and come along the straight line (Caputo). A line for each point, a block for each
 * past. */
#include <fvi/exact_solution.h>

#include <stdio.h>
#include <stdlib.h>

enum { BEFORE = 4, AFTER = 12, FINE = 50 };

/* What a damping of this order takes for the path before t = 0. */
static double before(const fvi_linear_oscillator *p, double t)
{
    if (p->past == FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE)
        return 0;
    return p->x0 + (p->past == FVI_INITIAL_HISTORY_CAPUTO ? t * p->v0 : 0);
}

static int draw(fvi_initial_history past, double alpha)
{
    const fvi_linear_oscillator p = { .m = 1,
                           .c = 1,
                           .rho = 1,
                           .alpha = alpha,
                           .past = past,
                           .x0 = 1,
                           .v0 = 0.5 };
    for (int k = -BEFORE * FINE; k < 0; k++)
        printf("%g %.17g\n", (double)k / FINE, before(&p, (double)k / FINE));
    printf("0 %.17g\n", before(&p, 0));
    for (int k = 0; k <= AFTER * FINE; k++) {
        double t = (double)k / FINE, x;
        if (fvi_exact_at(&p, 1, &t, &x, NULL, NULL))
            return EXIT_FAILURE;
        printf("%g %.17g\n", t, x);
    }
    printf("\n\n");
    return EXIT_SUCCESS;
}

int main(void)
{
    return draw(FVI_INITIAL_HISTORY_HELD, 0.25) || draw(FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE, 0.25)
           || draw(FVI_INITIAL_HISTORY_HELD, 0.75) || draw(FVI_INITIAL_HISTORY_CAPUTO, 0.75);
}
