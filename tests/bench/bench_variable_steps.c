/* tests/bench/bench_variable_steps.c -- Chapter 22: what steps of any length take.
 * Tables to be kept in figures/variable_steps/variable_steps.tsv; `make bench`.
 *
 *     plate     x'' + D^{3/2} x + x = 8 for t <= 1, then 0, at rest, T = 20
 *     late      the same, with the jump at t = 0.7310585
 *     spring    x'' + 0.2 x' + x = 0, x(0) = 1, x'(0) = 1/2, T = 20
 *     duffing   x'' + 0.5 D^{0.6} x + x^3 = cos t, at rest, T = 50
 *     chain     32 masses between walls, springs r + r^3, 0.2 D^{0.6} on each, T = 20
 *     kicked    x'' + D^{0.4} x + x = 0, Riemann-Liouville, x(0) = 1, x'(0) = 1/2, T = 20
 *     slow      x'' + D^{0.6} x + x = 0, x(0) = 1, at rest, T = 10^7
 *
 * The error is the largest |x - x(t)|, at the ends of all steps, and at 400 rows between.
 * A time is the least of several, from fvi_start to fvi_stop, without rows. */
#define _POSIX_C_SOURCE 200809L /* clock_gettime, uname */
#include <fvi/exact_solution.h>
#include <fvi/fvi.h>
#include "bench.h"

#include <gsl/gsl_math.h>
#include <stdlib.h>

enum { ROWS = 400, D = 32, MOST = 100000 };

typedef struct {
    const char *name;
    fvi_system system;
    fvi_run run;
    int linear; /* then its exact solution: */
    fvi_linear exact;
    double truth[(ROWS + 1) * D]; /* else that of a run with 1e-14 */
} problem;

static double ones[D], damping[D], zeros[D], bent[D];
static const double one = 1, half = 0.5, fifth = 0.2, plate[] = { 8, 1 },
                    late[] = { 8, 0.7310585 }, cubic[] = { 0, 1 },
                    drive[] = { 1, 1 }, link[] = { 1, 1 };

static void need(int status)
{
    if (status)
        exit(EXIT_FAILURE);
}

/* ---- problems ---- */

static void linear(problem *P, const char *name, double alpha,
                   const double *rho, const double *x0, const double *p0,
                   double T)
{
    P->name = name;
    P->linear = 1;
    P->system = (fvi_system){ .d = 1, .mass = &one, .damping = rho };
    P->system.potential = fvi_potential_harmonic(&one);
    P->run = fvi_run_default(NULL, x0, p0, T / ROWS, ROWS);
    P->run.alpha = alpha;
    P->run.past = FVI_PAST_CAPUTO;
    P->exact = (fvi_linear){ .m = 1,
                             .c = 1,
                             .rho = *rho,
                             .alpha = alpha,
                             .past = FVI_PAST_CAPUTO,
                             .x0 = *x0,
                             .v0 = *p0 };
}

static void pushed(problem *P, const char *name, const double *AT)
{
    linear(P, name, 0.75, &one, zeros, zeros, 20);
    P->system.force = fvi_force_step(AT);
    P->exact.forcing = FVI_FORCING_STEP;
    P->exact.A = AT[0];
    P->exact.T = AT[1];
}

static void other(problem *P, const char *name, size_t d, double rho,
                  const double *x0, double T)
{
    P->name = name;
    for (size_t i = 0; i < d; i++)
        (d > 1 ? damping : ones)[i] = d > 1 ? rho : 1;
    P->system = (fvi_system){ .d = d,
                              .mass = ones,
                              .damping = d > 1 ? damping : &half };
    P->run = fvi_run_default(NULL, x0, zeros, T / ROWS, ROWS);
    P->run.alpha = 0.3;
    P->run.past = FVI_PAST_CAPUTO;
}

