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
 * A time is the least of several, from fvi_start to fvi_stop, without rows.
 *
 * Two tables compare with the prototype that this method was first tried in, a scalar one
 * whose tables of modes were made beforehand, on another machine: the runs that it was
 * measured by, its steps and errors, and those of ours with the largest tolerance of 10^{-n/4}
 * that is as exact; and the times, over that of GSL's rk8pd on `spring` with the tolerance
 * 1e-12, each on its machine. */
#define _POSIX_C_SOURCE 200809L /* clock_gettime, uname */
#include <fvi/exact_solution.h>
#include <fvi/fvi.h>
#include "bench.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_math.h>
#include <gsl/gsl_odeiv2.h>
#include <stdlib.h>

enum { ROWS = 400, D = 32, MOST = 100000, SHOWN = 7, ALL = 10 };

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

static void set_up(problem *all)
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
    linear(&all[7], "slow, alpha = 3/4", 0.75, &one, &one, zeros, 1e7);
    linear(&all[8], "slow, to 1e9", 0.3, &one, &one, zeros, 1e9);
    linear(&all[9], "slow, alpha = 3/4, to 1e9", 0.75, &one, &one, zeros, 1e9);
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

/* The errors of a run, at the ends of its steps, where the truth is known there, and in the
 * rows. */
static fvi_adaptive_counts errors_of(problem *P, double tolerance, double *ends,
                                     double *rows)
{
    static double x[(ROWS + 1) * D], t[MOST], end[MOST], exact[MOST], v[MOST];
    const size_t d = P->system.d;
    *rows = *ends = 0;
    rows_of(P, tolerance, x);
    for (size_t k = 0; k < (ROWS + 1) * d; k++)
        *rows = fmax(*rows, fabs(x[k] - P->truth[k]));
    const fvi_adaptive_counts counts = steps_of(P, tolerance, t, end);
    if (!P->linear)
        return counts;
    need(fvi_exact(&P->exact, counts.steps, t, exact, v));
    for (size_t n = 0; n < counts.steps; n++)
        *ends = fmax(*ends, fabs(end[n] - exact[n]));
    return counts;
}

static void measure(problem *P, double tolerance)
{
    double rows, ends;
    const fvi_adaptive_counts counts = errors_of(P, tolerance, &ends, &rows);
    printf("%s, %.0e\t%d\t%zu\t%zu\t", P->name, tolerance, counts.stages,
           counts.steps, counts.rejected);
    if (P->linear)
        printf("%.2g\t", ends);
    else
        printf("-\t");
    printf("%.2g\t%.3g\n", rows, 1e6 * seconds(P, tolerance));
    fflush(stdout);
}

static void find_truth(problem *P)
{
    double t[ROWS + 1], v[ROWS + 1];
    for (size_t k = 0; k <= ROWS; k++)
        t[k] = (double)k * P->run.h;
    if (P->linear)
        need(fvi_exact(&P->exact, ROWS + 1, t, P->truth, v));
    else
        rows_of(P, 1e-14, P->truth);
}

/* ---- the prototype ---- */

/* x'' = - 0.2 x' - x */
static int springs(double t, const double *y, double *slope, void *nothing)
{
    (void)t, (void)nothing;
    slope[0] = y[1];
    slope[1] = -0.2 * y[1] - y[0];
    return GSL_SUCCESS;
}

/* Seconds of rk8pd on `spring`, by its own steps. */
static double rk8pd(void)
{
    double least = HUGE_VAL;
    for (int i = 0; i < 2000; i++) {
        const double start = now();
        const gsl_odeiv2_system system = { springs, NULL, 2, NULL };
        gsl_odeiv2_driver *driver = gsl_odeiv2_driver_alloc_y_new(
            &system, gsl_odeiv2_step_rk8pd, 0.01, 1e-12, 1e-12);
        double t = 0, y[] = { 1, 0.5 };
        need(!driver || gsl_odeiv2_driver_apply(driver, &t, 20, y));
        gsl_odeiv2_driver_free(driver);
        least = fmin(least, now() - start);
    }
    return least;
}

/* What it took: its error at the ends of its steps or in rows, its steps, where they are
 * known, its time over that of rk8pd, 13.2 us. */
