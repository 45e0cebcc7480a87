/* tests/bench/bench_blocks.c -- H 28: the push of many coordinates to a memory, by blocks and without; the limits
 * of the machine; a wave of a million unknowns.
 *
 * Prints a table in blocks (gnuplot: index 0, 1, ...) in two minutes, with 1.3 gigabytes. The modes are those of
 * half a derivative and 10^6 steps at the default tolerance. Each time is the least of several measurements. */
#define _POSIX_C_SOURCE 200809L /* clock_gettime, uname */
#include <fvi/coefficients.h>
#include <fvi/convolution_quadrature_methods.h>
#include <fvi/fvi.h>
#include "bench.h"
#include "memory/history_tiled.h"
#include "memory/history_kinds.h"
#include "system/larger.h"

#include <math.h>
#include <stdlib.h>
#include <sys/resource.h>

enum { STEPS = 1000000, MODES = 128, MOST = 1000000, TIMES = 4 /* in each of five turns */ };

static void *room(size_t n)
{
    void *p = calloc(n, sizeof(double));
    if (!p)
        exit(EXIT_FAILURE);
    return p;
}

static size_t modes(void)
{
    const double delta = fvi_history_modes_delta(STEPS, 0);
    const size_t Q =
        fvi_history_modes_nodes(0.5, STEPS, delta, NULL, NULL, NULL);
    return (Q + 7) / 8 * 8;
}

/* Return a memory that pushes without blocks for every d. A memory with a rate does so. */
static fvi_history_head *plain_of(size_t d)
{
    const fvi_node_range g =
        fvi_history_modes_plan(0.5, STEPS, fvi_history_modes_delta(STEPS, 0));
    fvi_history_head *e = fvi_history_modes_alloc(&g, 0.5, 1, d, STEPS);
    if (!e)
        exit(EXIT_FAILURE);
    return e;
}

static fvi_history_head *tiles_of(size_t d, size_t lanes)
{
    double p[MODES] = { 0 }, c[MODES] = { 0 }, w[FVI_WINDOW + 1];
    const size_t Q = modes();
    fvi_history_modes_nodes(0.5, STEPS, fvi_history_modes_delta(STEPS, 0), p, c,
                           NULL);
    for (size_t q = 0; q < Q; q++) {
        c[q] *= exp(-FVI_TAIL * p[q]);
        p[q] = -expm1(-p[q]);
    }
    fvi_gl_weights(0.5, FVI_WINDOW + 1, w);
    fvi_history_head *t = fvi_history_tiled_alloc(d, Q, p, c, w);
    if (!t || (lanes && !fvi_history_tiled_width(t, lanes))) {
        free(t);
        return NULL;
    }
    return t;
}

/* Return the ns for a coordinate and push: the least of twelve measurements, or of four. A measurement has the
 * number of pushes that makes 2 10^6 coordinates, in whole blocks, but at least one block. */
static double push_time(fvi_history_head *m, size_t d)
{
    const size_t count = 32 + 2000000 / d / 32 * 32;
    double *x = room(2 * d), best = 1e30;
    for (size_t i = 0; i < d; i++)
        x[i] = cos((double)i);
    for (int i = 0; i < (d < MOST ? 12 : 4); i++) {
        const double start = now();
        for (size_t k = 0; k < count; k++)
            fvi_history_take(m, x, x + d);
        best = smaller(best, now() - start);
    }
    free(x);
    return 1e9 * best / (double)count / (double)d;
}

static double plain_time(size_t d)
{
    fvi_history_head *e = plain_of(d);
    const double ns = push_time(e, d);
    free(e);
    return ns;
}

static double tiles_time(size_t d, size_t lanes)
{
    fvi_history_head *t = tiles_of(d, lanes);
    const double ns = t ? push_time(t, d) : NAN;
    free(t);
    return ns;
}

/* Print the table against the number of coordinates. ns[0] and ns[1] become the times of the last row, a
 * million coordinates, without and with blocks. */
static void against_coordinates(double *ns)
{
    printf("# ns a coordinate and push, %zu modes\n#> push\n"
           "# d\tplain\tblocks\ttimes as fast\n",
           modes());
    for (size_t d = 16; d <= MOST; d = d < 100 ? 100 : 10 * d) {
        ns[0] = plain_time(d);
        ns[1] = tiles_time(d, 0);
        printf("%zu\t%.1f\t%.1f\t%.1f\n", d, ns[0], ns[1], ns[0] / ns[1]);
        fflush(stdout);
    }
    printf("#< push\n\n\n");
}

/* Print the table against the width of the vectors. Widths that this machine does not have are left out. */
static void against_widths(void)
{
    printf("# ns a coordinate and push, d = 1000, by the width of the vectors\n"
           "#> widths\n# doubles\tns\n");
    for (size_t lanes = 2; lanes <= 8; lanes *= 2) {
        const double ns = tiles_time(1000, lanes);
        if (ns > 0)
            printf("%zu\t%.1f\n", lanes, ns);
    }
    printf("#< widths\n\n\n");
}

