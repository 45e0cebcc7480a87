/* tests/bench/bench_variable_steps.c -- H 22: the cost of steps of any length.
 *
 * Prints tables, which are kept in figures/variable_steps/variable_steps.tsv: `make bench`.
 *
 *       plate     x'' + D^{3/2} x + x = 8 for t <= 1, then 0, at rest, T = 20
 *       late      the same, with the jump at t = 0.7310585
 *       spring    x'' + 0.2 x' + x = 0, x(0) = 1, x'(0) = 1/2, T = 20
 *       duffing   x'' + 0.5 D^{0.6} x + x^3 = cos t, at rest, T = 50
 *       chain     32 masses between walls, springs r + r^3, 0.2 D^{0.6} on each, T = 20
 *       kicked    x'' + D^{0.4} x + x = 0, Riemann-Liouville, x(0) = 1, x'(0) = 1/2, T = 20
 *       slow      x'' + D^{0.6} x + x = 0, x(0) = 1, at rest, T = 10^7
 *
 * The error is the largest |x - x(t)| at the ends of all steps, and at 400 rows between them. Each time is the
 * least of several, from fvi_stepper_start to fvi_stepper_free, without rows. */
#define _POSIX_C_SOURCE 200809L /* clock_gettime, uname */
#include "variable.h"
#include "bench.h"

#include <stdlib.h>

static void measure(const bench_problem *P, double tolerance)
{
    double rows, ends;
    const fvi_step_statistics counts =
        bench_errors(P, tolerance, 1, &ends, &rows);
    printf("%s, %.0e\t%d\t%zu\t%zu\t", P->name, tolerance, counts.stages,
           counts.steps, counts.rejected);
    if (P->linear)
        printf("%.2g\t", ends);
    else
        printf("-\t");
    printf("%.2g\t%.3g\n", rows, 1e6 * bench_seconds(P, tolerance));
    fflush(stdout);
}

int main(void)
{
    static bench_problem all[BENCH_PROBLEMS];
    describe();
    printf("# problem and tolerance of a step; errors at the ends of the "
           "steps, in 400 rows; "
           "microseconds\n");
    bench_problems(all);
    for (size_t i = PLATE; i <= SLOW; i++) {
        printf("\n\n#> %s\n# run\tstages\tsteps\trejected\tends\trows\ttime\n",
               all[i].name);
        for (double tolerance = 1e-4; tolerance > 1e-13; tolerance /= 100)
            measure(&all[i], tolerance);
        printf("#< %s\n", all[i].name);
    }
    return EXIT_SUCCESS;
}
