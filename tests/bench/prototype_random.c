/* tests/bench/prototype_random.c -- H 22: the library beside the prototype, on random problems. */
#include "variable.h"
#include "prototype.h"
#include "variable_step/variable_step.h"
#include "system/larger.h"

#include <gsl/gsl_math.h>
#include <gsl/gsl_rng.h>
#include <gsl/gsl_sort.h>
#include <stdio.h>

enum { ROWS = BENCH_ROWS, RANDOM = 200 };

static const char *const its_random[] = {
    "its D8, x at the ends\t9e-5\t0.008\t-",
    "its D8, x in the rows\t0.007\t0.037\t-",
    "its D8, v\t4e-4\t0.14\t1.5",
    "its D8, steps of a run\t42",
    "its D6, x at the ends\t0.0014\t0.07\t-",
    "its D6, x in the rows\t0.017\t0.13\t-",
    "its D6, v\t0.012\t0.83\t16",
    "its D6, steps of a run\t76",
    "its M8, x at the ends\t7e-4\t0.017\t-",
    "its M8, x in the rows\t0.012\t0.074\t-",
    "its M8, v\t0.13\t14\t5e3",
    "its M8, v, estimated too\t0.06\t0.35\t0.76",
    "its M8, steps of a run\t44",
    "its M6, x at the ends\t0.008\t0.076\t-",
    "its M6, x in the rows\t0.05\t0.22\t-",
    "its M6, v\t1.1\t41\t2e4",
    "its M6, v, estimated too\t0.24\t0.68\t1.4",
    "its M6, steps of a run\t82",
    "its D5, x in the rows\t0.08\t0.56\t3.8",
    "its D5, steps of a run\t126",
    "its M5, x in the rows\t0.16\t0.67\t3.0",
    "its M5, steps of a run\t138",
};

static const char *const its_two_runs[] = {
    "its M6\t0.90\t1.07\t1.16", "its M7\t0.90\t1.09\t1.57",
    "its M8\t0.75\t1.05\t1.14", "its D6\t0.86\t1.05\t2.9",
    "its D7\t0.65\t1.03\t1.10", "its D8\t0.65\t1.06\t3.6",
};

/* ---- random problems ---- */

static double between(gsl_rng *r, double low, double high)
{
    return low + (high - low) * gsl_rng_uniform(r);
}

static double decades(gsl_rng *r, double low, double high)
{
    return exp(between(r, log(low), log(high)));
}

/* Draw a problem and return a tolerance: m, c and rho over two decades, some almost undamped, every alpha; a
 * third of the problems each without a force, with a force that ends at any time, with a cosine. */
static double draw(gsl_rng *r, bench_problem *P)
{
    const double light = gsl_rng_uniform(r) < 0.15 ? 1e-3 : 1;
    const double of[] = { decades(r, 0.1, 10), light * decades(r, 0.1, 10),
                          decades(r, 0.1, 10), between(r, -1, 1),
                          between(r, -1, 1) };
    bench_linear(P, "random", gsl_rng_uniform(r), of, 20);
    const int pushed = (int)gsl_rng_uniform_int(r, 3);
    if (pushed == 1)
        bench_step(P, between(r, -8, 8), between(r, 0, 20));
    if (pushed == 2)
        bench_cosine(P, between(r, -8, 8), decades(r, 0.1, 10));
    bench_truth(P);
    return decades(r, 1e-12, 1e-3);
}

static void say(const char *where, double *used)
{
    gsl_sort(used, 1, RANDOM);
    printf("%s\t%.1g\t%.1g\t%.1g\n", where, used[RANDOM / 2],
           used[RANDOM * 9 / 10], used[RANDOM - 1]);
}

void prototype_random(void)
{
    static bench_problem P;
    static double x[ROWS + 1], v[ROWS + 1], t[ROWS + 1], exact[ROWS + 1],
        exact_v[ROWS + 1], used[3][RANDOM];
    gsl_rng *r = gsl_rng_alloc(gsl_rng_mt19937);
    size_t steps = 0;
    for (int n = 0; n < RANDOM; n++) {
        const double tolerance = draw(r, &P);
        double ends, rows, of_v = 0;
        steps += bench_errors(&P, tolerance, 1, &ends, &rows).steps;
        bench_rows(&P, tolerance, x, v);
        for (size_t k = 0; k <= ROWS; k++)
            t[k] = (double)k * P.run.h;
        bench_need(fvi_exact_at(&P.exact, ROWS + 1, t, exact, exact_v, NULL));
        for (size_t k = 0; k <= ROWS; k++)
            of_v = larger(of_v, fabs(v[k] - exact_v[k]));
        used[0][n] = ends / tolerance;
        used[1][n] = rows / tolerance;
        used[2][n] = of_v / tolerance;
    }
    gsl_rng_free(r);
    printf("\n\n#> random\n# error / tolerance\tmedian\t90 %%\tmost\n");
    for (size_t i = 0; i < sizeof its_random / sizeof *its_random; i++)
        puts(its_random[i]);
    say("x at the ends", used[0]);
    say("x in the rows", used[1]);
    say("v in the rows", used[2]);
    printf("steps of a run\t%.0f\n#< random\n", (double)steps / RANDOM);
}

/* ---- two runs ---- */

/* Compute the rows of a run with a limited length of steps, and the length of its longest step. */
static double limited(const bench_problem *P, double tolerance, double longest,
                      int growth, double *x)
{
    fvi_stepper *s = bench_start(P, tolerance);
    fvi_step_statistics counts;
    fvi_variable_step_limit(s, longest, growth);
    for (size_t k = 0; k <= ROWS; k++)
        bench_need(fvi_stepper_advance_to(s, (double)k * P->run.h, x + k, NULL));
    bench_need(fvi_stepper_statistics(s, &counts));
    fvi_stepper_free(s);
    return counts.longest;
}

void prototype_two_runs(void)
{
    static bench_problem P;
    static double x[ROWS + 1], finer[ROWS + 1], ratio[RANDOM];
    gsl_rng *r = gsl_rng_alloc(gsl_rng_mt19937);
    for (int n = 0; n < RANDOM; n++) {
        const double tolerance = draw(r, &P),
                     longest = limited(&P, tolerance, 20, 4, x);
        double apart = 0, off = 0, size = 0;
        limited(&P, tolerance / 10, longest / 2, 3, finer);
        for (size_t k = 0; k <= ROWS; k++) {
            apart = larger(apart, fabs(x[k] - finer[k]));
            off = larger(off, fabs(x[k] - P.truth[k]));
            size = larger(size, fabs(finer[k]));
        }
        ratio[n] = off / (apart + 3e-14 * size);
    }
    gsl_rng_free(r);
    gsl_sort(ratio, 1, RANDOM);
    printf("\n\n#> two-runs\n# true error / difference\t5 %%\t95 %%\tmost\n");
    for (size_t i = 0; i < sizeof its_two_runs / sizeof *its_two_runs; i++)
        puts(its_two_runs[i]);
    printf("fvi-adaptive\t%.2f\t%.2f\t%.2f\n#< two-runs\n", ratio[RANDOM / 20],
           ratio[RANDOM * 19 / 20], ratio[RANDOM - 1]);
}