/* Runs of an oscillator as the coordinates of one memory, with each x_{k+1} made from H_k. */
static double batch_time(size_t d)
{
    const size_t count = 32 * (1 + 30000 / d);
    double *x = room(3 * d), *v = x + d, *H = v + d, best = 1e30;
    fvi_history *m;
    for (int i = 0; i < TIMES; i++) {
        if (fvi_history_alloc(0.5, d, STEPS, FVI_HISTORY_MODES, 0, &m))
            exit(EXIT_FAILURE);
        for (size_t j = 0; j < d; j++)
            x[j] = cos((double)j);
        const double start = now();
        for (size_t k = 0; k < count; k++) {
            fvi_history_push(m, x, x, H);
            for (size_t j = 0; j < d; j++) {
                v[j] -= 1e-3 * (x[j] + H[j]);
                x[j] += 1e-3 * v[j];
            }
        }
        best = smaller(best, now() - start);
        fvi_history_free(m);
    }
    free(x);
    return 1e9 * best / (double)count / (double)d;
}

/* The same runs as the coordinates of one system, which share alpha, h and the method, by fvi_stepper_step. */
static double run_time(const fvi_method *method, size_t d)
{
    static const double c = 1;
    const size_t steps = 32 * (1 + 30000 / d);
    double *x = room(4 * d), best = 1e30;
    for (size_t j = 0; j < d; j++) {
        x[j] = cos((double)j);
        x[2 * d + j] = 1;
        x[3 * d + j] = 0.1;
    }
    const fvi_system system = { .d = d,
                                .mass = x + 2 * d,
                                .damping = x + 3 * d,
                                .potential = fvi_potential_harmonic(&c) };
    fvi_run run = fvi_run_default(&system, x, x + d, 0.01, STEPS);
    run.alpha = 0.25;
    for (int i = 0; i < TIMES; i++) {
        fvi_stepper *s;
        if (fvi_stepper_start(method, &run, &s, NULL))
            exit(EXIT_FAILURE);
        const double start = now();
        while (s->k < steps)
            if (fvi_stepper_step(s))
                exit(EXIT_FAILURE);
        best = smaller(best, now() - start);
        fvi_stepper_free(s);
    }
    free(x);
    return 1e9 * best / (double)steps / (double)d;
}

static void against_batch(void)
{
    enum { ROWS = 8, TURNS = 5 }; /* all rows take turns; bench_memory.c says why */
    double least[ROWS][3];
    for (int turn = 0; turn < TURNS; turn++)
        for (size_t i = 0, d = 1; i < ROWS; i++, d *= d < 16 ? 2 : 4) {
            const double ns[] = { batch_time(d), run_time(&fvi_fractional, d),
                                  run_time(&fvi_cq2_midpoint, d) };
            for (int j = 0; j < 3; j++)
                least[i][j] = turn ? smaller(least[i][j], ns[j]) : ns[j];
        }
    printf("# oscillators together, ns a run and step, and times as fast as "
           "one by one\n#> batch\n"
           "# runs\tthe memory\ttimes as fast\tfvi\tfvi as fast"
           "\tfvi-stable\tfvi-stable as fast\n");
    for (size_t i = 0, d = 1; i < ROWS; i++, d *= d < 16 ? 2 : 4) {
        printf("%zu", d);
        for (int j = 0; j < 3; j++)
            printf("\t%.1f\t%.2f", least[i][j], least[0][j] / least[i][j]);
        putchar('\n');
    }
    printf("#< batch\n\n\n");
    fflush(stdout);
}

/* ---- the two upper bounds of the speed ---- */

/* Twelve vectors with s <- s a + b each, so that no operation waits for another: two operations for each number
 * and round. */
#define PEAK(name, lanes, target)                                              \
    target static double name(size_t rounds)                                   \
    {                                                                          \
        typedef double vector __attribute__((vector_size(8 * (lanes))));       \
        vector s[12] = { { 0 } }, a = { 0 }, b = { 0 }, sum = { 0 };           \
        a += 0.999;                                                            \
        b += 0.001;                                                            \
        const double start = now();                                            \
        for (size_t i = 0; i < rounds; i++)                                    \
            _Pragma("GCC unroll 12") for (size_t j = 0; j < 12; j++) s[j] =    \
                s[j] * a + b;                                                  \
        const double seconds = now() - start;                                  \
        for (size_t j = 0; j < 12; j++)                                        \
            sum += s[j];                                                       \
        return sum[0] > 0 ? 24e-9 * (lanes) * (double)rounds / seconds : 0;    \
    }

PEAK(peak_2, 2, )
#if defined(__x86_64__)
PEAK(peak_4, 4, __attribute__((target("avx2"))))
PEAK(peak_8, 8, __attribute__((target("avx512f"))))
#endif

/* Return GFLOP/s without fused operations, by the widest vectors. */
static double peak(void)
{
    double best = 0;
    for (int i = 0; i < 10; i++) {
#if defined(__x86_64__)
        if (__builtin_cpu_supports("avx512f"))
            best = larger(best, peak_8(2000000));
        else if (__builtin_cpu_supports("avx2"))
            best = larger(best, peak_4(2000000));
        else
#endif
            best = larger(best, peak_2(2000000));
    }
    return best;
}

