/* tests/bench/bench_chain.c -- H 12: the cost of a long chain.
 *
 * Prints three tables in some twenty seconds. The chain has d masses 1 between two walls, springs r + r^3 / 2, h
 * = 0.1 and kappa = 1/2. Each time is processor time for the steps alone, the least of several measurements. */
#define _POSIX_C_SOURCE 200809L /* clock_gettime, getrusage, uname */
#include <fvi/fvi.h>
#include "bench.h"
#include "system/larger.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/resource.h>

/* Return the seconds of N steps of d masses that start with x_i = cos(b i) and p_i = 1/2. */
static double run_once(const fvi_method *method, size_t d, size_t N, double b,
                       double damping, double alpha)
{
    static const double cg[] = { 1, 0.5 };
    double *mass = malloc(4 * d * sizeof *mass), *rho = mass + d,
           *x0 = mass + 2 * d, *p0 = mass + 3 * d;
    if (!mass)
        exit(EXIT_FAILURE);
    for (size_t i = 0; i < d; i++) {
        mass[i] = 1;
        rho[i] = damping;
        x0[i] = cos(b * (double)i);
        p0[i] = 0.5;
    }
    const fvi_system system = { .d = d,
                                .mass = mass,
                                .damping = rho,
                                .potential = fvi_potential_chain(cg) };
    const fvi_run run = { .system = &system,
                          .x0 = x0,
                          .p0 = p0,
                          .h = 0.1,
                          .steps = N,
                          .kappa = 0.5,
                          .alpha = alpha,
                          .memory = FVI_HISTORY_MODES };
    fvi_stepper *s;
    if (fvi_stepper_start(method, &run, &s, NULL))
        exit(EXIT_FAILURE);
    const double begin = now();
    while (s->k < N)
        if (fvi_stepper_step(s))
            exit(EXIT_FAILURE);
    const double seconds = now() - begin;
    fvi_stepper_free(s);
    free(mass);
    return seconds;
}

/* Print the ns for a mass and step, a row for each d. The runs have twenty steps from x_i = cos i. Every spring
 * is stretched, no two are alike, and Newton's method needs the same number of steps for every d. */
static void against_masses(const char *name, double damping)
{
    enum { N = 20 };
    static const fvi_method *const methods[] = { &fvi_fractional, &fvi_cq2_shifted,
                                                 &fvi_lobatto_m4 };
    printf("# ns per mass and step, %s\n#> %s\n# d\tfvi\tfvi-shifted"
           "\tfvi-lobatto4\n",
           damping > 0 ? "damping 1/5 of order 3/2, exponentials"
                       : "no damping",
           name);
    for (size_t d = 100; d <= 100000; d *= 10) {
        printf("%zu", d);
        for (size_t m = 0; m < sizeof methods / sizeof *methods; m++) {
            double best = 1e30, sum = 0;
            for (int i = 0; i < 3 || sum < 0.3; i++) {
                const double t = run_once(methods[m], d, N, 1, damping, 0.75);
                best = smaller(best, t);
                sum += t;
            }
            printf("\t%.0f", 1e9 * best / (double)(N * d));
        }
        printf("\n");
    }
    printf("#< %s\n\n\n", name);
}

/* Make the run of fvi run --potential chain:10000,1,0.5 --method fvi-shifted --steps 400. It comes first,
 * because the memory of a process is reported as its largest size so far. */
static void one_run(void)
{
    struct rusage usage;
    double best = 1e30;
    for (int i = 0; i < 3; i++)
        best = smaller(best, run_once(&fvi_cq2_shifted, 10000, 400, 0, 0.2, 0.5));
    getrusage(RUSAGE_SELF, &usage);
    printf("# fvi-shifted, 10^4 masses, 400 steps, damping 1/5 of order 1\n"
           "#> run\n# of what\tis\nseconds\t%.2f\nMB\t%.1f\n#< run\n\n\n",
           best, (double)usage.ru_maxrss / 1e3); /* kB on Linux */
}

int main(void)
{
    describe();
    one_run();
    against_masses("solver", 0);
    against_masses("memory", 0.2);
    return EXIT_SUCCESS;
}
