/* tests/bench/bench_precision.c -- Chapter 18: run time against error. Printed as tab
 * separated tables to be kept in figures/step_search/step_search.tsv; `make bench`.
 *
 *     P1  x'' + D^{3/2} x + x = F, F = 8 for t <= 1, then 0, at rest, T = 20
 *     P2  x'' + 0.2 x' + x = 0, x(0) = 1, x'(0) = 1/2, T = 20
 *     P3  x'' + 0.5 D^{0.6} x + x^3 = cos t, at rest, T = 50
 *     P4  32 masses between walls, springs r + r^3, 0.2 D^{0.6} on each, T = 20
 *
 * The error is the largest of |x_k - x(t_k)| at 80 times, evenly between 0 and T,
 * from t = 2 on, or from the first on. A time is the median of 3 or 5 runs. */
#define _POSIX_C_SOURCE 200809L /* clock_gettime, uname */
#include <fvi/fvi.h>
#include <fvi/paper/experiments.h>
#include "bench.h"
#include "peer_product_trapezoid.h"

#include <gsl/gsl_math.h>
#include <gsl/gsl_sort.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { ROWS = 80, D = 32, PROBLEMS = 4, DECADES = 12 };

/* ---- problems ---- */

static double ones[D], dampings[PROBLEMS][D], starts[PROBLEMS][D],
    momenta[PROBLEMS][D], exact[PROBLEMS][(ROWS + 1) * D];
static const double one = 1, plate[] = { 8, 1 }, cubic[] = { 0, 1 },
                    drive[] = { 1, 1 }, chain[] = { 1, 1 };
static fvi_system systems[PROBLEMS];
static const double alphas[] = { 0.75, 0.5, 0.3, 0.3 },
                    ends[] = { 20, 20, 50, 20 };

static void set_up(void)
{
    const double rho[] = { 1, 0.2, 0.5, 0.2 };
    for (int P = 0; P < PROBLEMS; P++) {
        for (size_t i = 0; i < D; i++)
            dampings[P][i] = rho[P];
        systems[P] = (fvi_system){ .d = P == 3 ? D : 1,
                                   .mass = ones,
                                   .damping = dampings[P] };
    }
    for (size_t i = 0; i < D; i++) {
        ones[i] = 1;
        starts[3][i] = sin(3 * M_PI * (double)(i + 1) / (D + 1));
    }
    starts[1][0] = 1;
    momenta[1][0] = 0.5;
    systems[0].potential = systems[1].potential = fvi_potential_harmonic(&one);
    systems[2].potential = fvi_potential_duffing(cubic);
    systems[3].potential = fvi_potential_chain(chain);
    systems[0].force = fvi_force_step(plate);
    systems[2].force = fvi_force_cosine(drive);
}

static fvi_run run_of(int P, size_t N, fvi_memory_kind kind)
{
    return (fvi_run){ .system = &systems[P],
                      .x0 = starts[P],
                      .p0 = momenta[P],
                      .h = ends[P] / (double)N,
                      .steps = N,
                      .kappa = 0.5,
                      .alpha = alphas[P],
                      .past = FVI_PAST_CAPUTO,
                      .memory = kind };
}

/* ---- what runs ---- */

/* One of ours, or, without a method, a peer. */
typedef struct {
    const char *name;
    const fvi_method *method;
    fvi_memory_kind kind;
    int problems; /* bit P: it is run on problem P */
    int ours;
} contender;

/* Nothing that a run needs is made outside. */
static int run_once(const contender *c, int P, size_t N, double *rows)
{
    const fvi_run run = run_of(P, N, c->kind);
    const size_t d = systems[P].d, every = N / ROWS;
    if (!c->method) {
        double *x = malloc((N + 1) * d * sizeof *x);
        int status = !x ? FVI_ENOMEM
                     : c->name[0] == 'p'
                         ? peer_product_trapezoid(&run, x)
                         : fvi_matrix_method(1, dampings[P][0], 1, run.alpha,
                                             systems[P].force, run.h, N, x);
        for (size_t k = 0; !status && k <= ROWS; k++)
            memcpy(rows + k * d, x + k * every * d, d * sizeof *x);
        free(x);
        return status;
    }
    fvi_stepper *s;
    int status = fvi_start(c->method, &run, &s);
    if (status)
        return status;
    while (!status) {
        if (s->k % every == 0)
            memcpy(rows + s->k / every * d, s->x, d * sizeof *rows);
        if (s->k == N)
            break;
        status = fvi_step(s);
    }
    fvi_stop(s);
    return status;
}

/* The median of 5 runs, 3 if they are long; 0 if the run fails. */
static double seconds(const contender *c, int P, size_t N, double *rows)
{
    double times[5];
    size_t count = 5;
    for (size_t i = 0; i < count; i++) {
        double start = now();
        if (run_once(c, P, N, rows))
            return 0;
        times[i] = now() - start;
        if (times[0] > 0.02)
            count = 3;
    }
    gsl_sort(times, 1, count);
    return times[count / 2];
}

/* ---- the truth ---- */

