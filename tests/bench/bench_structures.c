/* tests/bench/bench_structures.c -- H 27: the cost of a long wave, and of membranes.
 *
 * The wave is u_tt + D^{1/2} u = u_xx on d points, from the first sine at rest, h = dx / 2, by Algorithm 3 with
 * kappa = 1. Prints 1000 steps with the whole past, compared with the same mode as one oscillator; then 1000
 * points for more and more steps; then a membrane with C = K / 100 by fvi-stable; then the largest membrane with
 * one damper, and with ten dampers of a tenth of the rows each. It takes some two minutes, and a gigabyte at d =
 * 10^6. With a number of points as the argument it runs this wave alone. */
#define _POSIX_C_SOURCE 200809L /* clock_gettime, getrusage, uname */
#include <fvi/fvi.h>
#include "run/whole_run.h"
#include "system/larger.h"
#include "../../figures/structures/wave.h"
#include "bench.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/resource.h>

enum { STEPS = 1000, MOST = 100000, FEW = 64, TURNS = 3, PARTS = 10 };

static const double alpha = 0.25, rho = 1;

static fvi_run run_of(const fvi_system *system, double *x0, double *p0,
                      double h, size_t steps)
{
    fvi_run run = fvi_run_default(system, x0, p0, h, steps);
    run.alpha = alpha;
    run.kappa = 1;
    run.past = FVI_INITIAL_HISTORY_CAPUTO;
    run.memory = FVI_HISTORY_MODES;
    return run;
}

/* Return the amplitude at the end of the mode with the eigenvalue k. */
static double one_oscillator(double k, double h, size_t steps)
{
    static double x[MOST + 1];
    double one = 1, none = 0;
    const fvi_system system = { .d = 1,
                                .mass = &one,
                                .damping = &rho,
                                .potential = fvi_potential_harmonic(&k) };
    const fvi_run run = run_of(&system, &one, &none, h, steps);
    if (fvi_trajectory(&fvi_fractional, &run, x, NULL, NULL))
        exit(EXIT_FAILURE);
    return x[steps];
}

/* Print a row: d, steps, and their cost. */
static void wave(size_t d, size_t steps, int with_room)
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
    const fvi_run run = run_of(&system, x0, p0, dx / 2, steps);
    const double begin = now(), centre = x0[d / 2], s = sin(pi * dx / 2) / dx;
    fvi_stepper *stepper;
    if (fvi_stepper_start(&fvi_fractional, &run, &stepper, NULL))
        exit(EXIT_FAILURE);
    while (stepper->k < steps)
        if (fvi_stepper_step(stepper))
            exit(EXIT_FAILURE);
    const double seconds = now() - begin,
                 want = one_oscillator(4 * s * s, dx / 2, steps) * centre,
                 far = fabs(stepper->x[d / 2] - want);
    fvi_stepper_free(stepper);
    free(ones);
    struct rusage used;
    getrusage(RUSAGE_SELF, &used);
    printf("%zu\t%zu\t%.3g\t%.3g\t%.2g", d, steps, seconds,
           1e9 * seconds / (double)steps / (double)d, far);
    if (with_room) /* the largest size of the process so far */
        printf("\t%.2g", (double)used.ru_maxrss * 1024e-9);
    putchar('\n');
    fflush(stdout);
}

/* Assemble `factor` times the five-point difference, divided by dx^2 = 1 / (m + 1)^2, between those points from
 * `first` to `last` - 1 that are in one of `parts` parts. */
static void laplace_between(int m, double factor, int first, int last, int parts,
                            fvi_sparse *A)
{
    const double k = factor * (m + 1) * (m + 1);
    const long n = (long)m * m;
    fvi_triplet *list = malloc(5 * (size_t)(m * m) * sizeof *list);
    size_t count = 0;
    for (int i = first; list && i < last; i++) {
        const int beside[] = { i % m > 0 ? i - 1 : -1,
                               i % m < m - 1 ? i + 1 : -1, i - m, i + m };
        list[count++] = (fvi_triplet){ i, i, 4 * k };
        for (int l = 0; l < 4; l++)
            if (beside[l] >= 0 && beside[l] < m * m
                && beside[l] * (long)parts / n == i * (long)parts / n)
                list[count++] = (fvi_triplet){ i, beside[l], -k };
    }
    if (!list || fvi_sparse_assemble((size_t)(m * m), count, list, A))
        exit(EXIT_FAILURE);
    free(list);
}

static void laplace(int m, double factor, fvi_sparse *A)
{
    laplace_between(m, factor, 0, m * m, 1, A);
}

