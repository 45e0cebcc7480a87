/* tests/bench/bench_memory.c -- H 12: the time and space of three memories.
 *
 * Prints a table in blocks (gnuplot: index 0, 1, ...) in some twenty seconds; the progress is on standard error.
 * Every run is the equation of Bagley and Torvik
 *
 *     x'' + D^{3/2} x + x = F(t),  F = 8 for t <= 1, then 0,  x(0) = x'(0) = 0,
 *
 * to T = 20, by the integrator of H 9. Each time is the least of several measurements. The library has two of the
 * memories. The third one, by FFT, is in fft_blocks.c. */
#define _POSIX_C_SOURCE 200809L /* clock_gettime, uname */
#include <fvi/fvi.h>
#include "bench.h"
#include "memory/history_tiled.h"
#include "memory/history_kinds.h"
#include "fft_blocks.h"
#include "system/larger.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

/* A way to sum: its name in the table, its shortest and its longest run, and the library's kind. The library
 * has no FFT, so AUTO represents it here. */
typedef struct {
    const char *name;
    double least, most;
    fvi_history_kind kind;
} way;

static const way direct_sum = { "direct", 0, 2e4, FVI_HISTORY_DIRECT },
                 fft = { "fft", 512, 3e6, FVI_HISTORY_AUTO },
                 exponentials = { "exponentials", 0, 1e7, FVI_HISTORY_MODES };

/* Print a line on a terminal that the next line overwrites. */
static void progress(const char *what, size_t n)
{
    if (isatty(STDERR_FILENO))
        fprintf(stderr, "\r%-40s %10zu", what, n);
}

/* Run d equal systems once. Return x(T) of the first one. */
static double run_once(size_t d, size_t N, double kappa, fvi_history_kind kind,
                       double tolerance)
{
    enum { MOST = FVI_TILES_FROM };
    static double one[MOST], zero[MOST];
    static const double c = 1, force[2] = { 8, 1 };
    for (size_t i = 0; i < MOST; i++)
        one[i] = 1;
    fvi_system system = { .d = d,
                          .mass = one,
                          .damping = one,
                          .potential = fvi_potential_harmonic(&c),
                          .force = fvi_force_step(force) };
    fvi_run run = { .system = &system,
                    .x0 = zero,
                    .p0 = zero,
                    .h = 20 / (double)N,
                    .steps = N,
                    .kappa = kappa,
                    .alpha = 0.75,
                    .memory = kind,
                    .tolerance = tolerance };
    fvi_stepper *s;
    if (fvi_stepper_start(&fvi_fractional, &run, &s, NULL))
        exit(EXIT_FAILURE);
    while (s->k < N)
        if (fvi_stepper_step(s))
            exit(EXIT_FAILURE);
    double x = s->x[0];
    fvi_stepper_free(s);
    return x;
}

/* Add a term. sum + lost is the sum without its rounding errors. */
static void add(double term, double *sum, double *lost)
{
    const double all = term + *lost, before = *sum;
    *sum += all;
    *lost = all - (*sum - before);
}

/* Make the same run of one system at kappa = 1/2 with the history summed by FFT in blocks. The force does not
 * act at the start, so x_0 = x_1 = 0. The equation is linear, so no iteration is needed.
 *                                                           [(9.1), (12.2), (12.4)] */
static double run_by_blocks(size_t N)
{
    fft_blocks *b = fft_blocks_alloc(0.5, N); /* of increments */
    if (!b)
        exit(EXIT_FAILURE);
    const double h = 20 / (double)N, unit = pow(h, -1.5);
    double x = 0, dx = 0, lost[2] = { 0, 0 };
    fft_blocks_push(b, 0);
    for (size_t k = 1; k < N; k++) {
        const double F = (double)k * h <= 1 ? 8 : 0;
        const double a = F - unit * fft_blocks_push(b, dx) - x;
        add(h * h * a / (1 + h * h / 4), &dx, lost);
        add(dx, &x, lost + 1);
    }
    fft_blocks_free(b);
    return x;
}

