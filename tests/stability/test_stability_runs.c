/* tests/stability/test_stability_runs.c -- H 14: growing solutions of the symbol and of runs.
 * Run alone: make test-stability_runs */
#include "scalar_run.h"
#include "run/whole_run.h"
#include "harness/full_chain.h"

#include "stability_ref.h"
#include "system/larger.h"

#include <gsl/gsl_rng.h>
#include <stdlib.h>

/* Largest |x_k| over the first half, and over the rest, of N steps. */
static void halves(const fvi_run *run, double *first, double *second)
{
    double *x = malloc((run->steps + 1) * sizeof *x);
    ck_assert_ptr_nonnull(x);
    ck_assert_int_eq(fvi_trajectory(&fvi_fractional, run, x, NULL, NULL),
                     FVI_SUCCESS);
    *first = *second = 0;
    for (size_t k = 0; k <= run->steps; k++) {
        double *half = k <= run->steps / 2 ? first : second;
        *half = larger(*half, fabs(x[k]));
    }
    free(x);
}

/* (14.5) in a run, from the last 500 of 5000 steps. When they begin the growing
 * mode has reached 1e9 and more; the rest, below 10, is all that blurs it. And
 * ln(growth) is good to 32 ulp of growth, 64 u. Seen: 0.53 of it. */
static void ck_assert_growth(double alpha, double kappa, double W, double R)
{
    enum { FROM = 4500, TO = 5000 };
    double x[TO + 1], growth;
    const fvi_run run = scalar_run(alpha, kappa, W, R, TO);
    ck_assert_int_eq(fvi_amplification(alpha, kappa, W, R, &growth), FVI_SUCCESS);
    ck_assert_int_eq(fvi_trajectory(&fvi_fractional, &run, x, NULL, NULL),
                     FVI_SUCCESS);
    ck_assert(fabs(x[FROM]) > 1e9);
    ck_assert_near(log(fabs(x[TO] / x[FROM])) / (TO - FROM), log(growth),
                   2 * 10 / fabs(x[FROM]) / (TO - FROM) + 64 * U,
                   "outside: alpha=%g kappa=%g W=%g", alpha, kappa, W);
}

/* (14.5). Q is computed with a relative error of some u of its terms, and is
 * steep at the root: z is good to 32 ulp here. Seen: 4 ulp. */
START_TEST(eq_14_5_growth_is_the_root_of_the_symbol)
{
    for (size_t i = 0; i < LEN(ref_growth); i++) {
        double growth = 0;
        ck_assert_int_eq(fvi_amplification(ref_growth[i].alpha, ref_growth[i].kappa,
                                    ref_growth[i].W, ref_growth[i].R, &growth),
                         FVI_SUCCESS);
        ck_assert_ulp(growth, ref_growth[i].want, 32, "row %zu", i);
    }
}
END_TEST

/* The argument principle against the formula, at seeded random points. */
START_TEST(eq_14_3_the_argument_principle_counts_what_the_theorem_says)
{
    enum { POINTS = 4000 };
    gsl_rng *random = gsl_rng_alloc(gsl_rng_mt19937);
    size_t unstable = 0;
    //> argument
    for (int i = 0; i < POINTS; i++) {
        double alpha = gsl_rng_uniform_pos(random),
               kappa = gsl_rng_uniform(random);
        double W = pow(10, 4 * gsl_rng_uniform(random) - 2);
        double R = pow(10, 4 * gsl_rng_uniform(random) - 2), load, growth;
        int modes = -1;
        const fvi_run run = scalar_run(alpha, kappa, W, R, 1);
        ck_assert_int_eq(fvi_stability_number(&fvi_fractional, &run, &load),
                         FVI_SUCCESS);
        ck_assert_int_eq(fvi_unstable_roots(alpha, kappa, W, R, &modes),
                         FVI_SUCCESS);
        ck_assert_int_eq(fvi_amplification(alpha, kappa, W, R, &growth), FVI_SUCCESS);
        ck_assert_msg(
            modes == (load > 1) && (growth > 1) == (load > 1),
            "alpha=%g kappa=%g W=%g R=%g: %d modes, load %g, growth %g", alpha,
            kappa, W, R, modes, load, growth);
        unstable += load > 1;
    }
    //< argument
    ck_assert(unstable > POINTS / 4 && unstable < POINTS * 3 / 4);
    seen((double)unstable, "unstable points");
    gsl_rng_free(random);
}
END_TEST

/* Long runs, half a percent inside and outside. Inside, the second half stays
 * below the first; alpha = 0 is neutral, a sampled oscillation, whose halves are
 * equal to 1 %. */
START_TEST(eq_14_3_long_runs_on_both_sides_of_the_boundary)
{
    const double alphas[] = { 0, 0.25, 0.5, 0.75, 1 },
                 kappas[] = { 0, 0.25, 0.5 };
    const double Ws[] = { 0.01, 0.5, 2, 3 };
    for (size_t i = 0; i < LEN(alphas); i++)
        for (size_t j = 0; j < LEN(kappas); j++)
            for (size_t l = 0; l < LEN(Ws); l++) {
                double a = alphas[i], k = kappas[j], W = Ws[l], first, second;
                double R = (4 - W * gsl_pow_2(1 - 2 * k)) / pow(4, a);
                fvi_run run = scalar_run(a, k, W, 0.995 * R, 6000);
                halves(&run, &first, &second);
                ck_assert_msg(second <= (a > 0 ? 1 : 1.01) * first,
                              "inside: alpha=%g kappa=%g W=%g: %g then %g", a,
                              k, W, first, second);
                ck_assert_growth(a, k, W, 1.005 * R);
            }
}
END_TEST

