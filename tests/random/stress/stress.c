/* tests/random/stress/stress.c -- `make stress`: compare many random runs with a truth or an identity, and print
 * a line for each family.
 *
 *     stress [SEED [FAMILY [CASE]]]
 *
 * Each case has its own generator, which is seeded by the seed and the number of the case. So a failed case can
 * be repeated alone. */
#include <fvi/error.h>
#include "stress.h"
#include "system/larger.h"

#include <gsl/gsl_math.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

double stress_uniform(gsl_rng *random, double low, double high)
{
    return low + (high - low) * gsl_rng_uniform(random);
}

double stress_decades(gsl_rng *random, double low, double high)
{
    return exp(stress_uniform(random, log(low), log(high)));
}

double stress_alpha(gsl_rng *random)
{
    static const double hard[] = {
        0, 0x1p-1074, 1e-8, 0.5 - 0x1p-54, 0.5, 0.5 + 0x1p-53, 1 - 0x1p-53, 1
    };
    if (gsl_rng_uniform_int(random, 2))
        return hard[gsl_rng_uniform_int(random, sizeof hard / sizeof *hard)];
    return gsl_rng_uniform(random);
}

double stress_kappa(gsl_rng *random)
{
    static const double kappas[] = { 0, 0.5, 1 };
    size_t i = gsl_rng_uniform_int(random, 4);
    return i < 3 ? kappas[i] : gsl_rng_uniform(random);
}

double stress_distance(size_t n, const double *a, const double *b)
{
    double most = 0;
    for (size_t k = 0; k < n; k++)
        most = larger(most, fabs(a[k] - b[k]));
    return most;
}

double stress_size(size_t n, const double *a)
{
    double most = 0;
    for (size_t k = 0; k < n; k++)
        most = larger(most, fabs(a[k]));
    return most;
}

static const struct {
    const char *name, *what;
    stress_case *run;
    unsigned long cases;
} families[] = {
    { "exact", "against the exact solution, at order 1", stress_exact, 1000 },
    { "quadruple", "against quadruple precision", stress_quadruple, 150 },
    { "rounding", "the floor at N = 10^5", stress_rounding, 1 },
    { "weights", "the nearest doubles at n = 10^7 and 10^8", stress_weights,
      1 },
    { "adaptive", "a wanted error is had, or refused with words",
      stress_adaptive, 1000 },
    { "matching", "the matched momentum is both F^- and F^+", stress_matching,
      300 },
    { "dissipation", "the work of the damping is never negative",
      stress_dissipation, 300 },
    { "balance", "energy lost = work done, up to O(h)", stress_balance, 200 },
    { "scaling", "x 2^s moves no digit", stress_scaling, 300 },
    { "overflow", "never an infinity in silence", stress_overflow, 500 },
    { "memories", "exponentials against the direct sum",
      stress_memories, 200 },
    { "scatter", "500 fits scatter as they say", stress_scatter, 1 },
    { "found", "100 noisy motions of another program are found", stress_found,
      1 },
    { "coverage", "intervals hold the truth, or a flag is up", stress_coverage, 1 },
    { "rheology", "laws of materials are found, their intervals hold them",
      stress_rheology, 1 },
    { "refusals", "one wrong field is refused", stress_refusals, 20000 },
    { "halves", "a power in two halves has the exact solution of the power",
      stress_halves, 5000 },
    { "pulses", "no pulse of an expression is missed", stress_pulses, 1000 },
    { "mechanisms", "methods agree on mechanisms of random texts",
      stress_mechanisms, 200 },
};

/* Run all cases of a family, or one of them. Return the number of failures. */
static unsigned long run_family(size_t f, unsigned long seed, long only)
{
    gsl_rng *random = gsl_rng_alloc(gsl_rng_mt19937);
    char describe[600] = "";
    double worst = 0;
    unsigned long failures = 0, done = 0, silent = 0;
    clock_t began = clock();
    for (unsigned long i = 0; random && i < families[f].cases; i++) {
        if (only >= 0 && i != (unsigned long)only)
            continue;
        gsl_rng_set(random,
                    seed * 1000003 + 7919 * (unsigned long)f + 31 * i + 1);
        double used = families[f].run(random, describe, sizeof describe);
        done++;
        silent += used < 0;
        worst = larger(worst, used);
        if (!(used <= 1)) {
            failures++;
            printf("FAILED %s, %.3g of what is allowed: %s\n"
                   "  repeat: make stress SEED=%lu FAMILY=%s CASE=%lu\n",
                   families[f].name, used, describe, seed, families[f].name, i);
        }
    }
    printf("%-12s %6lu cases, worst %9.2e of what is allowed, %4.1f s: %s\n",
           families[f].name, done, worst,
           (double)(clock() - began) / CLOCKS_PER_SEC, families[f].what);
    const int too_silent = done > 1 && silent > done / 100;
    if (silent > 0)
        printf("%14s%lu of them say nothing%s\n", "", silent,
               too_silent ? ": FAILED, too many" : "");
    if (done == 1)
        printf("%14s%s\n", "", describe);
    fflush(stdout);
    gsl_rng_free(random);
    return done ? failures + (unsigned long)too_silent : 1;
}

int main(int argc, char **argv)
{
    unsigned long seed = argc > 1 ? strtoul(argv[1], NULL, 10) : 1,
                  failures = 0;
    const char *family = argc > 2 ? argv[2] : "";
    long only = argc > 3 ? strtol(argv[3], NULL, 10) : -1;
    size_t ran = 0;
    for (size_t f = 0; f < sizeof families / sizeof *families; f++)
        if (!*family || strcmp(family, families[f].name) == 0) {
            failures += run_family(f, seed, only);
            ran++;
        }
    printf("seed %lu: %lu failures\n", seed, failures);
    return ran == 0 || failures > 0;
}
