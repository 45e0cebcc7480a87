/* tests/bench/bench_prototype.c -- H 22: the library beside the prototype of variable steps.
 *
 * Prints tables, which are kept in figures/variable_steps/prototype.tsv: `make bench`.
 *
 * Steps of any length were first tried in a throwaway program for one coordinate, whose tables of modes were made
 * beforehand, in both forms and with more numbers of stages. All its measurements are here, beside those of the
 * library:
 *
 *       orders    at constant steps, by fvi-lobatto3 to 6 and 3d to 6d, t >= 2
 *       runs      the largest error at the ends of the steps or in 400 rows, the steps, and the time divided by
 *                 that of GSL's rk8pd on `spring` with the tolerance 1e-12, each on its machine;
 *                 the library's run is the one with the largest tolerance 10^{-n/4} that is as exact
 *       alike     the plate by eight stages once more, with the start of the library's run as the prototype's
 *       alphas    the same with the tolerance 1e-12 for both, for many orders
 *       random    200 linear problems: errors divided by tolerances
 *       two-runs  the true error of a run divided by its difference from a finer one
 *       long      many steps
 *
 * The problems are those of bench_variable_steps.c. */
#define _POSIX_C_SOURCE 200809L /* clock_gettime, uname */
#include "variable.h"
#include "run/whole_run.h"
#include "bench.h"
#include "prototype.h"
#include "variable_step/variable_step.h"
#include "system/larger.h"

#include <gsl/gsl_math.h>
#include <stdlib.h>

/* Print a number that may be unknown. */
static void known(const char *format, double value)
{
    if (value > 0)
        printf(format, value);
    else
        printf("\t-");
}

/* ---- orders ---- */

/* Compute the largest errors of x and of v over t >= 2 with N steps. */
static void uniform(const bench_problem *P, const char *method, size_t N,
                    double *of_x, double *of_v)
{
    static double x[4096], p[4096], t[4096], exact[4096], v[4096];
    fvi_run run = P->run;
    run.system = &P->system;
    run.h = 20. / (double)N;
    run.steps = N;
    bench_need(fvi_trajectory(fvi_method_find(method), &run, x, p, NULL));
    for (size_t k = 0; k <= N; k++)
        t[k] = (double)k * run.h;
    bench_need(fvi_exact_at(&P->exact, N + 1, t, exact, v, NULL));
    *of_x = *of_v = 0;
    for (size_t k = N / 10; k <= N; k++) {
        *of_x = larger(*of_x, fabs(x[k] - exact[k]));
        *of_v = larger(*of_v, fabs(p[k] - v[k]));
    }
}

/* Compute the order from 160 to 320 steps, or from the last doubling whose errors are above rounding. */
static void order(const bench_problem *P, const char *method, double *of_x,
                  double *of_v)
{
    double x[5], v[5];
    for (int i = 0; i < 5; i++)
        uniform(P, method, (size_t)20 << i, &x[i], &v[i]);
    *of_x = *of_v = 0;
    for (int i = 0; i < 4; i++) {
        if (x[i + 1] > 1e-13)
            *of_x = log2(x[i] / x[i + 1]);
        if (v[i + 1] > 1e-13)
            *of_v = log2(v[i] / v[i + 1]);
    }
}

static void orders(const bench_problem *all)
{
    static bench_problem driven, moved;
    static const double at_rest[] = { 1, 1, 1, 0, 0 },
                        away[] = { 1, 1, 1, 1, 0.5 };
    bench_linear(&driven, "driven", 0.75, at_rest, 20);
    bench_cosine(&driven, 1, 1);
    bench_linear(&moved, "moved", 0.3, away, 20);
    const bench_problem *problems[] = { &all[PLATE], &driven, &moved };
    printf("\n\n#> orders\n# problem\tform\tstages\tits x\tits p\tx\tp\n");
    for (size_t i = 0; i < sizeof its_orders / sizeof *its_orders; i++) {
        char method[32];
        double x, v;
        snprintf(method, sizeof method, "fvi-lobatto%d%s", its_orders[i].s,
                 its_orders[i].form == 'D' ? "d" : "");
        order(problems[its_orders[i].problem], method, &x, &v);
        printf("%s\t%c\t%d\t%.1f\t%.1f", problems[its_orders[i].problem]->name,
               its_orders[i].form, its_orders[i].s, its_orders[i].x,
               its_orders[i].p);
        known("\t%.1f", x);
        known("\t%.1f", v);
        printf("\n");
    }
    printf("#< orders\n\n\n#> uniform\n# plate, t >= 2: form\tstages\tsteps\t"
           "its error\terror\n");
    for (size_t i = 0; i < sizeof its_uniform / sizeof *its_uniform; i++) {
        char method[32];
        double x, v;
        snprintf(method, sizeof method, "fvi-lobatto%d%s", its_uniform[i].s,
                 its_uniform[i].form == 'D' ? "d" : "");
        uniform(&all[PLATE], method, its_uniform[i].N, &x, &v);
        printf("%c\t%d\t%zu\t%.1e\t%.1e\n", its_uniform[i].form,
               its_uniform[i].s, its_uniform[i].N, its_uniform[i].error, x);
    }
    printf("#< uniform\n");
}

