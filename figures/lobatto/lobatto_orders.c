/* figures/lobatto/lobatto_orders.c -- H 17: the observed orders of three methods with stages, for every alpha.
 *
 * The problem is x'' + x + 0.3 D^{2 alpha} x = 0, x_0 = 1, p_0 = 1/2, with Caputo's past. Prints a block for
 * each number of stages s = 2, 3, 4: alpha, then the orders of x and of p. An order is the slope of the largest
 * error on 1 <= t <= 4, over the last three steps h, h/2, h/4 whose errors are above rounding. */
#include <fvi/error.h>
#include "run/whole_run.h"
#include <fvi/exact_solution.h>
#include <fvi/lobatto.h>
#include "system/larger.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { MOST = 1280, STEPS = 9 };
static const double RHO = 0.3, X0 = 1, P0 = 0.5, FLOOR = 1e-13;
static double x[MOST + 1], p[MOST + 1], t[MOST + 1], exact_x[MOST + 1],
    exact_p[MOST + 1];

static double farthest(size_t N, const double *v, const double *w)
{
    double worst = 0;
    for (size_t k = N / 4; k <= N; k++)
        worst = larger(worst, fabs(v[k] - w[k]));
    return worst;
}

static void errors(const fvi_method *method, double alpha, size_t N, double *ex,
                   double *ep)
{
    const double one = 1;
    const fvi_system system = { 1,     &one, &RHO, fvi_potential_harmonic(&one),
                                { 0 }, NULL, NULL };
    const fvi_run run = { .system = &system,
                          .x0 = &X0,
                          .p0 = &P0,
                          .h = 4 / (double)N,
                          .steps = N,
                          .alpha = alpha,
                          .past = FVI_INITIAL_HISTORY_CAPUTO };
    const fvi_linear_oscillator problem = { .m = 1,
                                 .c = 1,
                                 .rho = RHO,
                                 .alpha = alpha,
                                 .past = FVI_INITIAL_HISTORY_CAPUTO,
                                 .x0 = X0,
                                 .v0 = P0 };
    for (size_t k = 0; k <= N; k++)
        t[k] = (double)k * run.h;
    if (fvi_trajectory(method, &run, x, p, NULL)
        || fvi_exact_at(&problem, N + 1, t, exact_x, exact_p, NULL))
        exit(EXIT_FAILURE);
    *ex = farthest(N, x, exact_x);
    *ep = farthest(N, p, exact_p);
}

static double slope(const double *e)
{
    size_t last = 0;
    while (last < STEPS && e[last] > FLOOR)
        last++;
    return log2(e[last - 3] / e[last - 1]) / 2;
}

int main(void)
{
    const fvi_method *const methods[] = { &fvi_lobatto_m2, &fvi_lobatto_m3,
                                          &fvi_lobatto_m4 };
    for (size_t s = 2; s <= 4; s++) {
        printf("# alpha, order of x, order of p, s = %zu; x0 = 1, p0 = 1/2, "
               "rho = 0.3, 1 <= t <= 4\n",
               s);
        for (int i = 0; i <= 20; i++) {
            double ex[STEPS], ep[STEPS];
            for (size_t j = 0; j < STEPS; j++)
                errors(methods[s - 2], i * 0.05, (size_t)4 << j, ex + j,
                       ep + j);
            printf("%.17g %.17g %.17g\n", i * 0.05, slope(ex), slope(ep));
        }
        printf("\n\n");
    }
    return EXIT_SUCCESS;
}