static const struct {
    int problem, in_rows;
    double error;
    size_t steps;
    double times;
} prototype[] = {
    { 0, 0, 3.3e-9, 27, 10.5 / 13.2 }, { 0, 0, 7.4e-11, 25, 12.6 / 13.2 },
    { 0, 0, 2.6e-12, 29, 15 / 13.2 },  { 0, 0, 1.6e-12, 32, 15.8 / 13.2 },
    { 0, 0, 1.2e-13, 36, 18 / 13.2 },  { 0, 0, 3.7e-14, 42, 21 / 13.2 },
    { 0, 0, 2.6e-14, 62, 29 / 13.2 },  { 0, 0, 2.0e-14, 93, 39 / 13.2 },
    { 1, 0, 2.0e-14, 60, 28 / 13.2 },  { 1, 1, 3.0e-13, 60, 28 / 13.2 },
    { 2, 0, 3.0e-15, 0, 9.4 / 13.2 },  { 3, 1, 1.0e-8, 0, 131 / 13.2 },
    { 3, 1, 4.0e-11, 0, 175 / 13.2 },  { 4, 1, 4.9e-13, 24, 230 / 13.2 },
    { 4, 1, 1.4e-14, 0, 370 / 13.2 },  { 5, 1, 4.0e-15, 0, 47 / 13.2 },
    { 6, 0, 6.0e-14, 109, 55 / 13.2 }, { 7, 0, 1.0e-13, 99, 50 / 13.2 },
    { 8, 0, 6.0e-14, 252, 0 },         { 9, 0, 1.0e-13, 104, 0 },
};
enum { COMPARED = sizeof prototype / sizeof *prototype };

/* The largest tolerance whose run is as exact as the prototype's, or 0; its error, its
 * steps. */
static double as_exact(problem *P, int n, double *error, size_t *steps)
{
    for (int q = 8; q <= 58; q++) {
        const double tolerance = pow(10, -q / 4.0);
        double ends, rows;
        *steps = errors_of(P, tolerance, &ends, &rows).steps;
        *error = prototype[n].in_rows ? rows : ends;
        if (*error <= prototype[n].error)
            return tolerance;
    }
    return 0;
}

static void compare(problem *all)
{
    double tolerance[COMPARED];
    printf("\n\n#> prototype\n# run\twhere\tits error\tits steps\ttolerance\t"
           "error\tsteps\n");
    for (int n = 0; n < COMPARED; n++) {
        problem *P = &all[prototype[n].problem];
        double error;
        size_t steps;
        tolerance[n] = as_exact(P, n, &error, &steps);
        printf("%s\t%s\t%.1e\t", P->name,
               prototype[n].in_rows ? "rows" : "ends", prototype[n].error);
        if (prototype[n].steps)
            printf("%zu\t", prototype[n].steps);
        else
            printf("-\t");
        if (tolerance[n] > 0)
            printf("%.1e\t%.1e\t%zu\n", tolerance[n], error, steps);
        else
            printf("-\t-\t-\n");
    }
    const double unit = rk8pd();
    printf("#< prototype\n\n\n#> prototype-times\n# run, error\tits time over "
           "rk8pd\tours\tours, microseconds\n");
    for (int n = 0; n < COMPARED; n++) {
        const problem *P = &all[prototype[n].problem];
        if (prototype[n].times == 0 || tolerance[n] == 0)
            continue;
        const double time = seconds(P, tolerance[n]);
        printf("%s, %.1e\t%.2g\t%.2g\t%.3g\n", P->name, prototype[n].error,
               prototype[n].times, time / unit, 1e6 * time);
    }
    printf("#< prototype-times\n");
}

int main(void)
{
    static problem all[ALL];
    describe();
    printf("# problem and tolerance of a step; errors at the ends of the "
           "steps, in 400 rows; "
           "microseconds\n");
    set_up(all);
    for (size_t i = 0; i < ALL; i++)
        find_truth(&all[i]);
    for (size_t i = 0; i < SHOWN; i++) {
        printf("\n\n#> %s\n# run\tstages\tsteps\trejected\tends\trows\ttime\n",
               all[i].name);
        for (double tolerance = 1e-4; tolerance > 1e-13; tolerance /= 100)
            measure(&all[i], tolerance);
        printf("#< %s\n", all[i].name);
    }
    compare(all);
    return EXIT_SUCCESS;
}