static size_t set_up(problem *all)
{
    for (size_t i = 0; i < D; i++) {
        ones[i] = 1;
        bent[i] = sin(3 * M_PI * (double)(i + 1) / (D + 1));
    }
    pushed(&all[0], "plate", plate);
    pushed(&all[1], "late", late);
    linear(&all[2], "spring", 0.5, &fifth, &one, &half, 20);
    other(&all[3], "duffing", 1, 0.5, zeros, 50);
    all[3].system.potential = fvi_potential_duffing(cubic);
    all[3].system.force = fvi_force_cosine(drive);
    other(&all[4], "chain", D, 0.2, bent, 20);
    all[4].system.potential = fvi_potential_chain(link);
    linear(&all[5], "kicked", 0.2, &one, &one, &half, 20);
    all[5].run.past = all[5].exact.past = FVI_PAST_RIEMANN_LIOUVILLE;
    linear(&all[6], "slow", 0.3, &one, &one, zeros, 1e7);
    return 7;
}

/* ---- runs ---- */

/* The rows of a run, by dense output. */
static void rows_of(problem *P, double tolerance, double *x)
{
    fvi_run run = P->run;
    run.system = &P->system;
    run.step_error = tolerance;
    need(fvi_trajectory(&fvi_adaptive, &run, x, NULL, NULL));
}

/* Its steps: how many, their ends, and x there if it is asked for. */
static fvi_adaptive_counts steps_of(const problem *P, double tolerance,
                                    double *t, double *x)
{
    fvi_run run = P->run;
    fvi_stepper *s;
    fvi_adaptive_counts counts;
    run.system = &P->system;
    run.step_error = tolerance;
    need(fvi_start(&fvi_adaptive, &run, &s));
    for (size_t n = 0; s->k < run.steps; n++) {
        need(fvi_step(s) || n == MOST);
        if (t) {
            t[n] = s->t;
            x[n] = s->x[0];
        }
    }
    need(fvi_adaptive_look(s, &counts));
    fvi_stop(s);
    return counts;
}

static double seconds(const problem *P, double tolerance)
{
    double least = HUGE_VAL, begin = now();
    for (int i = 0; i < 9 || (now() - begin < 0.1 && i < 2000); i++) {
        const double start = now();
        steps_of(P, tolerance, NULL, NULL);
        least = fmin(least, now() - start);
    }
    return least;
}

static void measure(problem *P, double tolerance)
{
    static double x[(ROWS + 1) * D], t[MOST], end[MOST], exact[MOST], v[MOST];
    double rows = 0, ends = 0;
    const size_t d = P->system.d;
    rows_of(P, tolerance, x);
    for (size_t k = 0; k < (ROWS + 1) * d; k++)
        rows = fmax(rows, fabs(x[k] - P->truth[k]));
    const fvi_adaptive_counts counts = steps_of(P, tolerance, t, end);
    if (P->linear) {
        need(fvi_exact(&P->exact, counts.steps, t, exact, v));
        for (size_t n = 0; n < counts.steps; n++)
            ends = fmax(ends, fabs(end[n] - exact[n]));
    }
    printf("%s, %.0e\t%d\t%zu\t%zu\t", P->name, tolerance, counts.stages,
           counts.steps, counts.rejected);
    if (P->linear)
        printf("%.2g\t", ends);
    else
        printf("-\t");
    printf("%.2g\t%.3g\n", rows, 1e6 * seconds(P, tolerance));
    fflush(stdout);
}

int main(void)
{
    static problem all[7];
    describe();
    printf("# problem and tolerance of a step; errors at the ends of the "
           "steps, in 400 rows; "
           "microseconds\n");
    const size_t count = set_up(all);
    for (size_t i = 0; i < count; i++) {
        problem *P = &all[i];
        printf("\n\n#> %s\n# run\tstages\tsteps\trejected\tends\trows\ttime\n",
               P->name);
        if (P->linear) {
            double t[ROWS + 1], v[ROWS + 1];
            for (size_t k = 0; k <= ROWS; k++)
                t[k] = (double)k * P->run.h;
            need(fvi_exact(&P->exact, ROWS + 1, t, P->truth, v));
        } else {
            rows_of(P, 1e-14, P->truth);
        }
        for (double tolerance = 1e-4; tolerance > 1e-13; tolerance /= 100)
            measure(P, tolerance);
        printf("#< %s\n", P->name);
    }
    return EXIT_SUCCESS;
}
