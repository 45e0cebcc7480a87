/* figures/lobatto/lobatto.c -- H 17: the error against h of three methods with stages, for the problem of Bagley
 * and Torvik.
 *
 * The problem is x'' + x + D^{3/2} x = 8 for t <= 1, then 0, from rest. Prints a block for each number of
 * stages s = 2, 3, 4: h, then the largest errors of x, of p and of the corrected p on 2 <= t <= 20, without the
 * last two nodes. */
#include <fvi/error.h>
#include "run/whole_run.h"
#include <fvi/exact_solution.h>
#include <fvi/lobatto.h>
#include "system/larger.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { MOST = 5120 };
static double x[MOST + 1], p[MOST + 1], t[MOST + 1], exact_x[MOST + 1],
    exact_p[MOST + 1];

static double farthest(size_t N, const double *v, const double *w)
{
    double worst = 0;
    for (size_t k = N / 10; k + 2 <= N; k++)
        worst = larger(worst, fabs(v[k] - w[k]));
    return worst;
}

static void row(const fvi_method *method, size_t N)
{
    const double one = 1, zero = 0, aT[] = { 8, 1 };
    const fvi_system system = {
        1, &one, &one, fvi_potential_harmonic(&one), fvi_force_step(aT), NULL, NULL
    };
    const fvi_run run = { .system = &system,
                          .x0 = &zero,
                          .p0 = &zero,
                          .h = 20 / (double)N,
                          .steps = N,
                          .alpha = 0.75 };
    const fvi_linear_oscillator problem = { .m = 1,
                                 .c = 1,
                                 .rho = 1,
                                 .alpha = 0.75,
                                 .forcing = FVI_FORCING_STEP,
                                 .A = 8,
                                 .T = 1 };
    for (size_t k = 0; k <= N; k++)
        t[k] = (double)k * run.h;
    if (fvi_trajectory(method, &run, x, p, NULL)
        || fvi_exact_at(&problem, N + 1, t, exact_x, exact_p, NULL))
        exit(EXIT_FAILURE);
    printf("%.17g %.17g %.17g", run.h, farthest(N, x, exact_x),
           farthest(N, p, exact_p));
    fvi_lobatto_correct_momenta(method, &run, x, p);
    printf(" %.17g\n", farthest(N, p, exact_p));
}

int main(void)
{
    const fvi_method *const methods[] = { &fvi_lobatto_m2, &fvi_lobatto_m3,
                                          &fvi_lobatto_m4 };
    for (size_t s = 2; s <= 4; s++) {
        printf("# h, errors of x, p and corrected p, s = %zu; Bagley-Torvik, "
               "2 <= t <= 20\n",
               s);
        for (size_t N = 40; N <= (s == 4 ? MOST / 4 : MOST); N *= 2)
            row(methods[s - 2], N);
        printf("\n\n");
    }
    return EXIT_SUCCESS;
}
