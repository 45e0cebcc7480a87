/* figures/past/past.c -- H 19: four pasts and the motions that follow them.
 *
 * m = c = 1, rho = 1, x0 = 1, p0 = 1/2. Prints a block for each past: t from -4 to 12, and x, which is the path
 * that the damping assumes for t < 0 and the exact motion for t >= 0. For alpha = 1/4 the body is held (which
 * is Caputo's past, too), or it is at 0 and is then put at x0 (Riemann-Liouville). For alpha = 3/4 the body is
 * held, or it came along a straight line (Caputo). */
#include <fvi/exact_solution.h>

#include <stdio.h>
#include <stdlib.h>

enum { BEFORE = 4, AFTER = 12, FINE = 50 };

/* Return the x(t) that the damping assumes for t < 0. */
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
