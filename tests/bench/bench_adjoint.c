/* tests/bench/bench_adjoint.c -- H 23: the cost of an adjoint run.
 *
 * Prints a table in some seconds. The system is a Duffing oscillator with F = cos(t)/4, h = 1/128, alpha = 5/16.
 * Each time is processor time for a step, the least of several measurements: of the run; of the adjoint run along
 * a given path with all derivatives except that by alpha; of the same with all derivatives; and of both runs if
 * no path is kept, so that the forward run is made twice. */
#define _POSIX_C_SOURCE 200809L /* clock_gettime, uname */
#include <fvi/fvi.h>
#include "run/whole_run.h"
#include "bench.h"

#include <math.h>
#include <stdlib.h>

static int slopes(size_t k, size_t d, const double *x, const double *p,
                  void *params, double *Jx, double *Jp)
{
    const fvi_run *run = params;
    (void)d;
    Jx[0] = run->h * x[0];
    if (k == run->steps)
        Jp[0] = p[0];
    return 0;
}

static double least(double a, double b)
{
    return a < b ? a : b;
}

static int measure(size_t N, int times)
{
    const double m = 1, rho = 0.375, cg[] = { 1, 0.5 }, aw[] = { 0.25, 1 },
                 x0 = 1, p0 = 0.5;
    const fvi_system system = { .d = 1,
                                .mass = &m,
                                .damping = &rho,
                                .potential = fvi_potential_duffing(cg),
                                .force = fvi_force_cosine(aw) };
    fvi_run run = fvi_run_default(&system, &x0, &p0, 1. / 128, N);
    run.alpha = 0.3125;
    double *x = malloc(3 * (N + 1) * sizeof *x), out[7], best[4];
    if (!x)
        return 1;
    double *p = x + N + 1, *force = p + N + 1;
    const fvi_objective J = { .slopes = slopes, .params = &run };
    fvi_sensitivities all = { .x0 = out,
                          .p0 = out + 1,
                          .mass = out + 2,
                          .damping = out + 3,
                          .alpha = out + 4,
                          .parameters = out + 5,
                          .force = force,
                          .sensitivity =
                              fvi_parameter_gradient_of(&system.potential) };
    fvi_sensitivities but_alpha = all;
    but_alpha.alpha = NULL;
    int status = 0;
    for (int i = 0; i < 4; i++)
        best[i] = INFINITY;
    for (int i = 0; i < times && !status; i++) {
        double start = now();
        status |= fvi_trajectory(&fvi_fractional, &run, x, p, NULL);
        best[0] = least(best[0], now() - start);
        start = now();
        status |= fvi_adjoint(&fvi_fractional, &run, x, p + N, &J, &but_alpha);
        best[1] = least(best[1], now() - start);
        start = now();
        status |= fvi_adjoint(&fvi_fractional, &run, x, p + N, &J, &all);
        best[2] = least(best[2], now() - start);
        start = now();
        status |= fvi_adjoint(&fvi_fractional, &run, NULL, NULL, &J, &all);
        best[3] = least(best[3], now() - start);
    }
    printf("%8zu", N);
    for (int i = 0; i < 4; i++)
        printf("\t%.1f", best[i] / (double)N * 1e9);
    printf("\t%.2f\t\t%.2f\n", best[1] / best[0], best[2] / best[0]);
    fflush(stdout);
    free(x);
    return status;
}

int main(void)
{
    printf("# tests/bench/bench_adjoint.c: ns a step\n");
    describe();
    printf("#> ratio\n"
           "#  steps\trun\tback\t+ alpha\tboth\tback/run\tthat + alpha\n");
    const int failed =
        measure(2000, 400) || measure(20000, 60) || measure(1000000, 20);
    printf("#< ratio\n");
    return failed;
}
