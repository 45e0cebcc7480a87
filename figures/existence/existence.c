/* figures/existence/existence.c -- H 15: the iterates of Picard's map, and how fast they converge.
 *
 * The equation is that of a pendulum, x'' + sin x + D^(3/2) (x - x0) = 0 with x0 = 0.5, v0 = 1. The iteration
 * starts with v = v0.
 * - Block 0: t, the velocities v_n of the iterates n = 0, ..., 6, and the limit v.
 * - Blocks 1 and 2, on [0, 4], where q > 10, and on [0, 1/4], where q < 1: n, the largest |v_n - v|, its bounds
 *   by q^n and by e_n, q, and the length of the interval. */
#include <fvi/error.h>
#include <fvi/paper/existence.h>
#include "system/larger.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { N = 400, SHOWN = 7, MOST = 120, TIMES = 60 };

static double v[MOST + 1][N + 1];

static double pendulum(double x, double velocity, const void *params)
{
    (void)velocity, (void)params;
    return -sin(x);
}

static const fvi_picard_problem problem = { pendulum, NULL, 0.75, 1, 0.5, 1 };

static int iterate(double d)
{
    static double x[N + 1];
    int status = FVI_SUCCESS;
    for (size_t k = 0; k <= N; k++)
        v[0][k] = problem.v0;
    for (size_t n = 0; n < MOST && !status; n++)
        status = fvi_picard(&problem, d / N, N, v[n], x, v[n + 1]);
    return status;
}

static void rate(double d)
{
    double q = fvi_picard_constant(problem.alpha, problem.R, 1, 0, d),
           start = 0;
    printf("\n\n# n  |v_n - v|  q^n |v_0 - v|  e_n |v_0 - v|  q  d\n");
    for (size_t n = 0; n <= TIMES; n++) {
        double most = 0;
        for (size_t k = 0; k <= N; k++)
            most = larger(most, fabs(v[n][k] - v[MOST][k]));
        if (n == 0)
            start = most;
        double e = fvi_picard_bound(problem.alpha, problem.R, 1, 0, d, n);
        printf("%zu %.17g %.17g %.17g %.17g %.17g\n", n, most,
               start * pow(q, (double)n), start * e, q, d);
    }
}

int main(void)
{
    const double longer = 4, shorter = 0.25;
    if (iterate(longer))
        return EXIT_FAILURE;
    printf("# t  v_0 ... v_%d  limit\n", SHOWN - 1);
    for (size_t k = 0; k <= N; k++) {
        printf("%.17g", longer * (double)k / N);
        for (size_t n = 0; n < SHOWN; n++)
            printf(" %.17g", v[n][k]);
        printf(" %.17g\n", v[MOST][k]);
    }
    rate(longer);
    if (iterate(shorter))
        return EXIT_FAILURE;
    rate(shorter);
    return EXIT_SUCCESS;
}