/* ---- runs ---- */

/* Return the largest tolerance whose run is as exact as the prototype's, or 0. */
static double as_exact(const bench_problem *P, its_where where, double wanted,
                       double *error, size_t *steps)
{
    for (int q = 8; q <= 58; q++) {
        const double tolerance = pow(10, -q / 4.0);
        double ends, rows;
        *steps =
            bench_errors(P, tolerance, where == IN_80 ? 5 : 1, &ends, &rows)
                .steps;
        *error = where == AT_ENDS ? ends : rows;
        if (*error <= wanted)
            return tolerance;
    }
    return 0;
}

static void compare(const bench_problem *all)
{
    printf(
        "\n\n#> runs\n# run\tits form\twhere\tits error\tits steps\tits time\t"
        "tolerance\terror\tsteps\ttime\n");
    for (size_t i = 0; i < sizeof its_runs / sizeof *its_runs; i++) {
        const bench_problem *P = &all[its_runs[i].problem];
        double error;
        size_t steps;
        const double tolerance =
            as_exact(P, its_runs[i].where, its_runs[i].error, &error, &steps);
        printf("%s\t%s\t%s\t%.1e", P->name, its_runs[i].form,
               its_runs[i].where == AT_ENDS   ? "ends"
               : its_runs[i].where == IN_ROWS ? "rows"
                                              : "80 rows",
               its_runs[i].error);
        known("\t%.0f", (double)its_runs[i].steps);
        known("\t%.2g", its_runs[i].time / ITS_RK8PD);
        if (tolerance == 0) {
            printf("\t-\t%.1e\t-\t-\n", error);
            continue;
        }
        printf("\t%.1e\t%.1e\t%zu\t%.2g\n", tolerance, error, steps,
               bench_over_rk8pd(P, tolerance, NULL));
        fflush(stdout);
    }
    printf("#< runs\n");
}

/* Run the plate with the prototype's first step, 0.1 tolerance^0.4 after 0 and after the jump, and with its
 * finest modes. Compute the error at the ends of steps. Return the number of steps. */
static size_t begun_alike(const bench_problem *P, double tolerance,
                          double *error)
{
    static double t[BENCH_STEPS], x[BENCH_STEPS], exact[BENCH_STEPS],
        v[BENCH_STEPS];
    fvi_run run = P->run;
    fvi_stepper *s;
    size_t n = 0;
    run.system = &P->system;
    run.step_error = tolerance;
    bench_need(fvi_stepper_start(&fvi_variable_step, &run, &s, NULL));
    fvi_variable_step_state *o = s->method_state;
    const int first =
        (int)floor(log(0.1 * pow(tolerance, 0.4)) / fvi_variable_spacing());
    o->next_exponent = first;
    fvi_modes_free(o->modes);
    bench_need(fvi_modes_alloc(o->rule, FVI_MODES_FINE, o->beta, 1, o->T,
                               o->least, &o->modes));
    for (; s->k < run.steps; n++) {
        bench_need(fvi_stepper_step(s));
        if (o->first_after_event)
            o->next_exponent = first;
        t[n] = s->t;
        x[n] = s->x[0];
    }
    fvi_stepper_free(s);
    bench_need(fvi_exact_at(&P->exact, n, t, exact, v, NULL));
    *error = 0;
    for (size_t i = 0; i < n; i++)
        *error = larger(*error, fabs(x[i] - exact[i]));
    return n;
}