/* (18.3): fvi-lobatto4 twice, and one step of Richardson's extrapolation. */
static void reference(int P, size_t N)
{
    static double coarse[(ROWS + 1) * D];
    const contender best = { .method = &fvi_lobatto4,
                             .kind = FVI_MEMORY_EXPONENTIALS };
    const double order = 6 - 2 * alphas[P]; /* min(6, s + 2 - 2 alpha) */
    double differ = 0;
    if (run_once(&best, P, N / 2, coarse) || run_once(&best, P, N, exact[P]))
        exit(EXIT_FAILURE);
    for (size_t i = 0; i < (ROWS + 1) * systems[P].d; i++) {
        double step = exact[P][i] - coarse[i];
        differ = fmax(differ, fabs(step));
        exact[P][i] += step / expm1(order * M_LN2);
    }
    printf(
        "# P%d reference: fvi-lobatto4, Richardson's extrapolation of %zu and "
        "%zu steps, which differ by %.1e\n",
        P + 1, N / 2, N, differ);
}

static void find_truth(void)
{
    double t[ROWS + 1];
    const fvi_linear bagley_torvik = { .m = 1,
                                       .c = 1,
                                       .rho = 1,
                                       .alpha = 0.75,
                                       .past = FVI_PAST_CAPUTO,
                                       .forcing = FVI_FORCING_STEP,
                                       .A = plate[0],
                                       .T = plate[1] };
    for (size_t k = 0; k <= ROWS; k++) {
        t[k] = 20 * (double)k / ROWS;
        fvi_damped_oscillator(1, 0.2, 1, 1, 0.5, t[k], &exact[1][k], NULL);
    }
    fvi_exact(&bagley_torvik, ROWS + 1, t, exact[0], NULL);
    reference(2, 25600);
    reference(3, 2560);
}

static double error_from(int P, double from, const double *rows)
{
    const size_t d = systems[P].d;
    double worst = 0;
    for (size_t k = 1; k <= ROWS; k++)
        for (size_t i = k * d; i < (k + 1) * d; i++)
            if ((double)k * ends[P] / ROWS >= from)
                worst = fmax(worst, fabs(rows[i] - exact[P][i]));
    return worst;
}

/* ---- one line of the picture, and the fronts ---- */

/* The fastest run of ours and of the peers with an error below 10^-k. */
typedef struct {
    double seconds;
    char name[40];
} fastest;
static fastest front[PROBLEMS][2][DECADES + 1];

/* Every run. */
static struct {
    const contender *who;
    int P;
    size_t N;
    double seconds, error;
} runs[1000];
static size_t made;

static void keep_front(const contender *c, int P, double time, double error)
{
    for (int k = 1; k <= DECADES; k++) {
        fastest *f = &front[P][c->ours][k];
        if (error > pow(10, -k) || (f->seconds > 0 && f->seconds <= time))
            continue;
        f->seconds = time;
        snprintf(f->name, sizeof f->name, "%s", c->name);
    }
}

/* N = 80, 160, ... until the next run would take too long, or rounding rules. */
static void curve(const contender *c, int P, double most)
{
    static double rows[(ROWS + 1) * D];
    double before = GSL_POSINF, time = 0;
    printf("# P%d %s:\n# N\tseconds\terror, t >= 2\terror\torder\n", P + 1,
           c->name);
    for (size_t N = ROWS; N <= (size_t)1 << 24; N *= 2) {
        double last = time;
        time = seconds(c, P, N, rows);
        if (time == 0) /* too long a step */
            continue;
        double error = error_from(P, 2, rows);
        printf("%zu\t%.3e\t%.3e\t%.3e\t%.2f\n", N, time, error,
               error_from(P, 0, rows), log2(before / error));
        keep_front(c, P, time, error);
        if (made < sizeof runs / sizeof *runs) {
            runs[made].who = c;
            runs[made].P = P;
            runs[made].N = N;
            runs[made].seconds = time;
            runs[made++].error = error;
        }
        if (isatty(STDERR_FILENO))
            fprintf(stderr, "\rP%d %-40s %10zu", P + 1, c->name, N);
        if (time * fmax(2, last > 0 ? time / last : 2) > most
            || (error < 1e-9 && error > before / 2))
            break;
        before = error;
    }
    printf("\n\n");
}

/* Padded too, to be read as they are. */
static void print_fronts(void)
{
    static const char row[] = "%-7s\t%-7s\t%-20s\t%-7s\t%-17s\t%s\n";
    for (int P = 0; P < PROBLEMS; P++) {
        printf("# P%d: the fastest, by error\n#> fronts-%d\n", P + 1, P + 1);
        printf(row, "# error", "our ms", "ours", "peer ms", "peer",
               "times as long");
        for (int k = 1; k <= DECADES; k++) {
            char error[8], ms[2][20] = { "-", "-" }, ratio[20] = "-";
            const fastest *f[2] = { &front[P][1][k], &front[P][0][k] };
            snprintf(error, sizeof error, "1e-%02d", k);
            for (int i = 0; i < 2; i++)
                if (f[i]->seconds > 0)
                    snprintf(ms[i], sizeof ms[i], "%.3g", 1e3 * f[i]->seconds);
            if (f[0]->seconds > 0 && f[1]->seconds > 0)
                snprintf(ratio, sizeof ratio, "%.3g",
                         f[1]->seconds / f[0]->seconds);
            printf(row, error, ms[0], f[0]->name, ms[1],
                   f[1]->seconds > 0 ? f[1]->name : "-", ratio);
        }
        printf("#< fronts-%d\n\n\n", P + 1);
    }
}