/* Return GB/s of x <- x + 1 over 400 megabytes, read and written. */
static double bandwidth(void)
{
    enum { N = 50000000 };
    double *x = room(N), best = 1e30;
    for (int i = 0; i < 6; i++) {
        const double start = now();
        for (size_t j = 0; j < N; j++)
            x[j] += 1;
        best = smaller(best, now() - start);
    }
    free(x);
    return 16e-9 * N / best;
}

/* Print (28.5): the counted operations and bytes, the measured time, and the least time that each bound allows. */
static void roofs(const double *ns)
{
    const double Q = (double)modes(), top = peak(), wide = bandwidth();
    const double flops[] = { 5 * Q + 64, 4 * Q + 96 };
    const double bytes[] = { 8 * Q + 192, Q / 2 + 108 };
    static const char *const names[] = { "plain", "blocks" };
    printf("# the roofs\n#> roofs\n# of what\tis\nGFLOP/s, not fused\t%.1f\n"
           "GB/s, read and written\t%.1f\n#< roofs\n\n\n",
           top, wide);
    printf("# a coordinate and push, d = 10^6\n#> counted\n"
           "# way\tflops\tbytes\tflops a byte\tns\tGFLOP/s\tns at the roof"
           "\tns one after the other\n");
    for (int i = 0; i < 2; i++)
        printf("%s\t%.0f\t%.0f\t%.2f\t%.1f\t%.1f\t%.1f\t%.1f\n", names[i],
               flops[i], bytes[i], flops[i] / bytes[i], ns[i], flops[i] / ns[i],
               larger(flops[i] / top, bytes[i] / wide),
               flops[i] / top + bytes[i] / wide);
    printf("#< counted\n\n\n");
}

/* ---- a wave ---- */

static const double step = 0.5, rho = 0.05;

/* Run a system of n unknowns from x0 at rest by Algorithm 3 at kappa = 1, which solves no equations. x becomes
 * the last positions. Returns the seconds, start included. */
//> wave
static double run_of(size_t n, fvi_potential potential, const double *x0,
                     size_t steps, double *x)
{
    double *mass = room(3 * n), *damping = mass + n, *p0 = damping + n;
    for (size_t i = 0; i < n; i++) {
        mass[i] = 1;
        damping[i] = rho;
    }
    const fvi_system system = {
        .d = n, .mass = mass, .damping = damping, .potential = potential
    };
    fvi_run run = fvi_run_default(&system, x0, p0, step, steps);
    run.kappa = 1;
    run.alpha = 0.25;
    fvi_stepper *s;
    const double begin = now();
    int status = fvi_stepper_start(&fvi_fractional, &run, &s, NULL);
    while (!status && s->k < steps)
        status = fvi_stepper_step(s);
    const double seconds = now() - begin;
    if (status)
        exit(EXIT_FAILURE);
    memcpy(x, s->x, n * sizeof *x);
    fvi_stepper_free(s);
    free(mass);
    return seconds;
}
//< wave

/* Run an eigenvector of the second difference of n unknowns, 80 cells long, twice. Print the shorter time, and
 * the distance from the oscillator at the end. */
static void one_wave(size_t n, size_t steps)
{
    static const double springs[] = { 1, 0 }, one = 1;
    const double pi = acos(-1);
    const size_t waves = (n + 1) / 40, period = 2 * (n + 1);
    const double half = sin(pi * (double)waves / (double)period),
                 c = 4 * half * half;
    double *u0 = room(2 * n), *u = u0 + n, x, apart = 0;
    for (size_t i = 0; i < n; i++) /* an exact multiple of pi / (n + 1) */
        u0[i] = sin(pi * (double)(waves * (i + 1) % period) / (double)(n + 1));
    double seconds = 1e30;
    for (int i = 0; i < 2; i++)
        seconds = smaller(
            seconds, run_of(n, fvi_potential_chain(springs), u0, steps, u));
    run_of(1, fvi_potential_harmonic(&c), &one, steps, &x);
    for (size_t i = 0; i < n; i++)
        apart = larger(apart, fabs(u[i] - x * u0[i]));
    struct rusage usage;
    getrusage(RUSAGE_SELF, &usage);
    printf("# a wave of %zu unknowns, %zu steps\n#> wave\n# of what\tis\n"
           "seconds\t%.1f\nns an unknown and step\t%.1f\nGB\t%.2f\n"
           "of its start\t%.2f\napart from the oscillator\t%.0e\n"
           "#< wave\n\n\n",
           n, steps, seconds, 1e9 * seconds / (double)(n * steps),
           (double)usage.ru_maxrss / 1e6, x, apart); /* kB on Linux */
    free(u0);
}

/* With an argument, run the wave alone. */
int main(int argc, char **argv)
{
    (void)argv;
    describe();
    one_wave(MOST, 1000); /* first, because the memory of a process is reported as its largest size so far */
    fflush(stdout);
    if (argc > 1)
        return EXIT_SUCCESS;
    double ns[2];
    against_coordinates(ns);
    roofs(ns);
    fflush(stdout);
    against_widths();
    against_batch();
    return EXIT_SUCCESS;
}