static void compare_alike(const bench_problem *all)
{
    printf("\n\n#> alike\n# tolerance\tits error\tits steps\terror\tsteps\n");
    for (size_t i = 0; i < sizeof its_runs / sizeof *its_runs; i++) {
        double tolerance, error;
        if (its_runs[i].problem != PLATE
            || sscanf(its_runs[i].form, "D8 %lf", &tolerance) != 1)
            continue;
        const size_t steps = begun_alike(&all[PLATE], tolerance, &error);
        printf("%.0e\t%.1e\t%zu\t%.1e\t%zu\n", tolerance, its_runs[i].error,
               its_runs[i].steps, error, steps);
    }
    printf("#< alike\n");
}

/* ---- alphas ---- */

static void alphas(void)
{
    static bench_problem P;
    static const double pushed[] = { 1, 1, 1, 0, 1 },
                        low[] = { 1, 1, 1, 1, 0.5 }, high[] = { 1, 1, 1, 0, 1 };
    printf("\n\n#> alphas\n# run\talpha\tits error\tits steps\terror\tsteps\t"
           "time\n");
    for (size_t i = 0; i < sizeof its_alphas / sizeof *its_alphas; i++) {
        const double alpha = its_alphas[i].alpha;
        double ends, rows;
        if (its_alphas[i].singular) {
            bench_linear(&P, "Riemann-Liouville", alpha,
                         alpha < 0.5 ? low : high, 20);
            P.run.past = P.exact.past = FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE;
        } else {
            bench_linear(&P, "pushed", alpha, pushed, 20);
            bench_step(&P, 8, 0.7310585);
        }
        bench_truth(&P);
        const size_t steps = bench_errors(&P, 1e-12, 1, &ends, &rows).steps;
        printf("%s\t%.6g\t%.0e", P.name, alpha, its_alphas[i].error);
        known("\t%.0f", (double)its_alphas[i].steps);
        printf("\t%.0e\t%zu\t%.2g\n", its_alphas[i].singular ? rows : ends,
               steps, bench_over_rk8pd(&P, 1e-12, NULL));
        fflush(stdout);
    }
    printf("#< alphas\n");
}

/* ---- many steps ---- */

static void long_runs(void)
{
    static bench_problem P;
    printf(
        "\n\n#> long\n# run\tits error\tits steps\tits ms\ttolerance\terror\t"
        "steps\tms\n");
    for (size_t i = 0; i < sizeof its_long / sizeof *its_long; i++) {
        bench_linear(&P, its_long[i].name, its_long[i].alpha, its_long[i].of,
                     its_long[i].T);
        if (its_long[i].w > 0)
            bench_cosine(&P, 1, its_long[i].w);
        bench_truth(&P);
        double ends, rows;
        const double tolerance = its_long[i].tolerance;
        const size_t steps = bench_errors(&P, tolerance, 1, &ends, &rows).steps;
        printf("%s", P.name);
        known("\t%.1e", its_long[i].error);
        printf("\t%zu", its_long[i].steps);
        known("\t%.2g", its_long[i].ms);
        printf("\t%.0e\t%.1e\t%zu\t%.3g\n", tolerance, rows, steps,
               1e3 * bench_seconds(&P, tolerance));
    }
    printf("#< long\n");
}

/* Print the time of fvi_stepper_start and fvi_stepper_free, without a step between them. */
static void set_up(const bench_problem *all)
{
    printf("\n\n#> start\n# run\ttolerance\tmicroseconds of its start\n");
    for (size_t i = PLATE; i <= SLOW; i++)
        for (double tolerance = 1e-4; tolerance > 1e-13; tolerance /= 1e4) {
            double least = HUGE_VAL;
            fvi_run run = all[i].run;
            run.system = &all[i].system;
            run.step_error = tolerance;
            for (int n = 0; n < 5000; n++) {
                fvi_stepper *s;
                const double begin = now();
                bench_need(fvi_stepper_start(&fvi_variable_step, &run, &s,
                                             NULL));
                fvi_stepper_free(s);
                const double took = now() - begin;
                least = took > 0 ? smaller(least, took) : least;
            }
            printf("%s\t%.0e\t%.2g\n", all[i].name, tolerance, 1e6 * least);
        }
    printf("#< start\n");
}

int main(void)
{
    static bench_problem all[BENCH_PROBLEMS];
    describe();
    bench_problems(all);
    double rk8pd;
    bench_over_rk8pd(&all[SPRING], 1e-8, &rk8pd);
    printf("# rk8pd on spring: %.3g microseconds; the prototype's: %.3g\n",
           1e6 * rk8pd, ITS_RK8PD);
    orders(all);
    compare(all);
    compare_alike(all);
    alphas();
    prototype_random();
    prototype_two_runs();
    long_runs();
    set_up(all);
    return EXIT_SUCCESS;
}
