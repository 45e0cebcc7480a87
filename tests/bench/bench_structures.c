/* tests/bench/bench_structures.c -- Chapter 27: what a long wave costs.
 *
 * u_tt + D^{1/2} u = u_xx on d points, from the first sine at rest, h = dx / 2, Algorithm 3
 * with kappa = 1: 1000 steps with the whole past. Against the same mode as one oscillator.
 * Two minutes, and 1.3 gigabytes at d = 10^6; a number of points as the argument runs that
 * one alone. */
#define _POSIX_C_SOURCE 200809L /* clock_gettime, getrusage, uname */
#include <fvi/fvi.h>
#include "../../figures/structures/wave.h"
#include "bench.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/resource.h>

enum { STEPS = 1000 };

static const double alpha = 0.25, rho = 1;

static fvi_run run_of(const fvi_system *system, double *x0, double *p0,
                      double h)
{
    fvi_run run = fvi_run_default(system, x0, p0, h, STEPS);
    run.alpha = alpha;
    run.kappa = 1;
    run.past = FVI_PAST_CAPUTO;
    run.memory = FVI_MEMORY_EXPONENTIALS;
    return run;
}

/* The amplitude after STEPS steps of the mode with eigenvalue k. */
static double one_oscillator(double k, double h)
{
    double one = 1, none = 0, x[STEPS + 1];
    const fvi_system system = { .d = 1,
                                .mass = &one,
                                .damping = &rho,
                                .potential = fvi_potential_harmonic(&k) };
    const fvi_run run = run_of(&system, &one, &none, h);
    if (fvi_trajectory(&fvi_fractional, &run, x, NULL, NULL))
        exit(EXIT_FAILURE);
    return x[STEPS];
}

static void wave(size_t d)
{
    const double pi = 3.14159265358979324, dx = 1 / ((double)d + 1);
    double *ones = malloc(3 * d * sizeof *ones), *x0 = ones + d, *p0 = x0 + d;
    if (!ones)
        exit(EXIT_FAILURE);
    for (size_t i = 0; i < d; i++) {
        ones[i] = 1; /* mass and damping, rho = 1 */
        x0[i] = sin(pi * dx * (double)(i + 1));
        p0[i] = 0;
    }
    const fvi_matrices matrices = wave_matrices(d, &rho);
    const fvi_system system = {
        .d = d, .mass = ones, .damping = ones, .matrices = &matrices
    };
    const fvi_run run = run_of(&system, x0, p0, dx / 2);
    const double begin = now(), centre = x0[d / 2], s = sin(pi * dx / 2) / dx;
    fvi_stepper *stepper;
    if (fvi_start(&fvi_fractional, &run, &stepper))
        exit(EXIT_FAILURE);
    while (stepper->k < STEPS)
        if (fvi_step(stepper))
            exit(EXIT_FAILURE);
    const double seconds = now() - begin,
                 want = one_oscillator(4 * s * s, dx / 2) * centre,
                 far = fabs(stepper->x[d / 2] - want);
    fvi_stop(stepper);
    free(ones);
    struct rusage used;
    getrusage(RUSAGE_SELF, &used);
    printf("%zu\t%.3g\t%.3g\t%.3g\t%.2g\n", d, seconds,
           1e9 * seconds / STEPS / (double)d,
           (double)used.ru_maxrss * 1024 / (double)d, far);
    fflush(stdout);
}

int main(int argc, char **argv)
{
    describe();
    printf("# u_tt + D^{1/2} u = u_xx, %d steps\n#> wave\n# d\tseconds\tns per "
           "unknown and step\tbytes per unknown\tdeviation at the centre\n",
           STEPS);
    if (argc > 1)
        wave((size_t)atol(argv[1]));
    for (size_t d = 1000; argc == 1 && d <= 1000000; d *= 10)
        wave(d);
    return 0;
}
