/* figures/discrete_principle/discrete_principle.c -- H 6: which derivatives of the discrete action vanish along a
 * solution and its mirror image.
 *
 * Prints the derivatives of the discrete action along a solution x and a mirrored solution y: with respect to x
 * alone, and restricted to equal variations of x and y. The restricted derivatives are printed for the action
 * with and without its end term, and for a y whose kappa is that of x, where the mirror image needs 1 - kappa.
 * The two nonzero ones stand beside their predictions (6.7) and (6.9). */
#include <fvi/fvi.h>
#include "run/whole_run.h"
#include <fvi/paper/discrete_principle.h>
#include "system/larger.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { N = 60 };

static const double h = 0.1, alpha = 0.3, kappa = 0.25;
static const double m = 1, rho = 0.5, cg[] = { 1, 2 };

/* Return |g|, but not 0, which can occur by rounding: the axis is logarithmic. */
static double drawn(double g)
{
    return larger(fabs(g), 1e-19);
}

/* Return the derivative U' of the Duffing potential at z. */
static double spring(double z)
{
    return (cg[0] + cg[1] * z * z) * z;
}

int main(void)
{
    const fvi_system system = { .d = 1,
                                .mass = &m,
                                .damping = &rho,
                                .potential = fvi_potential_duffing(cg) };
    const double x0 = 1, p0 = 0.5;
    double x[N + 1], z[N + 1], y[N + 1], same[N + 1], w[N + 1];
    double gx[N + 1], gy[N + 1], px[N + 1], py[N + 1], sx[N + 1], sy[N + 1];
    fvi_run run = { .system = &system,
                    .x0 = &x0,
                    .p0 = &p0,
                    .h = h,
                    .steps = N,
                    .kappa = kappa,
                    .alpha = alpha,
                    .past = FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE };
    int bad = fvi_trajectory(&fvi_fractional, &run, x, NULL, NULL);
    run.kappa = 1 - kappa;
    bad |= fvi_trajectory(&fvi_fractional, &run, z, NULL, NULL);
    for (size_t k = 0; !bad && k <= N; k++) {
        y[k] = z[N - k];
        same[k] = x[N - k];
    }
    bad = bad || fvi_gl_weights(alpha, N + 1, w)
          || fvi_discrete_action_gradient(&system, alpha, kappa, h, N, 0, N, x,
                                          y, gx, gy)
          || fvi_discrete_action_gradient(&system, alpha, kappa, h, N, 0, N - 1,
                                          x, y, px, py)
          || fvi_discrete_action_gradient(&system, alpha, kappa, h, N, 0, N, x,
                                          same, sx, sy);
    if (bad)
        return EXIT_FAILURE;

    printf("# k  |D_x| unrestricted  |restricted|, sum to N  to N - 1"
           "  predicted  same kappa  predicted\n"
           "# (d = 1, Duffing %g %g, rho = %g, alpha = %g, kappa = %g, h = %g, "
           "N = %d)\n",
           cg[0], cg[1], rho, alpha, kappa, h, N);
    for (size_t k = 1; k < N; k++) {
        double end = h * rho * pow(h, -2 * alpha) * w[N - k] * y[N]; /* (6.7) */
        double defect = 0;                                           /* (6.9) */
        for (int side = -1; side <= 1; side += 2) {
            double a = same[k], b = same[(int)k + side];
            defect -= side * h
                      * (kappa * spring(kappa * a + (1 - kappa) * b)
                         - (1 - kappa) * spring(kappa * b + (1 - kappa) * a));
        }
        printf("%zu %.17g %.17g %.17g %.17g %.17g %.17g\n", k, drawn(gx[k]),
               drawn(gx[k] + gy[k]), drawn(px[k] + py[k]), drawn(end),
               drawn(sx[k] + sy[k]), drawn(defect));
    }
    return EXIT_SUCCESS;
}
