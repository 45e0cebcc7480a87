/* figures/fvi/fvi.c -- H 9: the error of the paper's problem as h goes to zero, with two pasts.
 *
 * The problem is x'' + x + D^{2 alpha} x / 5 = 0, x_0 = 1, p_0 = 1/2, kappa = 1/2, up to t = 2. Prints a block
 * for each alpha with the rows alpha, h, and the largest error of x at ten times: with the damping as printed
 * in the paper (Riemann-Liouville), and for a held body. The reference is the solution as a double series. */
#include <fvi/fvi.h>
#include "run/whole_run.h"
#include "system/larger.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static const double MASS = 1, RHO = 0.2, STIFFNESS = 1, X0 = 1, P0 = 0.5;
static const double T = 2;
enum { TIMES = 10, MOST = 5120 };

/* Return x(t), the inverse Laplace transform of a geometric series in (1 + rho s^b) / s^2, term by term. */
static double exact(double alpha, int held, double t)
{
    const double b = 2 * alpha, later = RHO * pow(t, 2 - b);
    double sum = 0;
    for (int i = 0; i < 15; i++)
        for (int j = 0; j < 40; j++) {
            double c = tgamma(i + j + 1) / tgamma(i + 1) / tgamma(j + 1)
                       * pow(-1, i) * pow(-RHO, j);
            double e = 2 * i + (2 - b) * j, x = c * X0 * pow(t, e),
                   v = c * P0 * pow(t, e + 1);
            sum += x / tgamma(e + 1) + v / tgamma(e + 2);
            if (held)
                sum += later * x / tgamma(e + 3 - b);
        }
    return sum;
}

static double error(double alpha, int held, size_t N)
{
    static double x[MOST + 1];
    const fvi_system system = { .d = 1,
                                .mass = &MASS,
                                .damping = &RHO,
                                .potential =
                                    fvi_potential_harmonic(&STIFFNESS) };
    const fvi_run run = { .system = &system,
                          .x0 = &X0,
                          .p0 = &P0,
                          .h = T / (double)N,
                          .steps = N,
                          .kappa = 0.5,
                          .alpha = alpha,
                          .past = held ? FVI_INITIAL_HISTORY_HELD
                                       : FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE };
    if (fvi_trajectory(&fvi_fractional, &run, x, NULL, NULL) != FVI_SUCCESS)
        exit(EXIT_FAILURE);
    double worst = 0;
    for (size_t i = 1; i <= TIMES; i++)
        worst =
            larger(worst, fabs(x[i * N / TIMES]
                               - exact(alpha, held, T * (double)i / TIMES)));
    return worst;
}

int main(void)
{
    const double alphas[] = { 0.25, 0.4, 0.6, 0.75, 0.9 };
    for (size_t i = 0; i < sizeof alphas / sizeof *alphas; i++) {
        printf("# alpha, h, error as printed, error of a held body; "
               "rho = 1/5, x0 = 1, p0 = 1/2, t <= 2\n");
        for (size_t N = 20; N <= MOST; N *= 2)
            printf("%.17g %.17g %.17g %.17g\n", alphas[i], T / (double)N,
                   error(alphas[i], 0, N), error(alphas[i], 1, N));
        printf("\n\n");
    }
    return EXIT_SUCCESS;
}
