/* tests/bench/variable.c -- Runs with steps of any length, for two benchmarks. [H 22] */
#define _POSIX_C_SOURCE 200809L /* clock_gettime, uname */
#include "variable.h"
#include "run/whole_run.h"
#include "bench.h"
#include "system/larger.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_math.h>
#include <gsl/gsl_odeiv2.h>
#include <stdlib.h>

enum { ROWS = BENCH_ROWS, D = BENCH_MASSES, MOST = BENCH_STEPS };

static double ones[D], damping[D], zeros[D], bent[D];
static const double half = 0.5, cubic[] = { 0, 1 }, drive[] = { 1, 1 },
                    link[] = { 1, 1 };

void bench_need(int status)
{
    if (status)
        exit(EXIT_FAILURE);
}

/* ---- problems ---- */

void bench_linear(bench_problem *P, const char *name, double alpha,
                  const double *of, double T)
{
    *P = (bench_problem){ .name = name, .linear = 1 };
    memcpy(P->fixed, of, 5 * sizeof *of);
    P->system =
        (fvi_system){ .d = 1, .mass = P->fixed, .damping = P->fixed + 1 };
    P->system.potential = fvi_potential_harmonic(P->fixed + 2);
    P->fixed[5] = of[0] * of[4]; /* p0 */
    P->run = fvi_run_default(NULL, P->fixed + 3, P->fixed + 5, T / ROWS, ROWS);
    P->run.alpha = alpha;
    P->run.past = FVI_INITIAL_HISTORY_CAPUTO;
    P->exact = (fvi_linear_oscillator){ .m = of[0],
                             .rho = of[1],
                             .c = of[2],
                             .alpha = alpha,
                             .past = FVI_INITIAL_HISTORY_CAPUTO,
                             .x0 = of[3],
                             .v0 = of[4] };
}

/* Store the two numbers of a force in the problem, where they stay. Return their place. */
static double *kept(bench_problem *P, double A, double T_or_w)
{
    P->fixed[6] = P->exact.A = A;
    P->fixed[7] = T_or_w;
    return P->fixed + 6;
}

void bench_step(bench_problem *P, double A, double T)
{
    P->system.force = fvi_force_step(kept(P, A, T));
    P->exact.forcing = FVI_FORCING_STEP;
    P->exact.T = T;
}

void bench_cosine(bench_problem *P, double A, double w)
{
    P->system.force = fvi_force_cosine(kept(P, A, w));
    P->exact.forcing = FVI_FORCING_COSINE;
    P->exact.w = w;
}

static void other(bench_problem *P, const char *name, size_t d, double rho,
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
    P->run.past = FVI_INITIAL_HISTORY_CAPUTO;
}

void bench_problems(bench_problem *all)
{
    static const double at_rest[] = { 1, 1, 1, 0, 0 },
                        little[] = { 1, 0.2, 1, 1, 0.5 },
                        with_speed[] = { 1, 1, 1, 1, 0.5 },
                        bent_once[] = { 1, 1, 1, 1, 0 };
    for (size_t i = 0; i < D; i++) {
        ones[i] = 1;
        bent[i] = sin(3 * M_PI * (double)(i + 1) / (D + 1));
    }
    bench_linear(&all[PLATE], "plate", 0.75, at_rest, 20);
    bench_step(&all[PLATE], 8, 1);
    bench_linear(&all[LATE], "late", 0.75, at_rest, 20);
    bench_step(&all[LATE], 8, 0.7310585);
    bench_linear(&all[SPRING], "spring", 0.5, little, 20);
    other(&all[DUFFING], "duffing", 1, 0.5, zeros, 50);
    all[DUFFING].system.potential = fvi_potential_duffing(cubic);
    all[DUFFING].system.force = fvi_force_cosine(drive);
    other(&all[CHAIN], "chain", D, 0.2, bent, 20);
    all[CHAIN].system.potential = fvi_potential_chain(link);
    bench_linear(&all[KICKED], "kicked", 0.2, with_speed, 20);
    all[KICKED].run.past = all[KICKED].exact.past = FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE;
    bench_linear(&all[SLOW], "slow", 0.3, bent_once, 1e7);
    bench_linear(&all[SLOW_HIGH], "slow, alpha = 3/4", 0.75, bent_once, 1e7);
    bench_linear(&all[SLOWER], "slow, to 1e9", 0.3, bent_once, 1e9);
    bench_linear(&all[SLOWER_HIGH], "slow, alpha = 3/4, to 1e9", 0.75,
                 bent_once, 1e9);
    for (size_t i = 0; i < BENCH_PROBLEMS; i++)
        bench_truth(&all[i]);
}

/* ---- runs ---- */

void bench_rows(const bench_problem *P, double tolerance, double *x, double *v)
{
    fvi_run run = P->run;
    run.system = &P->system;
    run.step_error = tolerance;
    bench_need(fvi_trajectory(&fvi_variable_step, &run, x, v, NULL));
    for (size_t k = 0; v && k <= ROWS; k++)
        for (size_t j = 0; j < P->system.d; j++)
            v[k * P->system.d + j] /= P->system.mass[j];
}