static size_t bytes_of(const way *by, size_t N)
{
    return by == &fft ? fft_blocks_bytes(N)
                      : fvi_history_bytes(1.5, 1, N, by->kind, 0);
}

/* Return the seconds of a run: the least of two measurements, or of as many as fit into a fifth of a second. */
static double seconds(const way *by, size_t d, size_t N, double kappa,
                      double tolerance, double *x)
{
    double best = 1e30, begin = now();
    for (int i = 0; i < 2 || (now() - begin < 0.2 && i < 1000); i++) {
        double start = now();
        *x = by == &fft ? run_by_blocks(N)
                        : run_once(d, N, kappa, by->kind, tolerance);
        best = smaller(best, now() - start);
        if (best > 2)
            break;
    }
    return best;
}

static void against_steps(void)
{
    /* The method is of first order, so two long runs give x(T) to 10^-12. */
    progress("reference", 10000000);
    double exact = 2 * run_once(1, 10000000, 0.5, FVI_HISTORY_AUTO, 0)
                   - run_once(1, 5000000, 0.5, FVI_HISTORY_AUTO, 0);
    printf("\n\n# run time against N, 2 alpha = 3/2, default tolerance\n"
           "# memory\tN\tseconds\tns per step\tbytes\terror of x(T)\n");
    const double all[] = { 32,  64,  128, 192, 256, 384, 512, 1e3, 2e3,
                           5e3, 1e4, 2e4, 5e4, 1e5, 3e5, 1e6, 3e6, 1e7 };
    const way *const ways[] = { &direct_sum, &fft, &exponentials };
    for (int j = 0; j < 3; j++) {
        for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
            if (all[i] < ways[j]->least || all[i] > ways[j]->most)
                continue;
            size_t N = (size_t)all[i];
            progress(ways[j]->name, N);
            double x, t = seconds(ways[j], 1, N, 0.5, 0, &x);
            printf("%s\t%zu\t%.4g\t%.4g\t%zu\t%.3g\n", ways[j]->name, N, t,
                   1e9 * t / (double)N, bytes_of(ways[j], N),
                   fabs(x - exact));
        }
        printf("\n\n");
    }
}

/* Return the seconds of N plain dot products with the lengths of the direct sum of N terms. */
static double dot_products(size_t N, double *a, double *b)
{
    double start = now(), total = 0;
    for (size_t k = 1; k <= N; k++) {
        double sum = 0;
#pragma omp simd reduction(+ : sum)
        for (size_t j = 0; j < k; j++)
            sum += a[j] * b[j];
        total += sum;
    }
    a[0] = 1e-300 * total; /* keeps the compiler from leaving out the sums */
    return now() - start;
}

static void ratios(void)
{
    double x, y, direct = seconds(&direct_sum, 1, 20000, 0.5, 0, &x);
    double dots = 1e30, *a = calloc(40000, sizeof *a);
    for (int i = 0; a && i < 5; i++)
        dots = smaller(dots, dot_products(20000, a, a + 20000));
    free(a);
    progress("ratios", 1000000);
    double blocks = seconds(&fft, 1, 1000000, 0.5, 0, &x);
    double modes = seconds(&exponentials, 1, 1000000, 0.5, 0, &y);
    static const char row[] = "%-56s\t%.*g\n";
    printf("# ratios of run times, and how far apart the results are\n"
           "#> ratios\n# %-54s\tis\n",
           "of what");
    printf(row, "direct, ns a product, N = 2 10^4", 3, 1e9 * direct / 2e8);
    printf(row, "direct over bare dot products, N = 2 10^4", 3, direct / dots);
    printf(row, "FFT blocks over exponentials, N = 10^6", 3, blocks / modes);
    printf(row, "FFT blocks, bytes a step, N = 10^6", 3,
           (double)bytes_of(&fft, 1000000) / 1e6);
    printf(row, "direct, 50^2 times that of N = 2 10^4, over exponentials", 3,
           2500 * direct / modes);
    printf(row, "x(T) by FFT blocks minus by exponentials, N = 10^6", 2,
           fabs(x - y));
    printf("#< ratios\n\n\n");
}