/* The least time of a method on P, with any memory, for an error of 10^-k. */
static double least_time(int P, const char *name, int k)
{
    double least = GSL_POSINF;
    for (size_t i = 0; i < made; i++)
        if (runs[i].P == P && runs[i].error <= pow(10, -k)
            && strncmp(runs[i].who->name, name, strlen(name)) == 0)
            least = fmin(least, runs[i].seconds);
    return least;
}

/* The product trapezoid and fvi-shifted are both of order 2: what parts them is
 * the memory, what parts fvi-shifted from the fastest is mostly the order. At
 * one digit, and at as many as both reach. */
static void print_shares(void)
{
    static const char peer[] = "product trapezoid", ours[] = "fvi-shifted";
    printf("# the lead in two factors\n#> shares\n"
           "# problem, error\ttrapezoid over shifted\tshifted over fastest\n");
    for (int P = 0; P < PROBLEMS; P++) {
        int digits[2] = { 1, DECADES };
        while (gsl_isinf(least_time(P, peer, digits[1]))
               || gsl_isinf(least_time(P, ours, digits[1])))
            digits[1]--;
        for (int i = 0; i < 2; i++) {
            double shifted = least_time(P, ours, digits[i]);
            printf("P%d, 1e-%02d       \t%-22.3g\t%.3g\n", P + 1, digits[i],
                   least_time(P, peer, digits[i]) / shifted,
                   shifted / front[P][1][digits[i]].seconds);
        }
    }
    printf("#< shares\n\n\n");
}

/* The runs of peers of which none of ours is both as fast and as exact. */
static void print_unbeaten(void)
{
    printf("# not beaten by any run of ours\n#> unbeaten\n"
           "# problem\tpeer             \tN\tms     \terror\n");
    for (size_t i = 0; i < made; i++) {
        int beaten = runs[i].who->ours;
        for (size_t j = 0; j < made && !beaten; j++)
            beaten = runs[j].who->ours && runs[j].P == runs[i].P
                     && runs[j].seconds <= runs[i].seconds
                     && runs[j].error <= runs[i].error;
        if (!beaten)
            printf("P%-8d\t%-17s\t%zu\t%-7.3g\t%.2g\n", runs[i].P + 1,
                   runs[i].who->name, runs[i].N, 1e3 * runs[i].seconds,
                   runs[i].error);
    }
    printf("#< unbeaten\n");
}

/* Every method of the table that remembers, with both memories; then those that are
 * compared with them. Returns how many there are. */
enum { MOST_CONTENDERS = 64 };
static size_t gather(contender *all)
{
    enum { MEMORY = 1 | 4 | 8, ALL = 15, LINEAR = 2, REST = 1 };
    const fvi_memory_kind DIRECT = FVI_MEMORY_DIRECT,
                          kinds[] = { DIRECT, FVI_MEMORY_EXPONENTIALS };
    static char names[MOST_CONTENDERS][32];
    size_t count = 0;
    for (size_t k = 0; k < 2; k++)
        for (size_t i = 0; fvi_methods[i]; i++) {
            if (!fvi_methods[i]->memories)
                continue;
            snprintf(names[count], sizeof names[count], "%s%s",
                     fvi_methods[i]->name, k ? "" : ", direct");
            all[count] = (contender){ names[count], fvi_methods[i], kinds[k],
                                      k ? ALL : MEMORY, 1 };
            count++;
        }
    const contender others[] = {
        { "explicit Euler", &fvi_euler_explicit, DIRECT, LINEAR, 0 },
        { "implicit Euler", &fvi_euler_implicit, DIRECT, LINEAR, 0 },
        { "matrix method", NULL, DIRECT, REST, 0 },
        { "product trapezoid", NULL, DIRECT, ALL, 0 },
    };
    memcpy(all + count, others, sizeof others);
    return count + sizeof others / sizeof *others;
}

int main(void)
{
    static contender all[MOST_CONTENDERS];
    const size_t count = gather(all);
    describe();
    set_up();
    find_truth();
    printf("\n\n");
    for (int P = 0; P < PROBLEMS; P++)
        for (size_t i = 0; i < count; i++)
            if (all[i].problems & 1 << P)
                curve(&all[i], P, all[i].ours ? 0.12 : 0.6);
    print_fronts();
    print_shares();
    print_unbeaten();
    if (isatty(STDERR_FILENO))
        fprintf(stderr, "\r%60s\r", "");
    return EXIT_SUCCESS;
}