fvi_stepper *bench_start(const bench_problem *P, double tolerance)
{
    fvi_run run = P->run;
    fvi_stepper *s;
    run.system = &P->system;
    run.step_error = tolerance;
    bench_need(fvi_stepper_start(&fvi_variable_step, &run, &s, NULL));
    return s;
}

fvi_step_statistics bench_steps(const bench_problem *P, double tolerance,
                                double *t, double *x)
{
    fvi_stepper *s = bench_start(P, tolerance);
    fvi_step_statistics counts;
    for (size_t n = 0; s->k < P->run.steps; n++) {
        bench_need(fvi_stepper_step(s) || n == MOST);
        if (t) {
            t[n] = s->t;
            x[n] = s->x[0];
        }
    }
    bench_need(fvi_stepper_statistics(s, &counts));
    fvi_stepper_free(s);
    return counts;
}

double bench_seconds(const bench_problem *P, double tolerance)
{
    double least = HUGE_VAL, begin = now();
    for (int i = 0; i < 9 || (now() - begin < 0.1 && i < 2000); i++) {
        const double start = now();
        bench_steps(P, tolerance, NULL, NULL);
        const double took = now() - start;
        least =
            took > 0 ? smaller(least, took) : least; /* the clock may not have moved */
    }
    return least;
}

/* Compute x at the ends of steps: exactly, or, for the first coordinate, by a run with smaller errors. */
static void truth_at(const bench_problem *P, size_t n, const double *t,
                     double *x)
{
    static double v[MOST], all[D];
    if (P->linear) {
        bench_need(fvi_exact_at(&P->exact, n, t, x, v, NULL));
        return;
    }
    fvi_run run = P->run;
    fvi_stepper *s;
    run.system = &P->system;
    run.step_error = 1e-14;
    bench_need(fvi_stepper_start(&fvi_variable_step, &run, &s, NULL));
    for (size_t k = 0; k < n; k++) {
        bench_need(fvi_stepper_advance_to(s, t[k], all, NULL));
        x[k] = all[0];
    }
    fvi_stepper_free(s);
}

fvi_step_statistics bench_errors(const bench_problem *P, double tolerance,
                                 size_t every, double *ends, double *rows)
{
    static double x[(ROWS + 1) * D], t[MOST], end[MOST], exact[MOST];
    *rows = *ends = 0;
    bench_rows(P, tolerance, x, NULL);
    for (size_t k = 0; k <= ROWS; k += every)
        for (size_t i = k * P->system.d; i < (k + 1) * P->system.d; i++)
            *rows = larger(*rows, fabs(x[i] - P->truth[i]));
    const fvi_step_statistics counts = bench_steps(P, tolerance, t, end);
    truth_at(P, counts.steps, t, exact);
    for (size_t n = 0; n < counts.steps; n++)
        *ends = larger(*ends, fabs(end[n] - exact[n]));
    return counts;
}

void bench_truth(bench_problem *P)
{
    double t[ROWS + 1], v[ROWS + 1];
    for (size_t k = 0; k <= ROWS; k++)
        t[k] = (double)k * P->run.h;
    if (P->linear)
        bench_need(fvi_exact_at(&P->exact, ROWS + 1, t, P->truth, v, NULL));
    else
        bench_rows(P, 1e-14, P->truth, NULL);
}

/* Compute the slope of y = (x, x') for x'' = -0.2 x' - x. */
static int springs(double t, const double *y, double *slope, void *nothing)
{
    (void)t, (void)nothing;
    slope[0] = y[1];
    slope[1] = -0.2 * y[1] - y[0];
    return GSL_SUCCESS;
}

static double rk8pd(void)
{
    const double start = now();
    const gsl_odeiv2_system system = { springs, NULL, 2, NULL };
    gsl_odeiv2_driver *driver = gsl_odeiv2_driver_alloc_y_new(
        &system, gsl_odeiv2_step_rk8pd, 0.01, 1e-12, 1e-12);
    double t = 0, y[] = { 1, 0.5 };
    bench_need(!driver || gsl_odeiv2_driver_apply(driver, &t, 20, y));
    gsl_odeiv2_driver_free(driver);
    return now() - start;
}

double bench_over_rk8pd(const bench_problem *P, double tolerance,
                        double *seconds)
{
    double its = HUGE_VAL, ours = HUGE_VAL;
    for (int turn = 0; turn < 60; turn++)
        for (int i = 0; i < 10; i++) {
            const double a = rk8pd(), start = now();
            if (i < 5)
                bench_steps(P, tolerance, NULL, NULL);
            const double b = now() - start;
            its = a > 0 ? smaller(its, a) : its; /* the clock may not have moved */
            ours = b > 0 && i < 5 ? smaller(ours, b) : ours;
        }
    if (seconds)
        *seconds = its;
    return ours / its;
}