/* Print a row: d, ms for the factors and the start, ns for an unknown and step. */
static void membrane(int m)
{
    const size_t d = (size_t)(m * m);
    fvi_triplet *ones = malloc(d * sizeof *ones);
    double *x0 = calloc(2 * d, sizeof *x0);
    fvi_sparse M, K, C;
    fvi_structure *structure;
    fvi_stepper *s;
    if (!ones || !x0)
        exit(EXIT_FAILURE);
    for (size_t i = 0; i < d; i++) {
        ones[i] = (fvi_triplet){ (int)i, (int)i, 1 };
        x0[i] = sin((double)i);
    }
    laplace(m, 1, &K);
    laplace(m, 0.01, &C);
    if (fvi_sparse_assemble(d, d, ones, &M)
        || fvi_structure_alloc(&M, &K, &C, &structure, NULL))
        exit(EXIT_FAILURE);
    const fvi_system system = fvi_structure_system(structure);
    fvi_run run = run_of(&system, x0, x0 + d, 1 / ((double)m + 1), STEPS);
    const double begin = now();
    if (fvi_stepper_start(&fvi_cq2_midpoint, &run, &s, NULL))
        exit(EXIT_FAILURE);
    const double started = now();
    while (s->k < FEW)
        if (fvi_stepper_step(s))
            exit(EXIT_FAILURE);
    printf("%zu\t%.3g\t%.3g\t%s\n", d, 1e3 * (started - begin),
           1e9 * (now() - started) / FEW / (double)d,
           fvi_structure_solver_name(structure, 1, 1, 1));
    fflush(stdout);
    fvi_stepper_free(s);
    fvi_structure_free(structure);
    fvi_sparse_free(&M);
    fvi_sparse_free(&K);
    fvi_sparse_free(&C);
    free(ones);
    free(x0);
}

/* Return the ns for an unknown and step with `count` dampers whose histories together have all unknowns. */
static double steps_of_dampers(const fvi_sparse *M, const fvi_sparse *K, int m, int count)
{
    const size_t d = M->n;
    const fvi_kernel_term term = { FVI_KERNEL_POWER, 1, 0.3, 0, 0 };
    const fvi_kernel kernel = { 1, &term };
    double *x0 = calloc(2 * d, sizeof *x0);
    fvi_sparse C[PARTS];
    fvi_damper damper[PARTS];
    fvi_structure *structure;
    fvi_stepper *s;
    for (int j = 0; j < count; j++) {
        const int first = (int)(((long)d * j + count - 1) / count),
                  last = (int)(((long)d * (j + 1) + count - 1) / count);
        laplace_between(m, 0.01, first, last, PARTS, C + j);
        damper[j] = (fvi_damper){ .matrix = C + j, .kernel = &kernel };
    }
    if (!x0
        || fvi_structure_alloc_dampers(M, K, (size_t)count, damper, &structure, NULL))
        exit(EXIT_FAILURE);
    for (size_t i = 0; i < d; i++)
        x0[i] = sin((double)i);
    const fvi_system system = fvi_structure_system(structure);
    fvi_run run = run_of(&system, x0, x0 + d, 1 / ((double)m + 1), STEPS);
    run.past = FVI_INITIAL_HISTORY_HELD; /* each damper has its own past */
    if (fvi_stepper_start(&fvi_cq2_midpoint, &run, &s, NULL))
        exit(EXIT_FAILURE);
    const double started = now();
    while (s->k < FEW)
        if (fvi_stepper_step(s))
            exit(EXIT_FAILURE);
    const double ns = 1e9 * (now() - started) / FEW / (double)d;
    fvi_stepper_free(s);
    fvi_structure_free(structure);
    for (int j = 0; j < count; j++)
        fvi_sparse_free(C + j);
    free(x0);
    return ns;
}

/* Print a row: d, the least times of one damper and of ten, and their ratio. */
static void several_dampers(int m)
{
    const size_t d = (size_t)(m * m);
    fvi_triplet *ones = malloc(d * sizeof *ones);
    fvi_sparse M, K;
    double one = INFINITY, ten = INFINITY;
    if (!ones)
        exit(EXIT_FAILURE);
    for (size_t i = 0; i < d; i++)
        ones[i] = (fvi_triplet){ (int)i, (int)i, 1 };
    laplace(m, 1, &K);
    if (fvi_sparse_assemble(d, d, ones, &M))
        exit(EXIT_FAILURE);
    for (int turn = 0; turn < TURNS; turn++) {
        one = smaller(one, steps_of_dampers(&M, &K, m, 1));
        ten = smaller(ten, steps_of_dampers(&M, &K, m, PARTS));
    }
    printf("%zu\t%.3g\t%.3g\t%.2f\n", d, one, ten, ten / one);
    fvi_sparse_free(&M);
    fvi_sparse_free(&K);
    free(ones);
}

int main(int argc, char **argv)
{
    const char *names = "# d\tsteps\tseconds\tns per unknown and step\t"
                        "deviation at the centre";
    static const int sides[] = { 10, 31, 100, 316 };
    describe();
    printf("# u_tt + D^{1/2} u = u_xx\n#> wave\n%s\tGB\n", names);
    if (argc > 1) {
        wave((size_t)atol(argv[1]), STEPS, 1);
        return 0;
    }
    for (size_t d = 1000; d <= 1000000; d *= 10)
        wave(d, STEPS, 1);
    printf("#< wave\n\n\n#> long\n%s\n", names);
    for (size_t steps = 100; steps <= MOST; steps *= 10)
        wave(1000, steps, 0);
    printf("#< long\n\n\n# a membrane, fvi-stable\n#> membrane\n# d\tms to the start\t"
           "ns per unknown and step\tsolver\n");
    for (int l = 0; l < 4; l++)
        membrane(sides[l]);
    printf("#< membrane\n\n\n# a membrane with dampers, fvi-stable\n#> dampers\n# d\tns per unknown and "
           "step, one damper\tten dampers\ttimes as long\n");
    several_dampers(sides[3]);
    puts("#< dampers");
    return 0;
}