/* How much x alternates at the end of a long run, from its last second difference. */
static double alternation(const fvi_run *run)
{
    const size_t N = run->steps;
    double *x = malloc((N + 1) * sizeof *x);
    ck_assert_ptr_nonnull(x);
    ck_assert_int_eq(fvi_trajectory(&fvi_fractional, run, x, NULL, NULL), FVI_SUCCESS);
    const double size = fabs(x[N] - 2 * x[N - 1] + x[N - 2]) / 4;
    free(x);
    return size;
}

/* (14.11): on the edge a motion alternates for ever. With Caputo's past, above the order 1 and for kappa = 1/2, it does
 * not. There the second difference falls like k^(-1 - 2 alpha): at k = 3000 it is below 1e-8. */
START_TEST(eq_14_11_on_the_edge_caputos_motions_need_not_alternate)
{
    const double alphas[] = { 0.6, 0.75, 0.9, 1 }, kappas[] = { 0.25, 0.5 }, W = 1.25, x_0 = 1, p_0 = 0.75;
    for (size_t i = 0; i < LEN(alphas); i++)
        for (size_t j = 0; j < LEN(kappas); j++)
            for (int caputo = 0; caputo <= 1; caputo++) {
                const double a = alphas[i], k = kappas[j];
                const int dies = caputo && k == 0.5;
                fvi_run run = scalar_run(a, k, W, (4 - W * gsl_pow_2(1 - 2 * k)) / pow(4, a), 3000);
                run.x0 = &x_0;
                run.p0 = &p_0;
                run.past = caputo ? FVI_INITIAL_HISTORY_CAPUTO : FVI_INITIAL_HISTORY_HELD;
                const double size = alternation(&run);
                ck_assert_msg(dies ? size < 1e-8 : size > 0.05, "alpha=%g kappa=%g caputo=%d: %g", a, k, caputo, size);
            }
}
END_TEST

/* Two per cent outside, as in the figure: how much a thousand steps grow. */
START_TEST(eq_14_5_two_per_cent_outside_a_run_is_lost)
{
    for (double alpha = 0.25; alpha < 1; alpha += 0.25) {
        double growth = 0, R = 1.02 * pow(4, 1 - alpha);
        ck_assert_int_eq(fvi_amplification(alpha, 0.5, 1, R, &growth), FVI_SUCCESS);
        ck_assert(pow(growth, 1000) > 1e10);
        seen(pow(growth, 1000), "growth");
    }
}
END_TEST

/* In R^d: a chain of five, unequal dampings. The largest step from the matrix,
 * then runs just inside and outside of it. */
START_TEST(eq_14_3_a_chain_of_masses)
{
    const double mass[] = { 1, 2, 0.5, 1, 3 },
                 damping[] = { 0.3, 0, 1, 0.2, 2 };
    const double spring[] = { 1, 0 }, start[] = { 0, 0, 0, 0, 0 };
    const double kick[] = { 1, -1, 0.5, 0.2, 1 };
    const fvi_system chain = { 5,       mass,
                               damping, fvi_potential_chain(spring),
                               { 0 },   NULL, NULL };
    fvi_run run = { .system = &chain,
                    .x0 = start,
                    .p0 = kick,
                    .steps = 4000,
                    .alpha = 0.3,
                    .kappa = 0 };
    double step, load, last[5 * 4001];
    ck_assert_int_eq(fvi_stability_longest_step(&fvi_fractional, &run, &step),
                     FVI_SUCCESS);
    for (int outside = 0; outside <= 1; outside++) {
        run.h = step * (outside ? 1.01 : 0.99);
        ck_assert_int_eq(fvi_stability_number(&fvi_fractional, &run, &load),
                         FVI_SUCCESS);
        ck_assert_int_eq(load > 1, outside);
        ck_assert_int_eq(
            fvi_trajectory(&fvi_fractional, &run, last, NULL, NULL),
            FVI_SUCCESS);
        double end = 0;
        for (size_t i = 0; i < 5; i++)
            end = larger(end, fabs(last[5 * 4000 + i]));
        ck_assert_msg(outside ? end > 1e6 : end < 1, "h = %g: %g", run.h, end);
    }
    fvi_system full = chain; /* by another road to the eigenvalues */
    full.potential.hessian = full_chain_hessian;
    full.potential.diagonals = 0;
    run.system = &full;
    double again;
    ck_assert_int_eq(fvi_stability_number(&fvi_fractional, &run, &again),
                     FVI_SUCCESS);
    ck_assert_near(again, load, 5 * 8 * U * load, "a full Hessian");
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("14 stability, runs");
    ADD_CASE(suite, "values", eq_14_5_growth_is_the_root_of_the_symbol,
             eq_14_5_two_per_cent_outside_a_run_is_lost);
    ADD_CASE(suite, "identities",
             eq_14_3_the_argument_principle_counts_what_the_theorem_says,
             eq_14_3_long_runs_on_both_sides_of_the_boundary,
             eq_14_11_on_the_edge_caputos_motions_need_not_alternate);
    ADD_CASE(suite, "chain", eq_14_3_a_chain_of_masses);
    return run_suite(suite);
}