/* Print time and error against the tolerance. */
static void against_tolerance(void)
{
    const size_t N = 20000;
    progress("against the tolerance", N);
    double want = run_once(1, N, 0.5, FVI_HISTORY_DIRECT, 0), x;
    printf("# against the tolerance, N = %zu\n#> tolerance\n"
           "# toler.\tms\tmodes\t|x(T) - that of the direct sum|\n",
           N);
    for (double tolerance = 1e-3; tolerance > 0.9e-14; tolerance /= 10) {
        double t = seconds(&exponentials, 1, N, 0.5, tolerance, &x);
        double delta = fvi_history_modes_delta(N, tolerance);
        printf("%.0e\t%.3f\t%zu\t%.1e\n", tolerance, 1e3 * t,
               fvi_history_modes_nodes(0.5, (double)N, delta, NULL, NULL, NULL),
               fabs(x - want));
    }
    printf("#< tolerance\n\n\n");
}

/* A processor may be fast for some seconds and slow for others, so the runs that are compared take turns. */
enum { TURNS = 15 };

/* Compare d systems in one memory with d runs. kappa = 1 is the explicit step, so no d by d matrix hides the
 * cost of the memory. */
static void against_batch(void)
{
    const size_t N = 200000, most = FVI_TILES_FROM;
    double least[FVI_TILES_FROM + 1], x;
    for (size_t d = 1; d < most; d *= 2)
        least[d] = 1e30;
    for (int turn = 0; turn < TURNS; turn++)
        for (size_t d = 1; d < most; d *= 2) {
            progress("batch", d);
            least[d] = smaller(
                least[d], seconds(&exponentials, d, N, 1, 0, &x));
        }
    printf("# a batch: d systems in one memory, N = %zu, explicit\n#> batch\n"
           "# d\tns per step and system\ttimes as fast as one by one\n",
           N);
    for (size_t d = 1; d < most; d *= 2)
        printf("%zu\t%.1f\t%.2f\n", d, 1e9 * least[d] / (double)(N * d),
               (double)d * least[1] / least[d]);
    printf("#< batch\n\n\n");
}

/* Return the seconds of N pushes, with x_{k+1} made from H_k as in a step. */
static double pushes(size_t N, double delta)
{
    const fvi_node_range g = fvi_history_modes_plan(0.5, N, delta);
    fvi_history_head *e = fvi_history_modes_alloc(&g, 0.5, 0, 1, N);
    double x = 1, v = 0, H;
    const double start = now();
    for (size_t k = 0; e && k <= N; k++) {
        fvi_history_take(e, &x, &H);
        v -= 1e-5 * (x + H);
        x += 1e-5 * v;
    }
    const double taken = now() - start;
    free(e);
    return taken;
}

/* Print the time of the module alone: ns for a push against the number of modes. */
static void against_modes(void)
{
    enum { TENS = 12 };
    const size_t N = 500000;
    double delta[TENS], least[TENS];
    progress("one push", N);
    for (int i = 0; i < TENS; i++) {
        delta[i] = fvi_history_modes_delta(N, pow(10, -3 - i));
        least[i] = 1e30;
    }
    for (int turn = 0; turn < TURNS; turn++)
        for (int i = 0; i < TENS; i++)
            least[i] = smaller(least[i], pushes(N, delta[i]));
    printf(
        "# one push of the exponentials, order 1/2\n#> modes\n# modes\tns\n");
    for (int i = 0; i < TENS; i++)
        printf(
            "%zu\t%.1f\n",
            fvi_history_modes_nodes(0.5, (double)N, delta[i], NULL, NULL, NULL),
            1e9 * least[i] / (double)N);
    printf("#< modes\n");
}

int main(void)
{
    describe();
    against_steps();
    ratios();
    against_tolerance();
    against_batch();
    against_modes();
    if (isatty(STDERR_FILENO))
        fprintf(stderr, "\r%52s\r", "");
    return EXIT_SUCCESS;
}
